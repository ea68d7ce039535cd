#include "fitting/diagnosis/in_one_trial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>

#include "fitting/diagnosis/pool.h"

namespace hoplab {
namespace {

constexpr int kLocalWidth = 4, kMostLocal = 12;
constexpr double kLocalSlack = 2.0;  // nats a refit may change of an expected gain
// In one trial only is worth a thought if it says nearly as much as in all.
constexpr double kNearlyAll = 0.8;

// A candidate in one trial, and what it promises there [nats].
struct Local {
  int place;
  std::string recording;
  double gain, information;
};

// The column of a candidate cut to one trial, what the fitted values take of it projected out
// again. What a fitted value stands for in all trials (a modulus, for how stiff the leg is) is seen
// in one. None: nothing is seen, or on the wrong side of its bounds.
std::optional<Local> InTrial(const Linearisation& at, const Hypothesis& hypothesis,
                             const std::vector<TrialProblem>& train, const std::string& recording) {
  // Free of the initial states alone it may be cut to one trial; then the shared values are taken
  // out. (Cut after that, it would keep what the other trials' share of them left in this one.)
  const int column = hypothesis.first;
  Eigen::VectorXd s = at.columns.col(column) + at.fitted_basis * at.along_fitted.col(column);
  for (int row = 0; row < at.rows(); ++row) {
    if (train[at.labels[row].trial].recording != recording) s[row] = 0.0;
  }
  const double whole = s.squaredNorm();
  s -= at.fitted_basis * (at.fitted_basis.transpose() * s);
  const double V = s.squaredNorm();
  if (!(V > kInseparable * whole)) return std::nullopt;
  const double z = -s.dot(at.r) / std::sqrt(V);
  if (hypothesis.lower[0] >= 0.0 && z < 0.0) return std::nullopt;
  if (hypothesis.upper[0] <= 0.0 && z > 0.0) return std::nullopt;
  return Local{-1, recording, 0.5 * z * z, V};
}

bool IsThere(const Naming& naming, const Local& l) {
  const Effect* effect = naming.candidates[static_cast<std::size_t>(l.place)].candidate.effect;
  return std::any_of(
      naming.candidates.begin(), naming.candidates.end(), [&](const CandidateResult& c) {
        return c.candidate.effect == effect && c.candidate.only_recording == l.recording;
      });
}

void Add(Naming& naming, const Local& l) {
  CandidateResult c = naming.candidates[static_cast<std::size_t>(l.place)];
  c.candidate.only_recording = l.recording;
  c.separable = true;
  const double typical = c.candidate.Parameter(0).typical;
  c.power = typical * typical * l.information;
  c.score.predicted_gain = l.gain;
  c.score.score = 2.0 * l.gain;
  c.score.p_value = std::erfc(std::sqrt(l.gain));
  naming.candidates.push_back(std::move(c));
}

}  // namespace

bool AddInOneTrial(Naming& naming, const Linearisation& at, std::span<const int> places,
                   const std::vector<TrialProblem>& train, double least_gain) {
  std::set<std::string> recordings;
  for (const TrialProblem& t : train) recordings.insert(t.recording);
  if (recordings.size() < 2) return false;
  const std::vector<Candidate> tested = CandidatesAt(naming, places);
  const std::vector<Hypothesis> hypotheses = HypothesesOf(tested);
  const double price = std::max(naming.local_log_odds + kLocalSlack, least_gain);
  std::vector<Local> locals;
  for (std::size_t i = 0; i < tested.size(); ++i) {
    if (tested[i].parameter_count() != 1) continue;
    const double in_all = ScoreOf(at, hypotheses[i]).predicted_gain;
    for (const std::string& recording : recordings) {
      std::optional<Local> local = InTrial(at, hypotheses[i], train, recording);
      if (!local) continue;
      local->place = places[i];
      if (local->gain >= std::max(price, kNearlyAll * in_all)) locals.push_back(std::move(*local));
    }
  }
  std::stable_sort(locals.begin(), locals.end(),
                   [](const Local& a, const Local& b) { return a.gain > b.gain; });
  double best = std::numeric_limits<double>::infinity();
  int taken = 0, added = 0;
  for (const Local& l : locals) {
    // Those as good as the best belong together in its group: a width alone cut the truth off.
    const bool close = l.gain >= best - kIndistinguishable - kLocalSlack;
    if (taken >= kMostLocal || (taken >= kLocalWidth && !close)) break;
    if (taken++ == 0) best = l.gain;
    if (IsThere(naming, l)) continue;
    Add(naming, l);
    ++added;
  }
  return added > 0;
}

}  // namespace hoplab
