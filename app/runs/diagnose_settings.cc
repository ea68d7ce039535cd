#include "app/runs/diagnose_settings.h"

#include "app/terminal/help_text.h"

namespace hoplab {

void AddDiagnoseOptions(CLI::App& sub, DiagnoseSettings& settings) {
  AddProblemOptions(sub, settings.problem);
  CLI::Option* only = sub.add_option("--effects", settings.effects,
                                     "Effects to try (default: all that apply); see hoplab effects")
                          ->delimiter(',')
                          ->option_text("EFFECT,...")
                          ->allow_extra_args(false);
  sub.add_option("--without", settings.without, "Effects not to try")
      ->delimiter(',')
      ->option_text("EFFECT,...")
      ->allow_extra_args(false)
      ->excludes(only);
  sub.add_option("--max-effects", settings.max_effects,
                 "Most effects to add to the model (default 5)")
      ->check(CLI::Range(1, 10))
      ->option_text("N");
  sub.add_option("--material", settings.material,
                 "Misfit share below which a cause is small (default 2)")
      ->check(NumberIn(0.0, 100.0))
      ->option_text("PERCENT");
  AddDiscrepancyOption(sub, settings.discrepancy);
  sub.add_option("--starts", settings.restarts,
                 "Searches for the model as it is: from the nominal values, then scattered")
      ->check(CLI::Range(1, 1000000))
      ->option_text("N");
  AddSeedOption(sub, settings.seed, "Of scattered starts, noise draws and bootstraps");
  sub.add_option("--span", settings.span,
                 "whole traces, else single hops where a law falls (default), whole or hops")
      ->check(OneOf({"whole_else_hops", "whole", "hops"}))
      ->option_text("NAME");
  sub.add_flag("--discover", settings.discover,
               "Look for a formula where the catalogue falls short");
  AddRunFolderOptions(sub, settings, "Run folder (default runs/<dataset>-diagnose-NNN)");
}

DiagnosisOptions DiagnosisOptionsOf(const DiagnoseSettings& settings) {
  DiagnosisOptions options;
  options.problem = ProblemOptionsOf(settings.problem);
  options.fit.restarts = settings.restarts;
  options.fit.seed = settings.seed;
  options.fit.jobs = JobsOf(settings.problem.jobs);
  options.fit.discrepancy = *FindDiscrepancy(settings.discrepancy);
  options.span = *FindSpan(settings.span);
  options.candidates = {settings.effects, settings.without};
  options.max_effects = settings.max_effects;
  options.material = settings.material / 100.0;
  return options;
}

}  // namespace hoplab
