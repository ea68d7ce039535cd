#pragma once

#include "bench/problems.h"
#include "model/effects/active_effects.h"
#include "model/laws/elastic_arc.h"
#include "model/mechanisms/c_leg.h"
#include "model/mechanisms/straight_leg.h"

namespace hoplab::bench {

/// The mechanism behind law `large_deflection`, as the model compiles it.
template <class T>
using BenchArcLeg = CLeg<T, LargeDeflectionLaw>;
template <class T>
using BenchStraightLeg = StraightLeg<T>;

/// The mechanism alone, with the parameters of the benchmarks.
template <template <class> class LegT>
LegT<double> MakeLeg(Law law) {
  return LegT<double>(LegParameters(law), ActiveEffects<double>{}, LiftoffRule::kZeroForce);
}

}  // namespace hoplab::bench
