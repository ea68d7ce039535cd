#include "model/laws/half_circle.h"
#include "model/laws/legs/make_leg_law.h"
#include "model/mechanisms/c_leg.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using ThesisLeg = CLeg<T, ThesisLaw>;

namespace leg_laws {
extern constexpr LegLaw thesis = MakeLegLaw<ThesisLeg>(
    {Law::kThesis, MechanismKind::kCLeg, 4, "thesis",
     "c_leg: half circle of varying radius, the law of the published tables; does not "
     "conserve energy.",
     "F = k(phi) (l0 - l) with k = 1/C [N/m] (M6), and the contact moves by dx_c/dt = -r_d"
     " sin(theta) dtheta/dt (M7).",
     "For reproducing the published tables (hoplab reproduce). Its energy is not kept, and"
     " it cannot carry every trace to its end; fits then go hop by hop. The effects "
     "rolling_law and tip_rotation turn it into consistent."});
}
}  // namespace hoplab
