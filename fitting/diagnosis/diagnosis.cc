#include "fitting/diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "base/parallel.h"

namespace hoplab {
namespace {

// Streams of the seed.
constexpr std::uint64_t kDetectionStream = 11, kRemainderStream = 12, kBootstrapStream = 13,
                        kForcesStream = 14;

std::vector<Hypothesis> Shifted(std::vector<Hypothesis> hypotheses, int by) {
  for (Hypothesis& h : hypotheses) h.first += by;
  return hypotheses;
}

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
  out.degrees_of_freedom = at.degrees_of_freedom();
  out.candidates = candidates.size();
  for (std::size_t i = 0; i < tests.scores.size(); ++i) {
    const Score& s = tests.scores[i];
    const std::string name =
        i < candidates.size() ? candidates[i].Name() : basis.groups[i - candidates.size()].name;
    out.tests.push_back({name, s.score, s.rank, s.p_value});
  }
  return out;
}

// The columns of the candidates alone, out of a linearisation that has the probes' too.
Linearisation CandidatesOnly(Linearisation at, int columns) {
  at.columns.conservativeResize(Eigen::NoChange, columns);
  at.along_fitted.conservativeResize(Eigen::NoChange, columns);
  at.length.conservativeResize(columns);
  return at;
}

// Whether some free force gains more than it must: the chi-square its dimensions reach once in
// twenty searches over all groups.
bool FreeForcePays(const Detection& detection) {
  const std::size_t groups = detection.tests.size() - detection.candidates;
  for (std::size_t i = detection.candidates; i < detection.tests.size(); ++i) {
    if (detection.tests[i].p_value < 0.05 / static_cast<double>(std::max<std::size_t>(groups, 1)))
      return true;
  }
  return false;
}

std::vector<Movement> MovementsOf(const Extension& null, const Uncertainty& uncertainty,
                                  const Extension& best) {
  std::vector<Movement> movements;
  for (int k = 0; k < null.problem.shared_count(); ++k) {
    const SharedParameter& s = null.problem.shared[static_cast<std::size_t>(k)];
    Movement m{s.name, s.unit, null.shared[k], best.shared[k], std::nullopt};
    const auto& error = uncertainty.parameters[static_cast<std::size_t>(k)].std_error;
    if (error && *error > 0.0) m.std_errors = (m.after - m.before) / *error;
    movements.push_back(std::move(m));
  }
  return movements;
}

bool Has(const Extension& e, const Candidate& c) {
  return std::any_of(e.members.begin(), e.members.end(),
                     [&](const Candidate& m) { return m.effect == c.effect; });
}

std::string NamesOf(const Extension& e) {
  std::string names;
  for (const Candidate& c : e.members) names += (names.empty() ? "" : " + ") + c.Name();
  return names;
}

class Pipeline {
 public:
  Pipeline(const Dataset& dataset, const DiagnosisOptions& options)
      : dataset_(dataset), options_(options) {}

  Diagnosis Run() {
    FitProblem problem = MakeProblem(dataset_, options_.problem);
    const std::vector<Candidate> candidates = CandidatesOf(problem, options_.candidates);
    FitNull(std::move(problem));
    if (!d_.refusal.empty() || Stopped()) return Finish();
    Look(candidates);
    if (Stopped()) return Finish();
    if (d_.detection.p_value <= kDetectionLevel) Name(candidates);
    if (Stopped()) return Finish();
    Stage("measuring on held-out trials");
    d_.before = MeasureHeldOut(d_.null, options_.fit.jobs);
    if (!d_.naming.best.members.empty()) Extended(candidates);
    if (Stopped()) return Finish();
    Judge();
    return Finish();
  }

 private:
  bool Stopped() const { return options_.fit.stop && *options_.fit.stop; }
  void Stage(std::string_view text) const {
    if (options_.stage) options_.stage(text);
  }
  std::uint64_t Seed(std::uint64_t stream) const { return options_.fit.seed * 64 + stream; }
  Diagnosis Finish() {
    d_.interrupted = Stopped();
    return std::move(d_);
  }

  // ---- gate
  void FitNull(FitProblem problem) {
    d_.notes = CorrectNoise(problem);
    Stage("fitting the model as it is");
    DatasetFit fit = FitTraces(std::move(problem), options_.fit, options_.span);
    d_.by_hop = fit.by_hop;
    d_.fit = std::move(fit.result);
    d_.problem = std::move(fit.problem);
    d_.notes.insert(d_.notes.begin(), d_.problem.notes.begin(), d_.problem.notes.end());
    if (!fit.note.empty()) d_.notes.push_back(fit.note);
    if (Stopped()) return;
    if (!d_.fit.ok) {
      d_.refusal = "the model without further effects cannot be fitted: " + d_.fit.message;
      return;
    }
    train_ = TrialsOf(d_.problem, TrialRole::kTrain);
    d_.null.problem = d_.problem;
    d_.null.shared = d_.fit.shared;
    d_.null.starts = d_.fit.starts;
    d_.null.cost = d_.fit.cost;
    d_.null.status = d_.fit.records[static_cast<std::size_t>(d_.fit.best_start)].status;
    Stage("checking that a diagnosis can be trusted");
    d_.gate = CheckGate(d_.null, train_, options_.fit.jobs);
    d_.refusal = d_.gate.Refusal();
  }

  // ---- detect, localise
  void Look(const std::vector<Candidate>& candidates) {
    Stage("looking for what the simulation gets wrong");
    basis_ = ProbesOf(d_.problem.law);
    std::vector<Candidate> all = candidates;
    all.insert(all.end(), basis_.probes.begin(), basis_.probes.end());
    const Linearisation at = LineariseAt(d_.null, all, train_, options_.fit.jobs);
    NoteFailed(at);
    d_.detection = Detect(at, candidates, basis_, Seed(kDetectionStream));
    d_.localisation = Localise(at);
    d_.null_at = CandidatesOnly(at, ParameterCount(candidates));
    d_.uncertainty = AssessUncertainty(d_.problem, train_, d_.null.shared, d_.null.starts,
                                       options_.fit.loss, options_.fit.jobs);
    if (d_.detection.p_value > kDetectionLevel) {
      // Nothing to name; what each candidate could have shown is still told.
      NamingOptions none;
      none.max_effects = 0;
      d_.naming = NameCauses(d_.null, candidates, d_.null_at, train_, none);
    }
  }

  void NoteFailed(const Linearisation& at) {
    std::string names;
    for (const std::string& name : at.failed) names += (names.empty() ? "" : ", ") + name;
    if (!names.empty())
      d_.notes.push_back("not tested, since no simulation could be differentiated by it: " + names);
  }

  // ---- name
  void Name(const std::vector<Candidate>& candidates) {
    Stage("refitting with every candidate cause");
    NamingOptions naming;
    naming.max_effects = options_.max_effects;
    naming.jobs = options_.fit.jobs;
    naming.stop = options_.fit.stop;
    if (options_.step) {
      naming.progress = [&](int refits, int of, std::string_view what) {
        options_.step("refit " + std::to_string(refits) + " of " + std::to_string(of) + ": " +
                          std::string(what),
                      refits, of);
      };
    }
    d_.naming = NameCauses(d_.null, candidates, d_.null_at, train_, naming);
  }

  // ---- extend, measure
  void Extended(const std::vector<Candidate>& candidates) {
    const Extension& best = d_.naming.best;
    ExtensionReport report;
    report.uncertainty = AssessUncertainty(best.problem, train_, best.shared, best.starts,
                                           options_.fit.loss, options_.fit.jobs);
    report.after = MeasureHeldOut(best, options_.fit.jobs);
    report.gain =
        CompareHeldOut(d_.null, d_.before, report.after, Seed(kBootstrapStream), &report.left_out);
    report.movements = MovementsOf(d_.null, d_.uncertainty, best);
    std::vector<Candidate> others;
    for (const Candidate& c : candidates) {
      if (!Has(best, c)) others.push_back(c);
    }
    std::vector<Candidate> all = others;
    all.insert(all.end(), basis_.probes.begin(), basis_.probes.end());
    const Linearisation at = LineariseAt(best, all, train_, options_.fit.jobs);
    report.remainder = Detect(at, others, basis_, Seed(kRemainderStream));
    const double excess = d_.detection.chi2 - d_.detection.degrees_of_freedom;
    const double left = report.remainder.chi2 - report.remainder.degrees_of_freedom;
    report.explained = excess > 0.0 ? std::clamp(1.0 - left / excess, 0.0, 1.0) : 1.0;
    for (std::size_t i = 0; i < best.members.size(); ++i)
      report.at_bound = report.at_bound || best.AtPhysicalBound(static_cast<int>(i));
    d_.extension = std::move(report);

    d_.candidate_gains.resize(d_.naming.candidates.size());
    ParallelFor(static_cast<int>(d_.candidate_gains.size()), options_.fit.jobs, [&](int i) {
      const CandidateResult& c = d_.naming.candidates[static_cast<std::size_t>(i)];
      // What gained nothing on the fitted trials has nothing to show on the others.
      if (!c.alone.ok() || c.gain < 1.0 || Stopped()) return;
      d_.candidate_gains[static_cast<std::size_t>(i)] = CompareHeldOut(
          d_.null, d_.before, MeasureHeldOut(c.alone, 1), Seed(kBootstrapStream), nullptr);
    });
    for (const std::vector<Extension>& rivals : d_.naming.rivals) {
      if (rivals.size() < 2 || d_.experiment) continue;
      Stage("looking for the trial that would tell the causes apart");
      d_.experiment = ProposeExperiment(rivals, train_, options_.fit.jobs);
    }
  }

  // ---- verdict
  void Judge() {
    const Detection& seen = d_.detection;
    if (seen.p_value > kDetectionLevel) {
      d_.verdict = Verdict::kAdequate;
      d_.reason = "no test stands out of what noise alone gives";
      return;
    }
    if (!d_.extension) {
      if (FreeForcePays(seen)) {
        d_.verdict = Verdict::kUnexplained;
        d_.reason =
            "a free force or reading is needed, and no effect of the catalogue pays for "
            "its parameters";
        DescribeFreely(d_.null);
      } else {
        d_.verdict = Verdict::kAdequate;
        d_.reason = "a test stands out, but no effect gains what it must";
      }
      return;
    }
    const ExtensionReport& e = *d_.extension;
    const bool remains = e.SomeRemains();
    if (e.at_bound) {
      d_.verdict = Verdict::kUnexplained;
      d_.reason = "the best extension, " + NamesOf(d_.naming.best) +
                  ", needs a size beyond what is physical";
    } else if (remains && e.explained < kExplained) {
      d_.verdict = Verdict::kUnexplained;
      char text[96];
      std::snprintf(text, sizeof text, " explains only %.0f %% of the misfit", 100.0 * e.explained);
      d_.reason = "the best extension, " + NamesOf(d_.naming.best) + "," + text;
    } else {
      bool alone = true;
      for (const std::vector<int>& group : d_.naming.groups) alone = alone && group.size() == 1;
      d_.verdict = alone ? Verdict::kNamed : Verdict::kConfounded;
      d_.reason = alone ? "nothing else in the catalogue does as well"
                        : "several effects do as well within the noise";
      if (e.InDoubt()) d_.reason += remains ? "; some misfit remains" : "; some misfit may remain";
    }
    if (d_.verdict == Verdict::kUnexplained || remains) DescribeFreely(d_.naming.best);
  }

  void DescribeFreely(const Extension& model) {
    const Linearisation at = LineariseAt(model, basis_.probes, train_, options_.fit.jobs);
    d_.free_forces = Reconstruct(at, basis_, Seed(kForcesStream));
  }

  const Dataset& dataset_;
  const DiagnosisOptions& options_;
  Diagnosis d_;
  ProbeBasis basis_;
  std::vector<TrialProblem> train_;
};

}  // namespace

std::string_view NameOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kAdequate:
      return "adequate";
    case Verdict::kNamed:
      return "named";
    case Verdict::kConfounded:
      return "confounded";
    case Verdict::kUnexplained:
      return "unexplained";
  }
  return "";
}

std::optional<int> Diagnosis::Cause() const {
  std::optional<int> cause;
  double most = -std::numeric_limits<double>::infinity();
  for (const std::vector<int>& group : naming.groups) {
    const int member = group.front();
    const double gain = naming.candidates[static_cast<std::size_t>(member)].gain;
    if (gain > most) {
      most = gain;
      cause = member;
    }
  }
  return cause;
}

Diagnosis Diagnose(const Dataset& dataset, const DiagnosisOptions& options) {
  return Pipeline(dataset, options).Run();
}

}  // namespace hoplab
