#include "model/laws/elastica_arc.h"
#include "model/laws/legs/make_leg_law.h"
#include "model/mechanisms/c_leg.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using ElasticaLeg = CLeg<T, ElasticaLaw>;

namespace leg_laws {
extern constexpr LegLaw elastica = MakeLegLaw<ElasticaLeg>(
    {Law::kElastica, MechanismKind::kCLeg, 0, "elastica",
     "c_leg, default: static equilibrium of an inextensible elastic arc, exact for any "
     "load; conserves energy.",
     "The arc between hip and contact is an inextensible beam between two pins: l = r "
     "dP/df, u/l = (dP/dphi)/f with its energy P(f, phi), f = F r^2/(E I), solved exactly "
     "and tabulated (M61, M62); normal and shear force to first order.",
     "Use it where the leg bends far. It ends a run where the load is beyond what an arc "
     "can carry before its ends close."});
}
}  // namespace hoplab
