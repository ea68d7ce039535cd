// fit_drops DATASET: fits a leg's modulus and damping to recorded hops.
#include <cstdio>

#include "base/input_error.h"
#include "datasets/read_dataset.h"
#include "fitting/fit_dataset.h"
#include "fitting/uncertainty.h"

int main(int argc, char** argv) {
  if (argc != 2) return 64;
  try {
    const hoplab::Dataset dataset = hoplab::ReadDataset(argv[1]);
    hoplab::ProblemOptions what;
    what.free = {"E", "d"};  // what is fitted; each trial's start is fitted, too
    const hoplab::DatasetFit fit = hoplab::FitDataset(dataset, what, {});
    if (!fit.result.ok) {
      std::fprintf(stderr, "no fit: %s\n", fit.result.message.c_str());
      return 1;
    }
    const auto trials = hoplab::TrialsOf(fit.problem, hoplab::TrialRole::kTrain);
    const hoplab::Uncertainty known = hoplab::AssessUncertainty(
        fit.problem, trials, fit.result.shared, fit.result.initial_states, {}, 1);
    const char* const names[] = {"E [GPa]  ", "d [N s/m]"};
    const double units[] = {1e9, 1.0};
    for (int i = 0; i < 2; ++i) {
      const auto place = static_cast<std::size_t>(i);
      // Absent where the data do not determine the value.
      const auto& interval = known.parameters[place].ci95_between_trials;
      std::printf("%s %.2f", names[i], fit.result.shared[i] / units[i]);
      if (interval)
        std::printf(", 95 %% interval %.2f .. %.2f", interval->first / units[i],
                    interval->second / units[i]);
      std::printf("\n");
    }
    std::printf("chi2 per sample %.1f: %s\n", known.chi2_per_dof,
                known.misfit ? "the model misses more than the noise" : "as the noise");
  } catch (const hoplab::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());  // file, line, value, rule, remedy
    return 65;
  }
}
