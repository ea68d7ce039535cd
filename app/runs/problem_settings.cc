#include "app/runs/problem_settings.h"

#include <cmath>

#include "app/terminal/help_text.h"
#include "app/terminal/usage_error.h"
#include "base/text.h"

namespace hoplab {

void AddProblemOptions(CLI::App& sub, ProblemSettings& settings) {
  sub.add_option("DATASET", settings.dataset, "Folder with a dataset.yaml")->required();
  sub.add_option("--law", settings.law, "How the leg carries its load; see hoplab laws")
      ->option_text("LAW");
  sub.add_option("--free", settings.free, "Parameters to fit, as E,d,air_drag.c_drag")
      ->delimiter(',')
      ->option_text("NAME,...")
      ->allow_extra_args(false);
  sub.add_option("--fix", settings.fix, "name=value in SI units: hold a parameter; repeatable")
      ->delimiter(',')
      ->option_text("NAME=VALUE")
      ->allow_extra_args(false);
  sub.add_option("--with", settings.with, "Effects fitted too, by name or FILE.yaml of a formula")
      ->delimiter(',')
      ->option_text("EFFECT,...")
      ->allow_extra_args(false);
  sub.add_flag("--keep-stray", settings.keep_stray,
               "Compare samples, too, that no body can have made");
  AddSolverOptions(sub, settings.solver);
  AddJobsOption(sub, settings.jobs);
}

void AddDiscrepancyOption(CLI::App& sub, std::string& discrepancy) {
  sub.add_option("--discrepancy", discrepancy,
                 "matern (default): smooth model errors count as noise, or none")
      ->check(OneOf({"matern", "none"}))
      ->option_text("NAME");
}

std::map<std::string, double> ParseAssignments(const std::vector<std::string>& texts,
                                               const std::string& option) {
  std::map<std::string, double> values;
  for (const std::string& text : texts) {
    const std::size_t at = text.find('=');
    const std::string name(Trim(text.substr(0, at)));
    const std::optional<double> value =
        at == text.npos ? std::nullopt : ParseDouble(Trim(text.substr(at + 1)));
    if (name.empty() || !value || !std::isfinite(*value))
      throw UsageError(option + ": " + Printable(text) +
                       "; must be name=value with a number, as E=22e9");
    if (!values.emplace(name, *value).second)
      throw UsageError(option + ": " + Printable(name) + " is given twice");
  }
  return values;
}

ProblemOptions ProblemOptionsOf(const ProblemSettings& settings) {
  ProblemOptions options;
  options.law = settings.law;
  options.free = settings.free;
  options.with_effects = settings.with;
  options.keep_stray = settings.keep_stray;
  options.integrator = IntegratorOptionsOf(settings.solver);
  options.fix = ParseAssignments(settings.fix, "--fix");
  return options;
}

}  // namespace hoplab
