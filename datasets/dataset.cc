#include "datasets/dataset.h"

namespace hoplab {

const char* RoleName(TrialRole role) { return role == TrialRole::kTrain ? "train" : "test"; }

}  // namespace hoplab
