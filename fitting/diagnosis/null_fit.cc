#include "fitting/diagnosis/null_fit.h"

#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

std::vector<Hypothesis> Shifted(std::vector<Hypothesis> hypotheses, int by) {
  for (Hypothesis& h : hypotheses) h.first += by;
  return hypotheses;
}

}  // namespace

// All tests of a linearisation whose columns are `candidates`, then the probes.
Detection Detect(const Linearisation& at, std::span<const Candidate> candidates,
                 const ProbeBasis& basis, std::uint64_t seed) {
  std::vector<Hypothesis> hypotheses = HypothesesOf(candidates);
  const std::vector<Hypothesis> probes = Shifted(basis.hypotheses, ParameterCount(candidates));
  hypotheses.insert(hypotheses.end(), probes.begin(), probes.end());
  const ScoreTests tests = TestScores(at, hypotheses, seed);
  Detection out;
  out.p_value = tests.global_p;
  out.chi2 = at.chi2();
  out.degrees_of_freedom = static_cast<int>(std::lround(at.degrees_of_freedom()));
  out.candidates = candidates.size();
  for (std::size_t i = 0; i < tests.scores.size(); ++i) {
    const Score& s = tests.scores[i];
    const std::string name =
        i < candidates.size() ? candidates[i].Name() : basis.groups[i - candidates.size()].name;
    out.tests.push_back({name, s.score, s.rank, s.p_value});
  }
  return out;
}

RefitSettings SettingsOf(const DiagnosisOptions& options, const std::vector<TrialProblem>& train) {
  RefitSettings settings;
  settings.train = &train;
  settings.jobs = options.fit.jobs;
  settings.stop = options.fit.stop;
  settings.discrepancy = options.fit.discrepancy;
  return settings;
}

DatasetFit FitPlain(FitProblem problem, const DiagnosisOptions& options, Segmentation span) {
  if (options.stage) options.stage("fitting the model as it is");
  FitOptions white = options.fit;
  white.discrepancy = Discrepancy::kNone;
  std::vector<double> noise_squares = NoiseSquares(problem);
  DatasetFit fit = FitTraces(std::move(problem), white, span);
  fit.noise_squares = std::move(noise_squares);
  return fit;
}

void BeginWith(DatasetFit fit, const DiagnosisOptions& options, Diagnosis& d,
               std::vector<TrialProblem>& train) {
  const auto stopped = [&] { return options.fit.IsStopped(); };
  const auto stage = [&](std::string_view text) {
    if (options.stage) options.stage(text);
  };
  d.by_hop = fit.by_hop;
  d.until = fit.until;
  d.noise_squares = std::move(fit.noise_squares);
  d.fit = std::move(fit.result);
  d.problem = std::move(fit.problem);
  d.notes.insert(d.notes.begin(), d.problem.notes.begin(), d.problem.notes.end());
  if (!fit.note.empty()) d.notes.push_back(fit.note);
  for (const std::string& file : fit.left_out)
    d.notes.push_back(file + ": left out, since no values found let it be simulated");
  if (stopped()) return;
  if (!d.fit.ok) {
    d.refusal = "the model without further effects cannot be fitted: " + d.fit.message;
    return;
  }
  train = TrialsOf(d.problem, TrialRole::kTrain);
  d.plain.problem = d.problem;
  d.plain.shared = d.fit.shared;
  d.plain.initial_states = d.fit.initial_states;
  d.plain.cost = d.fit.cost;
  d.plain.status = d.fit.records[static_cast<std::size_t>(d.fit.best_start)].status;
  d.plain.complete = d.fit.stop.complete;
  stage("looking for the noise that suits it");
  RefitSettings settle = SettingsOf(options, train);
  settle.discrepancy = Discrepancy::kNone;
  Settle(d.plain, settle);
  d.null = d.plain;
  settle.discrepancy = options.fit.discrepancy;
  if (settle.discrepancy != Discrepancy::kNone) Settle(d.null, settle);
  d.problem.noise = d.null.problem.noise;
  stage("checking that a diagnosis can be trusted");
  d.gate = CheckGate(d.plain, train, options.fit.jobs);
  d.refusal = d.gate.Refusal();
}

void FitNull(FitProblem problem, const DiagnosisOptions& options, Diagnosis& d,
             std::vector<TrialProblem>& train) {
  const std::vector<std::string> notes = CorrectNoise(problem);
  BeginWith(FitPlain(std::move(problem), options, options.span), options, d, train);
  d.notes.insert(d.notes.begin(), notes.begin(), notes.end());
}

}  // namespace hoplab
