#include "app/runs/discover_settings.h"

#include "app/terminal/help_text.h"

namespace hoplab {

void AddDiscoverOptions(CLI::App& sub, DiscoverSettings& settings) {
  AddProblemOptions(sub, settings.problem);
  AddDiscrepancyOption(sub, settings.discrepancy);
  AddSeedOption(sub, settings.seed, "Of noise draws, resamples and bootstraps");
  sub.add_option("--span", settings.span,
                 "whole traces, else single hops where a law falls (default), whole or hops")
      ->check(OneOf({"whole_else_hops", "whole", "hops"}))
      ->option_text("NAME");
  sub.add_flag("--code", settings.code, "Also write what is found as a C++ effect");
  AddRunFolderOptions(sub, settings, "Run folder (default runs/<dataset>-discover-NNN)");
}

DiagnosisOptions DiscoveryOptionsOf(const DiscoverSettings& settings) {
  DiagnosisOptions options;
  options.problem = ProblemOptionsOf(settings.problem);
  options.fit.seed = settings.seed;
  options.fit.jobs = JobsOf(settings.problem.jobs);
  options.fit.discrepancy = *FindDiscrepancy(settings.discrepancy);
  options.span = *FindSpan(settings.span);
  return options;
}

}  // namespace hoplab
