#include "model/laws/half_circle.h"
#include "model/laws/legs/make_leg_law.h"
#include "model/mechanisms/c_leg.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using NoSlipLeg = CLeg<T, NoSlipLaw>;

namespace leg_laws {
extern constexpr LegLaw no_slip = MakeLegLaw<NoSlipLeg>(
    {Law::kNoSlip, MechanismKind::kCLeg, 3, "no_slip",
     "c_leg: half circle of varying radius, the contact advances by the arc laid on the "
     "ground.",
     "F = k(phi) (l0 - l) with k = 1/C [N/m] (M6), and the contact moves by the arc laid "
     "down, dx_c/dt = -r dtheta/dt (M8).",
     "For comparison with the published study. It loses energy without a damper (about 6 %"
     " a hop at 25 deg, 2 % at 45), so a fit makes up for that: do not quote its modulus."});
}
}  // namespace hoplab
