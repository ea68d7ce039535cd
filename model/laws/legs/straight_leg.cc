#include "model/mechanisms/straight_leg.h"

#include "model/laws/legs/make_leg_law.h"

namespace hoplab {
namespace leg_laws {
extern constexpr LegLaw straight_leg = MakeLegLaw<StraightSpring>(
    {Law::kStraightLeg, MechanismKind::kStraightLeg, 0, "straight_leg",
     "straight_leg: linear spring and damper on a fixed toe.",
     "F = k (l0 - l) - d dl/dt, k [N/m], d [N s/m], contact fixed in stance.",
     "The spring-loaded inverted pendulum of the literature: the mechanism to test a "
     "controller or an analysis on, and a leg of telescopes or coil springs."});
}
}  // namespace hoplab
