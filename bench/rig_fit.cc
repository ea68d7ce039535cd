#include "bench/rig_fit.h"

#include "datasets/read_dataset.h"

namespace hoplab::bench {

FitResult FitRigDrops() {
  const Dataset dataset = ReadDataset(HOPLAB_SOURCE_DIR "/datasets/rig-drops");
  ProblemOptions options;
  options.law = "large_deflection";
  options.free = {"E", "d"};
  FitOptions fit;
  fit.restarts = 1;
  fit.jobs = 2;
  return Fit(MakeProblem(dataset, options), fit);
}

}  // namespace hoplab::bench
