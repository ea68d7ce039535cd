#include "fitting/fit_dataset.h"

#include <cmath>
#include <cstdio>

#include "fitting/apex_segments.h"

namespace hoplab {

std::string_view NameOf(FitSpan span) {
  switch (span) {
    case FitSpan::kWholeElseHops:
      return "whole_else_hops";
    case FitSpan::kWhole:
      return "whole";
    case FitSpan::kHops:
      return "hops";
  }
  return "";
}

std::optional<FitSpan> FindSpan(std::string_view name) {
  for (FitSpan span : {FitSpan::kWholeElseHops, FitSpan::kWhole, FitSpan::kHops}) {
    if (NameOf(span) == name) return span;
  }
  return std::nullopt;
}

namespace {

// Whole traces that pull a value this far from what their single hops say are fitting the model's
// error, not the value.
constexpr double kDisagreement = 0.25;

std::string Disagreement(const FitProblem& problem, const FitResult& fit) {
  if (!fit.ok) return "";
  const Eigen::VectorXd& hops = fit.records[fit.best_start].hops;
  for (int k = 0; k < hops.size(); ++k) {
    const SharedParameter& s = problem.shared[k];
    // What may be zero has no ratio.
    if (s.lower <= 0.0 || std::abs(fit.shared[k] / hops[k] - 1.0) <= kDisagreement) continue;
    char text[160];
    std::snprintf(text, sizeof text,
                  "single hops alone say %s = %.3g %s, whole traces %.3g: this law does not carry "
                  "from hop to hop",
                  s.name.c_str(), hops[k], s.unit.c_str(), fit.shared[k]);
    return text;
  }
  return "";
}

}  // namespace

DatasetFit FitDataset(const Dataset& dataset, const ProblemOptions& problem_options,
                      const FitOptions& fit_options, FitSpan span) {
  return FitTraces(MakeProblem(dataset, problem_options), fit_options, span);
}

DatasetFit FitTraces(FitProblem problem, const FitOptions& fit_options, FitSpan span) {
  DatasetFit fit;
  fit.problem = std::move(problem);
  if (span != FitSpan::kHops) {
    fit.result = Fit(fit.problem, fit_options);
    fit.note = Disagreement(fit.problem, fit.result);
    if (fit.result.ok || fit.result.interrupted || span == FitSpan::kWhole) return fit;
  }
  FitProblem hops = SplitIntoHops(fit.problem);
  if (hops.trials.size() == fit.problem.trials.size()) {
    if (span == FitSpan::kHops) fit.result = Fit(fit.problem, fit_options);
    return fit;  // no apexes to cut at
  }
  FitResult by_hop = Fit(hops, fit_options);
  if (!by_hop.ok && span != FitSpan::kHops) return fit;
  fit.by_hop = true;
  fit.note = span == FitSpan::kHops
                 ? "fitted hop by hop, as asked: each hop has a start of its own"
                 : "no values let the simulation last as long as the traces (" +
                       fit.result.message +
                       "), so it was fitted hop by hop, each hop with a start of its own";
  fit.problem = std::move(hops);
  fit.result = std::move(by_hop);
  return fit;
}

}  // namespace hoplab
