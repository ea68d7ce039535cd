#include "app/runs/fit_settings.h"

#include "app/terminal/help_text.h"

namespace hoplab {

void AddFitOptions(CLI::App& sub, FitSettings& settings) {
  AddProblemOptions(sub, settings.problem);
  sub.add_option("--starts", settings.restarts,
                 "Searches: one from the nominal values, then scattered")
      ->check(CLI::Range(1, 1000000))
      ->option_text("N");
  AddSeedOption(sub, settings.seed, "Of the scattered starts");
  sub.add_option("--strategy", settings.strategy, "apex_shooting (default), growing_horizon or raw")
      ->check(OneOf({"raw", "growing_horizon", "apex_shooting"}))
      ->option_text("NAME");
  sub.add_option("--span", settings.span,
                 "whole traces, else single hops where a law falls (default), whole or hops")
      ->check(OneOf({"whole_else_hops", "whole", "hops"}))
      ->option_text("NAME");
  sub.add_option("--loss", settings.loss, "squared (default) or pseudo_huber")
      ->check(OneOf({"squared", "pseudo_huber"}))
      ->option_text("NAME");
  sub.add_option("--loss-scale", settings.loss_scale,
                 "Standard deviations from which pseudo_huber is linear (default 2)")
      ->check(NumberAbove0(1e6, 1e-6))
      ->option_text("NUMBER");
  AddDiscrepancyOption(sub, settings.discrepancy);
  sub.add_option("--profile", settings.profile, "Profile likelihood of these parameters, or all")
      ->delimiter(',')
      ->option_text("NAME,...")
      ->allow_extra_args(false);
  AddRunFolderOptions(sub, settings, "Run folder (default runs/<dataset>-fit-NNN)");
}

FitRunOptions FitRunOptionsOf(const FitSettings& settings) {
  FitRunOptions options;
  options.problem = ProblemOptionsOf(settings.problem);
  options.fit.strategy = *FindStrategy(settings.strategy);
  options.span = *FindSpan(settings.span);
  options.fit.restarts = settings.restarts;
  options.fit.seed = settings.seed;
  options.fit.loss = {settings.loss == "squared" ? LossKind::kSquared : LossKind::kPseudoHuber,
                      settings.loss_scale};
  options.fit.discrepancy = *FindDiscrepancy(settings.discrepancy);
  options.fit.jobs = JobsOf(settings.problem.jobs);
  options.profile = settings.profile;
  return options;
}

}  // namespace hoplab
