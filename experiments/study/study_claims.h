#pragma once

#include "experiments/study/study_result.h"

namespace hoplab {

/// "claim-a" to "claim-h".
std::vector<std::string> StudyClaimNames();

/// Judges that claim with the study's settings, and with others: the plain reading of its law where
/// the study's is not that, the other laws, the other rule of lift-off.
StudyClaim RunStudyClaim(const std::string& name, const Study& study);

}  // namespace hoplab
