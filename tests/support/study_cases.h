#pragma once

#include "datasets/read_scenario.h"
#include "experiments/study/hopping_run.h"
#include "tests/support/study_constants.h"

namespace hoplab::testing {

/// The study of kStudyConstants.
inline Study MadeUpStudy() {
  return StudyOfScenario(ScenarioDocument::FromText(kStudyConstants, "study.yaml").Read(),
                         IntegratorOptions{});
}

}  // namespace hoplab::testing
