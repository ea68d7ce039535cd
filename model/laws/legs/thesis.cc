#include "model/laws/half_circle.h"
#include "model/laws/legs/make_leg_law.h"
#include "model/mechanisms/c_leg.h"

namespace hoplab {
// Outside any unnamed namespace: GCC 12 gives instantiations on an alias of the same name in two
// unnamed namespaces one symbol.
template <class T>
using ThesisLeg = CLeg<T, ThesisLaw>;

namespace leg_laws {
extern constexpr LegLaw thesis = MakeLegLaw<ThesisLeg>(Law::kThesis);
}
}  // namespace hoplab
