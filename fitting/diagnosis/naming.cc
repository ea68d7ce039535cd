#include <algorithm>

#include "fitting/diagnosis/name.h"

namespace hoplab {

std::string_view NameOf(CandidateStatus status) {
  switch (status) {
    case CandidateStatus::kSupported:
      return "supported";
    case CandidateStatus::kIndistinguishable:
      return "indistinguishable";
    case CandidateStatus::kExcluded:
      return "excluded";
    case CandidateStatus::kNotNeeded:
      return "not_needed";
    case CandidateStatus::kNotTested:
      return "not_tested";
  }
  return "";
}

std::size_t Naming::MemberOf(int candidate) const {
  return static_cast<std::size_t>(std::find(best_set.begin(), best_set.end(), candidate) -
                                  best_set.begin());
}

}  // namespace hoplab
