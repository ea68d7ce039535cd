#include "fitting/diagnosis/pool.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace hoplab {
namespace {

constexpr int kLocalWidth = 4, kMostLocal = 12;
constexpr double kLocalSlack = 2.0;  // nats a refit may change of an expected gain

// Nats an effect in one trial must promise to be among the candidates.
double LocalPrice(const Naming& naming) { return naming.local_log_odds + kLocalSlack; }

// A candidate's column cut to one trial, what the fitted values take of it projected out again.
// What a fitted value stands for in all trials (a modulus, for how stiff the leg is) is seen in
// one.
void AddLocal(Naming& naming, const Linearisation& null_at, const std::vector<TrialProblem>& train,
              std::span<const Candidate> candidates, const std::vector<Hypothesis>& hypotheses,
              const std::set<std::string>& recordings) {
  struct Local {
    std::size_t candidate;
    std::string recording;
    double gain, information;
  };
  std::vector<Local> locals;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].parameter_count() != 1) continue;
    for (const std::string& recording : recordings) {
      // Free of the initial states alone it may be cut to one trial; then the shared values are
      // taken out. (Cut after that, it would keep what the other trials' share of them left in this
      // one.)
      const int column = hypotheses[i].first;
      Eigen::VectorXd s =
          null_at.columns.col(column) + null_at.fitted_basis * null_at.along_fitted.col(column);
      for (int row = 0; row < null_at.rows(); ++row) {
        if (train[null_at.labels[row].trial].recording != recording) s[row] = 0.0;
      }
      const double whole = s.squaredNorm();
      s -= null_at.fitted_basis * (null_at.fitted_basis.transpose() * s);
      const double V = s.squaredNorm();
      if (!(V > kInseparable * whole)) continue;
      const double z = -s.dot(null_at.r) / std::sqrt(V);
      if (hypotheses[i].lower[0] >= 0.0 && z < 0.0) continue;
      if (hypotheses[i].upper[0] <= 0.0 && z > 0.0) continue;
      locals.push_back({i, recording, 0.5 * z * z, V});
    }
  }
  std::stable_sort(locals.begin(), locals.end(),
                   [](const Local& a, const Local& b) { return a.gain > b.gain; });
  double best = std::numeric_limits<double>::infinity();
  for (const Local& l : locals) {
    // Those as good as the best belong together in its group: a width alone cut the truth off.
    const std::size_t taken = naming.candidates.size() - candidates.size();
    const bool close = l.gain >= best - kIndistinguishable - kLocalSlack;
    if (taken >= kMostLocal || (taken >= kLocalWidth && !close)) break;
    // In one trial only is worth a thought if it says nearly as much as in all.
    if (l.gain < LocalPrice(naming) ||
        l.gain < 0.8 * naming.candidates[l.candidate].score.predicted_gain)
      continue;
    CandidateResult c = naming.candidates[l.candidate];
    c.candidate.only_recording = l.recording;
    c.separable = true;
    const double typical = c.candidate.Parameter(0).typical;
    c.power = typical * typical * l.information;
    c.score.predicted_gain = l.gain;
    c.score.score = 2.0 * l.gain;
    c.score.p_value = std::erfc(std::sqrt(l.gain));
    if (taken == 0) best = l.gain;
    naming.candidates.push_back(std::move(c));
  }
}

}  // namespace

void FillPool(Naming& naming, std::span<const Candidate> candidates, const Linearisation& null_at,
              const std::vector<TrialProblem>& train, const NamingOptions& options) {
  const std::vector<Hypothesis> hypotheses = HypothesesOf(candidates);
  int tested = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    CandidateResult c;
    c.candidate = candidates[i];
    c.score = ScoreOf(null_at, hypotheses[i]);
    c.has_threshold = candidates[i].effect->info.has_threshold;
    c.separable = c.score.rank > 0;
    c.power = std::numeric_limits<double>::infinity();
    for (int k = 0; k < hypotheses[i].count; ++k) {
      const double typical = candidates[i].Parameter(k).typical;
      c.power =
          std::min(c.power, typical * typical * Information(null_at, hypotheses[i].first + k));
    }
    tested += c.separable || c.has_threshold;
    naming.candidates.push_back(std::move(c));
  }
  std::set<std::string> recordings;
  for (const TrialProblem& t : train) recordings.insert(t.recording);
  // One cause is expected among all: odds of one to the number of others.
  naming.log_odds =
      std::log(static_cast<double>(std::max({tested - 1, options.picked_from - 1, 1})));
  naming.local_log_odds =
      naming.log_odds + std::log(static_cast<double>(std::max<std::size_t>(recordings.size(), 1)));
  if (options.in_one_trial && recordings.size() > 1)
    AddLocal(naming, null_at, train, candidates, hypotheses, recordings);
}

std::optional<int> ShowsBeside(const Naming& naming, int i) {
  const Candidate& candidate = naming.candidates[static_cast<std::size_t>(i)].candidate;
  for (std::size_t k = 0; k < naming.candidates.size(); ++k) {
    const Candidate& other = naming.candidates[k].candidate;
    if (other.effect->info.name == candidate.effect->info.shows_beside &&
        other.only_recording == candidate.only_recording)
      return static_cast<int>(k);
  }
  return std::nullopt;
}

}  // namespace hoplab
