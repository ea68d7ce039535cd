#include "model/laws/elastic_arc.h"
#include "model/laws/legs/make_leg_law.h"
#include "model/mechanisms/c_leg.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using ConsistentLeg = CLeg<T, ConsistentLaw>;

namespace leg_laws {
extern constexpr LegLaw consistent = MakeLegLaw<ConsistentLeg>(Law::kConsistent);
}
}  // namespace hoplab
