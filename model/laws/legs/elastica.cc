#include "model/laws/elastica_arc.h"
#include "model/laws/legs/make_leg_law.h"
#include "model/mechanisms/c_leg.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using ElasticaLeg = CLeg<T, ElasticaLaw>;

namespace leg_laws {
extern constexpr LegLaw elastica = MakeLegLaw<ElasticaLeg>(Law::kElastica);
}
}  // namespace hoplab
