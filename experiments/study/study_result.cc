#include "experiments/study/study_result.h"

#include <algorithm>
#include <cmath>

namespace hoplab {

std::string_view NameOf(StudyVerdict verdict) {
  switch (verdict) {
    case StudyVerdict::kReproduced:
      return "reproduced";
    case StudyVerdict::kOnlyUnderSettings:
      return "only under stated settings";
    case StudyVerdict::kNotReproduced:
      return "not reproduced";
  }
  return "";  // unreachable: every enumerator is listed above
}

bool ComparedNumber::agrees() const {
  if (std::isnan(published) || std::isnan(ours)) return std::isnan(published) == std::isnan(ours);
  return std::abs(ours - published) <= tolerance;
}

StudyVerdict VerdictOf(const std::vector<StudyCheck>& checks,
                       const std::vector<ClaimAlternative>& alternatives) {
  if (std::all_of(checks.begin(), checks.end(), [](const StudyCheck& c) { return c.holds; }))
    return StudyVerdict::kReproduced;
  const bool elsewhere =
      std::any_of(alternatives.begin(), alternatives.end(), [](const ClaimAlternative& a) {
        return std::find(a.holds.begin(), a.holds.end(), false) == a.holds.end();
      });
  return elsewhere ? StudyVerdict::kOnlyUnderSettings : StudyVerdict::kNotReproduced;
}

}  // namespace hoplab
