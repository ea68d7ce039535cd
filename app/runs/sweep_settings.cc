#include "app/runs/sweep_settings.h"

namespace hoplab {

void AddSweepOptions(CLI::App& sub, SweepSettings& settings) {
  AddScenarioOptions(sub, settings.scenario);
  AddSeedOption(sub, settings.seed, "Of a Latin hypercube");
  AddJobsOption(sub, settings.jobs, "; one a rank under mpirun");
  AddSolverOptions(sub, settings.solver);
  AddRunFolderOptions(
      sub, settings, "Run folder (default runs/<scenario>-sweep-NNN)",
      "Replace the run that stands in the run folder, begin an interrupted one anew");
}

SweepPlan SweepPlanOf(const SweepSettings& settings) {
  return {ScenarioDocumentOf(settings.scenario), IntegratorOptionsOf(settings.solver),
          settings.seed};
}

}  // namespace hoplab
