#include "app/records/fit_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "base/text.h"

namespace hoplab {
namespace {

// A loading below this is not worth a reader's time.
constexpr double kSmallLoading = 0.1;

std::string LoadingsText(const FitProblem& problem, const WeakDirection& weak) {
  std::vector<std::string> parts;
  std::string only;
  for (int i = 0; i < problem.shared_count(); ++i) {
    if (std::abs(weak.loadings[i]) < kSmallLoading) continue;
    only = problem.shared[i].name;
    parts.push_back(fmt::format("{:+.2f} {}", weak.loadings[i], only));
  }
  if (parts.size() == 1) return only;
  return Join(parts, " ");
}

// Stiffnesses that ended far from where they began, of a model that misses something: a leg that
// carries nothing, or all, may stand for what is missing.
void AddFarStiffnesses(const FitRun& run, std::vector<std::string>& remarks) {
  constexpr double kFar = 10.0;
  if (!run.uncertainty || !run.uncertainty->misfit) return;
  for (int i = 0; i < run.problem.shared_count(); ++i) {
    const SharedParameter& s = run.problem.shared[static_cast<std::size_t>(i)];
    const bool stiffness = s.name == "E" || s.name == "k" || s.name.starts_with("E_");
    const double ratio = run.fit.shared[i] / s.initial;
    if (!stiffness || (ratio < kFar && ratio > 1.0 / kFar)) continue;
    remarks.push_back(
        fmt::format("{} ended {} times {} than it began: the model misses something, and this "
                    "value may make up for it; do not use it (hoplab diagnose)",
                    s.name, Significant(ratio > 1.0 ? ratio : 1.0 / ratio, 2),
                    ratio > 1.0 ? "stiffer" : "softer"));
  }
}

}  // namespace

std::string MisfitLine(const FitProblem& problem, const Uncertainty& u) {
  if (!problem.noise.IsWhite()) {
    return fmt::format(
        "the model misses more than the noise (chi2 {} per sample, 1 expected): a smooth error of "
        "{} is left; the intervals hold if it is random, not if a cause is missing (hoplab "
        "diagnose)",
        Significant(u.chi2_per_dof, 3), LeftText(problem));
  }
  const bool between = std::any_of(u.parameters.begin(), u.parameters.end(),
                                   [](const auto& p) { return p.ci95_between_trials.has_value(); });
  return fmt::format(
      "the model misses more than the noise (chi2 {} per sample, 1 expected): the interval from "
      "noise alone is too narrow{}",
      Significant(u.chi2_per_dof, 3), between ? ", go by the one beside it" : "");
}

std::vector<std::string> Remarks(const FitRun& run) {
  std::vector<std::string> remarks;
  AddFarStiffnesses(run, remarks);
  for (const TrialErrors& t : run.trials) {
    if (!t.complete) {
      remarks.push_back(
          IsComplete(t.outcome)
              ? t.file + ": the simulation makes other contacts than the trace; no error computed"
              : fmt::format("{}: the simulation {} at {} s; no error computed", t.file,
                            SentenceOf(t.outcome), Fixed(t.end_time, 3)));
    }
    if (run.problem.law == Law::kLargeDeflection && t.max_deflection_ratio > kMaxDeflectionRatio) {
      remarks.push_back(
          fmt::format("{}: the leg bends to F C/l0 = {}; beyond {} the law large_deflection is not "
                      "to be trusted",
                      t.file, Significant(t.max_deflection_ratio, 2), kMaxDeflectionRatio));
    }
  }
  return remarks;
}

std::string DeterminedLine(const FitProblem& problem, const Uncertainty& uncertainty,
                           const std::string& at) {
  const Identifiability& id = uncertainty.identifiability;
  std::vector<std::string> unseen, weak, bound;
  for (const WeakDirection& direction : id.weak_directions) {
    const std::string loadings = LoadingsText(problem, direction);
    if (direction.eigenvalue == 0.0) {
      unseen.push_back(loadings);
    } else {
      weak.push_back(fmt::format("{} (to {} of its size)", loadings,
                                 Significant(1.0 / std::sqrt(direction.eigenvalue), 2)));
    }
  }
  for (int i = 0; i < problem.shared_count(); ++i) {
    if (uncertainty.parameters[i].at_bound) bound.push_back(problem.shared[i].name);
  }
  std::vector<std::string> parts;
  if (!unseen.empty()) parts.push_back("the data say nothing about " + Join(unseen, "; "));
  if (!weak.empty()) parts.push_back("weakly: " + Join(weak, "; "));
  if (!bound.empty()) parts.push_back("taken as given, being at a bound: " + Join(bound));
  if (unseen.empty() && weak.empty()) {
    parts.insert(parts.begin(),
                 bound.size() == problem.shared.size()
                     ? "nothing"
                     : fmt::format("{}, nothing weakly{} (condition number {})",
                                   bound.empty() ? "every parameter" : "every other parameter", at,
                                   Significant(id.condition_number, 2)));
  } else {
    parts.back() += at;
  }
  return Join(parts, "; ");
}

std::string CertificateLine(const std::optional<GradientCertificate>& certificate) {
  if (!certificate || !std::isfinite(certificate->max_relative_error)) return "not computed";
  std::string text = fmt::format("analytic and Richardson differences agree to {:.1e} (worst: {})",
                                 certificate->max_relative_error, certificate->worst_parameter);
  if (!certificate->flags.empty()) {
    const CertificateFlag& first = certificate->flags.front();
    text +=
        fmt::format("; {}, as {}: {}", Plural(static_cast<long>(certificate->flags.size()), "flag"),
                    first.trial, first.text);
  }
  return text;
}

std::string LeftText(const FitProblem& problem) {
  std::vector<std::string> parts;
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    const double amplitude = problem.noise.AmplitudeOf(c) * problem.channels[c].sigma;
    if (!(amplitude > 0.0)) continue;
    const std::string name(NameOf(problem.channels[c].channel));
    parts.push_back(WithoutUnit(name) + " " +
                    ErrorText(amplitude, ChannelUnit(*ChannelFromName(name))));
  }
  return fmt::format("{} over {} ms", Join(parts), Significant(1e3 * problem.noise.time_scale, 2));
}

}  // namespace hoplab
