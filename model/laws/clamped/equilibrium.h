#pragma once

#include <limits>

#include "model/laws/clamped/clamped_leg.h"
#include "model/laws/clamped/integrals.h"

namespace hoplab {

namespace clamped {

/// The solution of a search and how it changes with the place.
struct Root {
  double fx = 0.0, fy = 0.0, tip = 0.0;
  double a = std::numeric_limits<double>::quiet_NaN(), b = 0.0, base = 0.0;
  double i11 = 0.0, i12 = 0.0, i22 = 0.0, h1 = 0.0, h2 = 0.0;
  double turn_x = 0.0, turn_y = 0.0, turn_base = 0.0;

  template <class Do>
  void Each(const Do& act) {
    for (double* v :
         {&fx, &fy, &tip, &a, &b, &base, &i11, &i12, &i22, &h1, &h2, &turn_x, &turn_y, &turn_base})
      act(*v);
  }
  template <class Do>
  void Each(const Do& act) const {
    const_cast<Root*>(this)->Each(act);
  }
};

/// The last roots of a leg's searches: where the next one starts.
struct Roots {
  Root last;
  Root before;  // one that is not much nearer than the last two are to each other

  /// As a leg lands, unloaded.
  void StartAt(double tip) {
    *this = Roots{};
    last.tip = tip;
  }
  /// Their load is known, not how it changes.
  void Forget() { last.a = before.a = std::numeric_limits<double>::quiet_NaN(); }
  void Add(const Root& root);
};

/// A root of M81 but for the last correction, and the answer of the leg there. All NaN beyond the
/// leg's domain.
struct Solution {
  Tangents at;
  double fx, fy;
  Integrals sum;
  double kx, ky, c11, c12, c22, h1, h2;  // M68, M69; the ground's give is in c22
  double i11, i12, i22;                  // inverse of the compliance
  double turn_x = 0.0, turn_y = 0.0, turn_base = 0.0, tip_miss = 0.0, by_tip = 0.0;
  double miss_x, miss_y, x, kappa;
};

/// Where a leg stands, lengths over r.
struct Stand {
  Footing foot;
  double a, b;        // lead (unless it slides) and height of the hip
  double base;        // Psi [rad]
  double mu;          // friction under the foot
  double length;      // of what bends
  double give = 0.0;  // how far the ground sinks under a unit of load
};

/// Newton for the force, and on the toe for the turn of the tip, from where `roots` lead. Steps
/// below `tolerance` end it; what is found is added to them.
Solution SolveStand(const Stand& stand, double tolerance, Roots& roots);

}  // namespace clamped
}  // namespace hoplab
