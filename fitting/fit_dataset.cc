#include "fitting/fit_dataset.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "fitting/apex_segments.h"
#include "fitting/carried_beginnings.h"
#include "fitting/carried_trials.h"
#include "fitting/discrepancy/estimate_discrepancy.h"
#include "fitting/followed_part.h"
#include "fitting/uncertainty.h"
#include "model/mechanism_traits.h"

namespace hoplab {

std::string_view NameOf(Segmentation span) {
  switch (span) {
    case Segmentation::kAuto:
      return "whole_else_hops";
    case Segmentation::kWhole:
      return "whole";
    case Segmentation::kHops:
      return "hops";
  }
  return "";
}

std::optional<Segmentation> FindSpan(std::string_view name) {
  for (Segmentation span : {Segmentation::kAuto, Segmentation::kWhole, Segmentation::kHops}) {
    if (NameOf(span) == name) return span;
  }
  return std::nullopt;
}

namespace {

// Whole traces that pull a value this far from what their single hops say are fitting the model's
// error, not the value.
constexpr double kDisagreement = 0.25;
constexpr int kRounds = 4;  // in which hops that cannot be simulated are left out

// Whether whole traces and hops tell value k otherwise. What may be zero has no ratio.
bool Differ(const SharedParameter& s, double whole, double hops) {
  return s.lower > 0.0 && std::abs(whole / hops - 1.0) > kDisagreement;
}

std::string DisagreementText(const SharedParameter& s, double whole, double hops,
                             const char* which) {
  char text[200];
  std::snprintf(text, sizeof text,
                "%s say %s = %.3g %s, whole traces %.3g: this law does not carry from hop to hop",
                which, s.name.c_str(), hops, s.unit.c_str(), whole);
  return text;
}

// Whether a fit knows each of its values by much less than they are told to differ.
std::vector<bool> KnownValues(const FitProblem& problem, const FitResult& fit, int jobs) {
  const Uncertainty u = AssessUncertainty(problem, TrialsOf(problem, TrialRole::kTrain), fit.shared,
                                          fit.initial_states, {}, jobs);
  std::vector<bool> known;
  for (Eigen::Index k = 0; k < fit.shared.size(); ++k) {
    const std::optional<double>& error = u.parameters[static_cast<std::size_t>(k)].std_error;
    known.push_back(error && *error < 0.5 * kDisagreement * std::abs(fit.shared[k]));
  }
  return known;
}

// The first value that whole traces and hops both know and tell otherwise. `hops`: null, those that
// the search began with, each from the apex that the data show; else hops with starts of their own.
std::string Disagreement(const DatasetFit& whole, const DatasetFit* hops, int jobs) {
  if (!whole.result.ok) return "";
  const Eigen::VectorXd& a = whole.result.shared;
  const Eigen::VectorXd& b =
      hops ? hops->result.shared : whole.result.records[whole.result.best_start].hops;
  const auto differs = [&](int k) { return Differ(whole.problem.shared[k], a[k], b[k]); };
  const int count = static_cast<int>(b.size());
  int k = 0;
  while (k < count && !differs(k)) ++k;
  if (k == count) return "";
  const std::vector<bool> by_whole = KnownValues(whole.problem, whole.result, jobs);
  const std::vector<bool> by_hops =
      hops ? KnownValues(hops->problem, hops->result, jobs) : by_whole;
  for (; k < count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (differs(k) && by_whole[at] && by_hops[at])
      return DisagreementText(
          whole.problem.shared[k], a[k], b[k],
          hops ? "single hops alone" : "hops that start at the apexes of the traces");
  }
  return "";
}

}  // namespace

DatasetFit FitDataset(const Dataset& dataset, const ProblemOptions& problem_options,
                      const FitOptions& fit_options, Segmentation span) {
  return FitTraces(MakeProblem(dataset, problem_options), fit_options, span);
}

namespace {

std::string WhyNotWhole(const DatasetFit& whole) {
  const FitResult& r = whole.result;
  if (!r.ok || !r.stop.complete)
    return "no values let the simulation last as long as the traces (" + r.message + ")";
  if (!r.stop.IsMinimum()) return "whole traces lead to no minimum (" + r.stop.faults.front() + ")";
  return whole.note;
}

std::string WhyByHop(const DatasetFit& whole, Segmentation span) {
  if (span == Segmentation::kHops)
    return "fitted hop by hop, as asked: each hop has a start of its own";
  return WhyNotWhole(whole) + ", so it was fitted hop by hop, each hop with a start of its own";
}

// Whole trials of a hopper or a ball, but for ends that cannot be simulated.
std::optional<DatasetFit> FitButForEnds(const DatasetFit& whole, const FitOptions& options) {
  if (!whole.result.ok || whole.result.stop.complete) return std::nullopt;
  std::optional<BeginningsFit> cut = FitBeginnings(whole.problem, whole.result, options);
  if (!cut) return std::nullopt;
  DatasetFit fit;
  fit.problem = std::move(cut->problem);
  fit.result = std::move(cut->result);
  fit.left_out = std::move(cut->left_out);
  if (!Disagreement(fit, nullptr, options.jobs).empty()) return std::nullopt;
  return fit;
}

// What can be fitted of the trials of a robot.
std::optional<DatasetFit> FitInPart(const DatasetFit& whole, const FitOptions& options) {
  std::optional<FollowedPart> part = FitFollowedPart(whole.problem, options);
  if (!part) return std::nullopt;
  DatasetFit fit;
  fit.problem = std::move(part->problem);
  fit.result = std::move(part->result);
  fit.until = part->until;
  char text[80];
  std::snprintf(text, sizeof text, ", so that only the first %.2f s of each trial are fitted",
                part->until);
  fit.note = WhyNotWhole(whole) + text;
  return fit;
}

}  // namespace

namespace {

// The discrepancy that suits what a fit leaves. The values stay where they are: they are those of
// least squares, and the discrepancy widens their intervals (docs/decisions/0010).
void AddDiscrepancy(DatasetFit& fit, const FitOptions& options) {
  FitResult& result = fit.result;
  if (options.discrepancy == Discrepancy::kNone || !result.ok || result.interrupted ||
      !result.stop.complete)
    return;
  const RestrictedLikelihood likelihood(fit.problem, TrialsOf(fit.problem, TrialRole::kTrain),
                                        result.shared, result.initial_states, options.jobs,
                                        LikelihoodDetail::Coarse());
  result.discrepancy = EstimateDiscrepancy(likelihood);
  fit.problem.noise = result.discrepancy->noise;
}

DatasetFit FitUnderWhiteNoise(FitProblem problem, const FitOptions& fit_options,
                              Segmentation span) {
  DatasetFit fit;
  fit.problem = std::move(problem);
  if (span != Segmentation::kHops) {
    fit.result = Fit(fit.problem, fit_options);
    fit.note = Disagreement(fit, nullptr, fit_options.jobs);
    // Where whole traces pull a value far from what their hops say, they fit the model's error.
    const bool done = fit.result.ok && fit.result.stop.IsMinimum() && fit.note.empty();
    if (done || fit.result.interrupted || span == Segmentation::kWhole) return fit;
  }
  if (span == Segmentation::kAuto && TraitsOf(fit.problem.law).lands_leg_by_leg) {
    if (std::optional<DatasetFit> part = FitInPart(fit, fit_options)) return std::move(*part);
  } else if (span == Segmentation::kAuto) {
    if (std::optional<DatasetFit> most = FitButForEnds(fit, fit_options)) return std::move(*most);
  }
  DatasetFit pieces;
  pieces.problem = SplitIntoHops(fit.problem);
  pieces.by_hop = pieces.problem.trials.size() > fit.problem.trials.size();
  // Without apexes to cut at a trial is the only piece of itself.
  if (!pieces.by_hop && span != Segmentation::kHops && fit.result.ok && fit.result.stop.complete)
    return fit;
  pieces.result = FitCarriedTrials(pieces.problem, fit_options, kRounds, pieces.left_out);
  const bool usable = pieces.result.ok && pieces.result.stop.IsMinimum();
  const bool whole_is_better = fit.result.ok && (fit.result.stop.IsMinimum() || !pieces.result.ok);
  if (!usable && span != Segmentation::kHops && whole_is_better) return fit;
  if (usable && pieces.by_hop && fit.result.ok && fit.result.stop.IsMinimum()) {
    fit.note = Disagreement(fit, &pieces, fit_options.jobs);
    if (fit.note.empty()) return fit;
  }
  if (pieces.by_hop) pieces.note = WhyByHop(fit, span);
  return pieces;
}

}  // namespace

DatasetFit FitTraces(FitProblem problem, const FitOptions& fit_options, Segmentation span) {
  DatasetFit fit = FitUnderWhiteNoise(std::move(problem), fit_options, span);
  AddDiscrepancy(fit, fit_options);
  return fit;
}

}  // namespace hoplab
