#include "fitting/diagnosis/in_some_trials.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "fitting/diagnosis/pool.h"

namespace hoplab {
namespace {

constexpr int kLocalWidth = 4, kMostLocal = 12;
constexpr double kLocalSlack = 2.0;  // nats a refit may change of an expected gain
// In one trial only is worth a thought if it says nearly as much as in all.
constexpr double kNearlyAll = 0.8;
// In several with one size, if it says nearly as much as with a size of its own in each.
constexpr double kNearlyFree = 0.95;
constexpr std::size_t kFewestSome = 4, kMostSome = 40;

// A candidate in some trials, and what it promises there [nats].
struct Local {
  int place;
  Recordings recordings;
  double gain, information;
};

// What a candidate does in each of the recordings.
struct InEach {
  Eigen::MatrixXd answers;  // products of its columns cut to them
  Eigen::VectorXd whole;    // squares of these before the fitted values were taken out
  Eigen::VectorXd against;  // products with the residuals
};

InEach CutToEach(const Linearisation& at, int column, const std::vector<TrialProblem>& train,
                 const Recordings& recordings) {
  std::vector<int> group_of;
  for (const TrialProblem& t : train)
    group_of.push_back(static_cast<int>(
        std::find(recordings.begin(), recordings.end(), t.recording) - recordings.begin()));
  const auto n = static_cast<Eigen::Index>(recordings.size());
  InEach out;
  if (recordings.size() <= kMostSome) {
    const Eigen::MatrixXd cut = CutToTrials(at, column, group_of, static_cast<int>(n), &out.whole);
    out.answers = cut.transpose() * cut;
    out.against = -cut.transpose() * at.r;
    return out;
  }
  // One after the other: of many no products are asked for.
  out.answers = Eigen::MatrixXd::Zero(n, n);
  out.whole = out.against = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    std::vector<int> this_one;
    for (const int group : group_of) this_one.push_back(group == i ? 0 : -1);
    Eigen::VectorXd whole;
    const Eigen::VectorXd cut = CutToTrials(at, column, this_one, 1, &whole);
    out.answers(i, i) = cut.squaredNorm();
    out.against[i] = -cut.dot(at.r);
    out.whole[i] = whole[0];
  }
  return out;
}

// The candidate in the trials at these places. None: nothing is seen, or on the wrong side of its
// bounds.
std::optional<Local> InTrials(const InEach& each, const std::vector<Eigen::Index>& places,
                              const Hypothesis& hypothesis, const Recordings& recordings) {
  double V = 0.0, z = 0.0, whole = 0.0;
  for (const Eigen::Index i : places) {
    z += each.against[i];
    whole += each.whole[i];
    for (const Eigen::Index k : places) V += each.answers(i, k);
  }
  if (!(V > kInseparable * whole)) return std::nullopt;
  z /= std::sqrt(V);
  if (hypothesis.lower[0] >= 0.0 && z < 0.0) return std::nullopt;
  if (hypothesis.upper[0] <= 0.0 && z > 0.0) return std::nullopt;
  Local local{-1, {}, 0.5 * z * z, V};
  for (const Eigen::Index i : places)
    local.recordings.push_back(recordings[static_cast<std::size_t>(i)]);
  return local;
}

// The trials in which the candidate acts with one size, if sizes of their own are none in some and
// alike in the others; `seen` in all trials: its size in all is none of what is fitted. If it is,
// either half of the trials may be the one that it acts in.
std::vector<Local> InSeveral(const InEach& each, bool seen, const Hypothesis& hypothesis,
                             const Recordings& recordings) {
  const std::size_t n = recordings.size();
  if (n < kFewestSome || n > kMostSome || !each.answers.allFinite()) return {};
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> own;
  own.setThreshold(1e-6);
  own.compute(each.answers);
  const Eigen::VectorXd sizes = own.solve(each.against);
  const double free_gain = 0.5 * sizes.dot(each.against);
  std::vector<Eigen::Index> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return sizes[a] < sizes[b]; });
  const auto in = [&](bool largest, std::size_t k) {
    const auto first = order.begin() + static_cast<std::ptrdiff_t>(largest ? n - k : 0);
    std::vector<Eigen::Index> some(first, first + static_cast<std::ptrdiff_t>(k));
    std::sort(some.begin(), some.end());
    return InTrials(each, some, hypothesis, recordings);
  };
  const std::size_t most = seen ? n - 1 : n / 2;
  std::vector<Local> best;
  for (std::size_t k = 2; k <= most; ++k) {
    const bool halves = !seen && 2 * k == n;
    for (const bool largest : {false, true}) {
      std::optional<Local> local = in(largest, k);
      if (!local) continue;
      const bool other_half =
          halves && largest && !best.empty() && best.front().recordings.size() == k;
      if (!other_half && !best.empty() && best.front().gain >= local->gain) continue;
      if (!other_half) best.clear();
      best.push_back(std::move(*local));
    }
  }
  if (best.empty() || best.front().gain < kNearlyFree * free_gain) return {};
  return best;
}

bool IsThere(const Naming& naming, const Local& l) {
  const Effect* effect = naming.candidates[static_cast<std::size_t>(l.place)].candidate.effect;
  return std::any_of(
      naming.candidates.begin(), naming.candidates.end(), [&](const CandidateResult& c) {
        return c.candidate.effect == effect && c.candidate.only_recordings == l.recordings;
      });
}

void Add(Naming& naming, const Local& l) {
  CandidateResult c = naming.candidates[static_cast<std::size_t>(l.place)];
  c.candidate.only_recordings = l.recordings;
  c.separable = true;
  const double typical = c.candidate.Parameter(0).typical;
  c.power = typical * typical * l.information;
  c.score.predicted_gain = l.gain;
  c.score.score = 2.0 * l.gain;
  c.score.p_value = std::erfc(std::sqrt(l.gain));
  naming.candidates.push_back(std::move(c));
}

bool AddBest(Naming& naming, std::vector<Local> locals) {
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

}  // namespace

bool AddInSomeTrials(Naming& naming, const Linearisation& at, std::span<const int> places,
                     const std::vector<TrialProblem>& train, double least_gain) {
  Recordings recordings;
  for (const TrialProblem& t : train)
    if (recordings.empty() || !Holds(recordings, t.recording)) recordings.push_back(t.recording);
  if (recordings.size() < 2) return false;
  const std::vector<Candidate> tested = CandidatesAt(naming, places);
  const std::vector<Hypothesis> hypotheses = HypothesesOf(tested);
  std::vector<Local> single, several;
  for (std::size_t i = 0; i < tested.size(); ++i) {
    if (tested[i].parameter_count() != 1) continue;
    const Score in_all = ScoreOf(at, hypotheses[i]);
    const InEach each = CutToEach(at, hypotheses[i].first, train, recordings);
    double in_one = 0.0;
    const auto pays = [&](Local& local) {
      local.place = places[i];
      Candidate candidate = tested[i];
      candidate.only_recordings = local.recordings;
      return local.gain >= std::max({naming.LogOdds(candidate) + kLocalSlack, least_gain,
                                     kNearlyAll * in_all.predicted_gain});
    };
    for (Eigen::Index k = 0; k < std::ssize(recordings); ++k) {
      std::optional<Local> local = InTrials(each, {k}, hypotheses[i], recordings);
      if (!local) continue;
      in_one = std::max(in_one, local->gain);
      if (pays(*local)) single.push_back(std::move(*local));
    }
    for (Local& local : InSeveral(each, in_all.rank > 0, hypotheses[i], recordings)) {
      // Less picking says as much.
      if (pays(local) && local.gain > std::max(in_one, in_all.predicted_gain) + kIndistinguishable)
        several.push_back(std::move(local));
    }
  }
  const bool added = AddBest(naming, std::move(single));
  return AddBest(naming, std::move(several)) || added;
}

}  // namespace hoplab
