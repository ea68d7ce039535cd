#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "experiments/kinematics/two_legs.h"
#include "experiments/study/study_result.h"

namespace hoplab {

/// Every table, figure and claim there is, in the order they are reported.
std::vector<std::string> StudyItemNames();
/// "all", "tables", "figures", "kinematics", "claims": names that stand for several items.
std::vector<std::string> StudyGroupNames();

/// The items that `wanted` (items and groups) stand for, each once, in the order above. Throws
/// InputError for a name that is neither, with the nearest one.
std::vector<std::string> ResolveStudyItems(const std::vector<std::string>& wanted);

struct ReproductionRequest {
  Study study;
  TwoLegs legs;
  std::vector<std::string> items;  // resolved
  int jobs = 1;                    // does not change the result
  /// Called when an item is finished, from one thread at a time.
  std::function<void(int done, const std::string& item)> progress = nullptr;
  const std::atomic<bool>* stop = nullptr;  // items not begun when it is set are left out
};

/// What was finished, in the order asked for.
struct Reproduction {
  std::vector<StudyTable> tables;
  std::vector<StudyFigure> figures;
  std::vector<StudyClaim> claims;
  std::vector<std::string> left_out;
};
Reproduction Reproduce(const ReproductionRequest& request);

}  // namespace hoplab
