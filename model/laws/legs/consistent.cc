#include "model/laws/elastic_arc.h"
#include "model/laws/legs/make_leg_law.h"
#include "model/mechanisms/c_leg.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using ConsistentLeg = CLeg<T, ConsistentLaw>;

namespace leg_laws {
extern constexpr LegLaw consistent = MakeLegLaw<ConsistentLeg>(
    {Law::kConsistent, MechanismKind::kCLeg, 2, "consistent",
     "c_leg: static equilibrium of the elastic arc, first-order bending with tip rotation;"
     " conserves energy.",
     "The chord of length l carries F with l = l0 - F C (M9); the loaded tip turns by F "
     "C'/2 (M10), C [m/N] the arc's compliance (M2), C' [1/N] its slope along the arc.",
     "Use it for small deflections, or to see what large_deflection adds. A modulus fitted"
     " with it comes out too low where the leg bends far."});
}
}  // namespace hoplab
