#pragma once

#include <vector>

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// How the size of a cause that first parts of the trials told differs in the whole trials, which
/// hold those parts: of its parameters the one that differs most plainly.
struct SizeChange {
  /// In standard errors of the difference. Where the model is right, the fit of all rows is
  /// efficient and that of some is consistent, so the difference has the variance s_first^2 -
  /// s_whole^2 [Hausman 1978, Econometrica 46, 1251]; at least a quarter of s_first^2, since both
  /// are estimates.
  double std_errors = 0.0;
  /// Over the cause's size by the first parts: its largest parameter in typical sizes.
  double share = 0.0;
  /// Both fits know the errors of all its parameters.
  bool is_known = true;

  /// Another size, and not only a better one.
  bool IsPlain() const;
};
SizeChange ChangeOfSize(const CauseReport& cause, const Diagnosis& diagnosis,
                        const CarriedOn& whole);

/// Causes that the whole trials do not confirm: nothing does as well in their place, and their
/// size changes plainly. What acts keeps its size; what stands in for an error of the model does
/// not, since that error grows from landing to landing. None where no main cause that is likely
/// right is known to keep its size. `whole` is a minimum.
std::vector<SetAside> Unconfirmed(const Diagnosis& diagnosis, const CarriedOn& whole);

}  // namespace hoplab
