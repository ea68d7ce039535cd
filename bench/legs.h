#pragma once

#include "bench/problems.h"
#include "model/effects/active_effects.h"
#include "model/laws/elastic_arc.h"
#include "model/mechanisms/c_leg.h"
#include "model/mechanisms/legged_body.h"
#include "model/mechanisms/straight_leg.h"

namespace hoplab::bench {

template <class T>
using BenchArcLeg = CLeg<T, LargeDeflectionLaw>;
/// The mechanisms behind the laws `large_deflection` and `straight_leg`, as the model compiles
/// them.
template <class T>
using ArcBody = LeggedBody<T, BenchArcLeg>;
template <class T>
using SpringBody = LeggedBody<T, StraightSpring>;

/// A mechanism alone, with the parameters of the benchmarks.
template <template <class> class Body>
Body<double> MakeBody(Law law) {
  return Body<double>(LegParameters(law), ActiveEffects<double>{}, LiftoffRule::kZeroForce);
}

}  // namespace hoplab::bench
