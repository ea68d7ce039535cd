#include "fitting/diagnosis/pool.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "fitting/diagnosis/in_some_trials.h"
#include "fitting/diagnosis/linearise_at.h"

namespace hoplab {
namespace {

constexpr std::size_t kScoreWidth = 4;

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
    c.power = PowerOf(null_at, candidates[i], hypotheses[i]);
    tested += c.separable || c.has_threshold;
    naming.candidates.push_back(std::move(c));
  }
  std::set<std::string> recordings;
  for (const TrialProblem& t : train) recordings.insert(t.recording);
  // One cause is expected among all: odds of one to the number of others.
  naming.log_odds =
      std::log(static_cast<double>(std::max({tested - 1, options.picked_from - 1, 1})));
  naming.recordings = static_cast<int>(recordings.size());
  std::vector<int> all(candidates.size());
  std::iota(all.begin(), all.end(), 0);
  if (options.in_some_trials) AddInSomeTrials(naming, null_at, all, train, 0.0);
}

double PowerOf(const Linearisation& at, const Candidate& candidate, const Hypothesis& hypothesis) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < hypothesis.count; ++k) {
    if (candidate.Parameter(k).is_of_first) continue;
    const double typical = candidate.Parameter(k).typical;
    least = std::min(least, typical * typical * Information(at, hypothesis.first + k));
  }
  return least;
}

std::vector<CandidateSet> BestScored(const Naming& naming) {
  std::vector<std::pair<double, int>> ranked;
  for (std::size_t i = 0; i < naming.candidates.size(); ++i) {
    if (naming.candidates[i].separable)
      ranked.emplace_back(-naming.candidates[i].score.predicted_gain, static_cast<int>(i));
  }
  std::stable_sort(ranked.begin(), ranked.end());
  if (ranked.size() > kScoreWidth) ranked.resize(kScoreWidth);
  std::vector<CandidateSet> sets;
  for (const auto& [gain, i] : ranked) sets.push_back({i});
  return sets;
}

std::vector<CandidateSet> SinglesOf(const Naming& naming, const std::set<int>* among) {
  std::vector<CandidateSet> sets;
  for (int i = 0; i < static_cast<int>(naming.candidates.size()); ++i) {
    const CandidateResult& c = naming.candidates[static_cast<std::size_t>(i)];
    const bool is_among = c.separable && (!among || among->contains(i));
    if (is_among || (c.has_threshold && !c.candidate.effect->info.slow)) sets.push_back({i});
  }
  return sets;
}

void AddFirst(const Ranking& ranked, int count, double least, std::set<int>& places) {
  for (const Promise& p : ranked) {
    if (count-- <= 0 || p.gain < least) break;
    places.insert(p.place);
  }
}

std::vector<int> PlacesBeside(const Naming& naming, const CandidateSet& set, int count) {
  const auto effect_of = [&](int i) {
    return naming.candidates[static_cast<std::size_t>(i)].candidate.effect;
  };
  std::vector<int> places;
  for (int i = 0; i < count; ++i)
    if (std::none_of(set.begin(), set.end(), [&](int m) { return effect_of(m) == effect_of(i); }))
      places.push_back(i);
  return places;
}

std::vector<Candidate> CandidatesAt(const Naming& naming, std::span<const int> places) {
  std::vector<Candidate> at;
  for (const int i : places) at.push_back(naming.candidates[static_cast<std::size_t>(i)].candidate);
  return at;
}

std::optional<int> ShowsBeside(const Naming& naming, int i) {
  const Candidate& candidate = naming.candidates[static_cast<std::size_t>(i)].candidate;
  for (std::size_t k = 0; k < naming.candidates.size(); ++k) {
    const Candidate& other = naming.candidates[k].candidate;
    if (other.effect->info.name == candidate.effect->info.shows_beside &&
        other.only_recordings == candidate.only_recordings)
      return static_cast<int>(k);
  }
  return std::nullopt;
}

std::vector<int> AlikeTo(const Ranking& without, const Ranking& whole) {
  constexpr double kOfOneKind = 0.2;  // a correlation of 0.9
  std::vector<std::pair<double, int>> alike;
  for (const Promise& beside : whole) {
    const auto alone = std::find_if(without.begin(), without.end(),
                                    [&](const Promise& p) { return p.place == beside.place; });
    if (alone == without.end() || !(alone->information > 0.0)) continue;
    const double left = beside.information / alone->information;
    if (left < kOfOneKind) alike.emplace_back(left, beside.place);
  }
  std::stable_sort(alike.begin(), alike.end());
  std::vector<int> places;
  for (const auto& [left, place] : alike) places.push_back(place);
  return places;
}

const Ranking& Rankings::Beside(const CandidateSet& set, const FittedModel& fitted) {
  const auto [known, is_first] =
      known_.try_emplace({set, fitted.problem.noise.IsWhite(), fitted.cost});
  Ranking& ranked = known->second;
  if (!is_first) return ranked;
  std::vector<int> rest = PlacesBeside(naming_, set, static_cast<int>(naming_.candidates.size()));
  std::erase_if(rest,
                [&](int i) { return !naming_.candidates[static_cast<std::size_t>(i)].separable; });
  const std::vector<Candidate> tested = CandidatesAt(naming_, rest);
  const Linearisation at = LineariseAt(fitted, tested, train_, jobs_);
  const std::vector<Hypothesis> hypotheses = HypothesesOf(tested);
  for (std::size_t i = 0; i < rest.size(); ++i)
    ranked.push_back({ScoreOf(at, hypotheses[i]).predicted_gain, rest[i],
                      hypotheses[i].count == 1 ? Information(at, hypotheses[i].first) : 0.0});
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Promise& a, const Promise& b) { return a.gain > b.gain; });
  return ranked;
}

}  // namespace hoplab
