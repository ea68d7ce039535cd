#include "model/laws/elastic_arc.h"
#include "model/laws/legs/make_leg_law.h"
#include "model/mechanisms/c_leg.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using LargeDeflectionLeg = CLeg<T, LargeDeflectionLaw>;

namespace leg_laws {
extern constexpr LegLaw large_deflection = MakeLegLaw<LargeDeflectionLeg>(
    {Law::kLargeDeflection, MechanismKind::kCLeg, 1, "large_deflection",
     "c_leg: static equilibrium of the elastic arc with the next term of the elastica; "
     "conserves energy.",
     "The chord of length l carries F with l = l0 - F C - F^2 C2 (M9b), C [m/N] the arc's "
     "compliance by Castigliano (M2), C2 [m/N^2] the next term of the elastica (M2b).",
     "Begin with it. It is good to 2 % of the deflection while F C/l0 stays below 0.2, and"
     " says when it does not. Compare with consistent to see what the second term is "
     "worth."});
}
}  // namespace hoplab
