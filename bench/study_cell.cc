#include "bench/study_cell.h"

#include "datasets/read_scenario.h"
#include "experiments/study/study_figures.h"

namespace hoplab::bench {

bool RunStudyCell() {
  static const Study study =
      StudyOfScenario(ReadScenario(HOPLAB_SOURCE_DIR "/experiments/published.yaml"), {});
  const HoppingRun run = RunHopping(HopperOfCaption(study, StudyCaptions::Controlled(0.0)), 0.0);
  return run.outcome == Outcome::kCompleted;
}

}  // namespace hoplab::bench
