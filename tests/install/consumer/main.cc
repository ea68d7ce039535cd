// fit_modulus DATASET: Young's modulus of the leg with its 95 % interval [Pa].
#include <cstdio>

#include "base/input_error.h"
#include "datasets/read_dataset.h"
#include "fitting/fit_dataset.h"
#include "fitting/uncertainty.h"

int main(int argc, char** argv) {
  if (argc != 2) return 64;
  try {
    const hoplab::Dataset dataset = hoplab::ReadDataset(argv[1]);
    hoplab::ProblemOptions problem;
    problem.free = {"E", "d"};
    const hoplab::DatasetFit fit = hoplab::FitDataset(dataset, problem, {});
    if (!fit.result.ok) {
      std::fprintf(stderr, "no fit: %s\n", fit.result.message.c_str());
      return 1;
    }
    const hoplab::Uncertainty uncertainty = hoplab::AssessUncertainty(
        fit.problem, hoplab::TrialsOf(fit.problem, hoplab::TrialRole::kTrain), fit.result.shared,
        fit.result.initial_states, {}, 1);
    const auto& interval = uncertainty.parameters[0].ci95;
    if (!interval) return 1;
    std::printf("%.17g %.17g %.17g\n", fit.result.shared[0], interval->first, interval->second);
  } catch (const hoplab::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 65;
  }
  return 0;
}
