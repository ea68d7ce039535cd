#pragma once

#include <limits>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "fitting/diagnosis/name.h"

namespace hoplab {

/// The models a search has fitted so far, each once. What it holds does not depend on the number
/// of jobs.
///
/// A model is first tried: refitted under white noise from its best known part. (Under the noise of
/// a part that lacks a cause, that cause is part of the noise, and a search for it goes astray.)
/// Those that promise are settled: their own noise is sought, and their evidence.
class Refits {
 public:
  /// All arguments have to outlive this. `plain` is the null fit under white noise, `null` settled.
  /// `naming` gives the candidates and counts the refits.
  Refits(const FittedModel& plain, const FittedModel& null, const std::vector<TrialProblem>& train,
         const NamingOptions& options, Naming& naming);

  /// A model under the noise that suits it, or, if it is not settled, under white noise.
  const FittedModel& At(const CandidateSet& set) const {
    if (set.empty()) return null_;
    const Entry& entry = models_.at(set);
    return entry.settled.settled ? entry.settled : entry.white;
  }
  /// A model under white noise.
  const FittedModel& White(const CandidateSet& set) const {
    return set.empty() ? plain_ : models_.at(set).white;
  }
  bool Has(const CandidateSet& set) const { return set.empty() || models_.count(set) > 0; }
  bool Usable(const CandidateSet& set) const { return Has(set) && White(set).ok(); }
  bool Settled(const CandidateSet& set) const {
    return Has(set) && At(set).ok() && At(set).settled;
  }
  /// Whether the candidate was fitted, alone or beside others.
  bool WasTried(int candidate) const;
  /// Logarithm of the posterior weight of a settled model [nats], of all models' common constant.
  /// Where the data want more of a cause than it can be, its size ends at a physical bound; a true
  /// cause hardly ever does, and its set counts for less.
  double Worth(const CandidateSet& set) const;
  /// Log-likelihood a model gains over the null fit, both under white noise [nats].
  double Gain(const CandidateSet& set) const { return plain_.cost - White(set).cost; }

  /// Whether it has no more causes than are asked for.
  bool MayBeTold(const CandidateSet& set) const {
    return static_cast<int>(set.size()) <= options_.max_effects;
  }
  /// Of those that may be told: tries them, settles the `width` that gain most under white noise
  /// and those in `anyway`, and gives the best of them and `current`.
  CandidateSet Better(CandidateSet current, const std::vector<CandidateSet>& sets, int width,
                      const std::vector<CandidateSet>& anyway = {});
  /// Takes in a model that was fitted elsewhere to the same trials; the set of its causes, empty
  /// where one of them is no candidate.
  CandidateSet Adopt(const FittedModel& model);
  /// Refits the models not tried yet, in parallel.
  void Try(const std::vector<CandidateSet>& sets);
  void SettleAll(const std::vector<CandidateSet>& sets);
  /// The parts of a model with one member less, from the whole and from what is known of them.
  std::vector<CandidateSet> SettleParts(const CandidateSet& set);
  /// The part that is worth most, if that is more than the model is; a model with more than `most`
  /// members has to give one up.
  CandidateSet BestPart(const CandidateSet& set, int most = std::numeric_limits<int>::max());

  /// The same of members without which a model loses most of what it gains: such a part may just
  /// have lost its way, so the member is led out by small steps. Whether a better part came of it.
  bool SettleByLeadingOut(const CandidateSet& set);

  /// Every settled model with its worth; not those with more causes than are asked for, which a
  /// search may pass through.
  std::vector<std::pair<CandidateSet, double>> Visited() const;

 private:
  struct Entry {
    FittedModel white, settled;
  };
  bool Stopped() const { return options_.stop && *options_.stop; }
  double LogPrior(const CandidateSet& set) const;
  std::string NamesOf(const CandidateSet& set) const;
  FittedModel Refitted(const CandidateSet& set) const;
  bool TakeIfBetter(FittedModel found, const CandidateSet& set);
  CandidateSet BestPart(const CandidateSet& set) const;
  NoiseModel NoiseNear(const CandidateSet& set) const;
  FittedModel Ordered(FittedModel e, const CandidateSet& order, const CandidateSet& set) const;
  void Report(const CandidateSet& set, std::string_view what);
  const Candidate& CandidateAt(int i) const {
    return naming_.candidates[static_cast<std::size_t>(i)].candidate;
  }

  const FittedModel& plain_;
  const FittedModel& null_;
  const std::vector<TrialProblem>& train_;
  const NamingOptions& options_;
  Naming& naming_;
  RefitSettings refit_;
  std::map<CandidateSet, Entry> models_;
  std::map<CandidateSet, double> parted_;  // cost of a whole when its parts were refitted from it
  std::mutex mutex_;
  int planned_ = 0;
};

bool Holds(const CandidateSet& set, int i);

/// The set with candidate `i` in its place.
CandidateSet With(CandidateSet set, int i);

/// The sets with one member less.
std::vector<CandidateSet> Eliminations(const CandidateSet& set);

}  // namespace hoplab
