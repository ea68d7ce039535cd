#include "model/mechanisms/straight_leg.h"

#include "model/laws/legs/make_leg_law.h"

namespace hoplab {
namespace leg_laws {
extern constexpr LegLaw straight_leg = MakeLegLaw<StraightSpring>(Law::kStraightLeg);
}
}  // namespace hoplab
