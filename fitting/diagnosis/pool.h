#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "fitting/diagnosis/name.h"

namespace hoplab {

/// Begins a search: the given candidates with their scores at the null fit, then those of single
/// trials that promise nearly as much as in all, and what a parameter of each must gain.
void FillPool(Naming& naming, std::span<const Candidate> candidates, const Linearisation& null_at,
              const std::vector<TrialProblem>& train, const NamingOptions& options);

/// Noncentrality of a typical size, typical^2 V, of the candidate's parameter that shows least;
/// `hypothesis`: its columns.
double PowerOf(const Linearisation& at, const Candidate& candidate, const Hypothesis& hypothesis);

/// The candidates of the best scores under the null fit's own noise, each alone.
std::vector<CandidateSet> BestScored(const Naming& naming);

/// Places, among the first `count` candidates, of those whose effect does not act in the set.
std::vector<int> PlacesBeside(const Naming& naming, const CandidateSet& set, int count);

std::vector<Candidate> CandidatesAt(const Naming& naming, std::span<const int> places);

/// The candidate without which candidate i hardly shows (EffectInfo::shows_beside).
std::optional<int> ShowsBeside(const Naming& naming, int i);

/// What the linear model promises of a candidate beside a set.
struct Promise {
  double gain;         // nats
  int place;           // in the pool
  double information;  // of its size, where it has one parameter; else 0
};
/// The best first.
using Ranking = std::vector<Promise>;

/// The sets of one candidate that are worth a refit: of those that can be told from the fitted
/// values all, or `among` them; and those beyond a threshold, but for slow ones.
std::vector<CandidateSet> SinglesOf(const Naming& naming, const std::set<int>* among);

/// Adds the places of the first `count`, as long as they promise `least` nats.
void AddFirst(const Ranking& ranked, int count, double least, std::set<int>& places);

/// Candidates that move the data as one member of a set does: beside the whole set little is left
/// of what tells their size beside the set `without` it. The most alike first.
std::vector<int> AlikeTo(const Ranking& without, const Ranking& whole);

/// What the linear model promises of candidates beside a fitted set; of the same fit it is asked
/// more than once.
class Rankings {
 public:
  /// All arguments have to outlive this.
  Rankings(const Naming& naming, const std::vector<TrialProblem>& train, int jobs)
      : naming_(naming), train_(train), jobs_(jobs) {}
  /// Members of the pool that are not in the set and can be told from what is fitted. Valid until
  /// Clear.
  const Ranking& Beside(const CandidateSet& set, const FittedModel& fitted);
  /// The pool has changed.
  void Clear() { known_.clear(); }

 private:
  const Naming& naming_;
  const std::vector<TrialProblem>& train_;
  int jobs_;
  // By set, whether under white noise, and the cost of its fit, which is that of least squares
  // under any noise.
  std::map<std::tuple<CandidateSet, bool, double>, Ranking> known_;
};

}  // namespace hoplab
