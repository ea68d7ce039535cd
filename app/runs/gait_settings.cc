#include "app/runs/gait_settings.h"

namespace hoplab {

void AddGaitOptions(CLI::App& sub, GaitSettings& settings) {
  AddScenarioOptions(sub, settings.scenario);
  sub.add_option("--along", settings.along,
                 "Follow it along a parameter, SI units, as kp=0.5:12 or clock.period_s=0.25:0.6")
      ->option_text("NAME=LOW:HIGH");
  AddJobsOption(sub, settings.jobs);
  AddSolverOptions(sub, settings.solver);
  AddRunFolderOptions(sub, settings, "Run folder (default runs/<scenario>-gait-NNN)");
}

}  // namespace hoplab
