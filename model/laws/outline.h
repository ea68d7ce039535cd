#pragma once

#include <array>
#include <cmath>

#include "model/laws/arc_shapes.h"
#include "model/laws/sole.h"
#include "model/laws/uneven_arc.h"
#include "model/parameters.h"

namespace hoplab {

/// What M124 adds to the outline of a leg of radius r on a sole: chords add up, so do their slopes,
/// and the shares of the compliance multiply.
template <class S, class P>
void AddUneven(const S& phi, const P& r, const P& outside, const P& chi, Outline<S>& to) {
  using std::sqrt;
  const UnevenArc<S> arc(phi, chi);
  const ArcShapes even(Value(phi)), bent(Value(arc.turned));
  const auto at = [](const S& angle, const auto& shape, int k) {
    return Lift(angle, shape.data(), k);
  };
  const P diameter = 2.0 * r;
  const S chord = diameter * (at(arc.turned, bent.sin, 0) / arc.mean);
  const S chord_slope = r * (at(arc.turned, bent.cos, 0) * arc.turned_slope / arc.mean) -
                        chord * (arc.mean_slope / arc.mean);
  const S soft = at(arc.turned, bent.bending, 0), hard = at(phi, even.bending, 0);
  to.rest = to.rest + chord - diameter * at(phi, even.sin, 0);
  to.lead = to.lead + P(1.0 / outside) * (chord_slope - r * at(phi, even.cos, 0));
  to.spread = to.spread * sqrt(soft / (arc.mean * arc.mean * arc.mean * hard));
  to.spread_slope =
      to.spread_slope + 0.5 * (at(arc.turned, bent.bending, 1) * arc.turned_slope / soft -
                               3.0 * (arc.mean_slope / arc.mean) - at(phi, even.bending, 1) / hard);
}

/// The outline at the contact arc phi: a sole (M113), a curvature that changes (M124), or both.
template <class S, class P>
Outline<S> OutlineAt(const S& phi, const P& r, const LawTerms<P>& terms) {
  Outline<S> out = SoleAt(phi, r, terms.sole);
  if (terms.uneven_active) AddUneven(phi, r, P(r + terms.sole), terms.uneven, out);
  return out;
}

}  // namespace hoplab
