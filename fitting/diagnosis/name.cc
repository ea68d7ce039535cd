#include "fitting/diagnosis/name.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "fitting/diagnosis/candidate_status.h"
#include "fitting/diagnosis/in_some_trials.h"
#include "fitting/diagnosis/linearise_at.h"
#include "fitting/diagnosis/pairs.h"
#include "fitting/diagnosis/pool.h"
#include "fitting/diagnosis/refits.h"
#include "fitting/diagnosis/weigh.h"

namespace hoplab {
namespace {

// Models settled at each step of the search.
constexpr int kSingleWidth = 4, kForwardWidth = 3, kPairsSettled = 2;
// Causes tried alone, for each of two kinds of noise, where the linear model tells which.
constexpr int kSinglesByPromise = 8;
// Nats a further cause must promise by the linear model to be tried.
constexpr double kWorthATry = 4.0;
// It must promise this share of the misfit beyond noise, or this in nats a sample (a fiftieth of
// the noise's square). The discrepancy stands for what explains less than both.
constexpr double kLeastShare = 1e-3, kLeastPerSample = 0.01;
// A set that leaves this share of the misfit beyond noise may be one of stand-ins, and slow causes
// are sought; so many causes join it at once. (With 2 % for the slow ones stand-ins took the place
// of play in a gear beside a soft leg.)
constexpr double kMuch = 5e-3;
constexpr int kJoin = 3;
// A cause in one trial that promises this share of what a set leaves, or so many times what an
// average trial leaves, is looked at beside it.
constexpr double kMostOfWhatIsLeft = 0.5, kTimesAnAverageTrial = 2.5;
// A set that leaves less than this share explains the data by and large.
constexpr double kLittle = 0.1;
// Rounds in which a set is put in order; each but the last changes it.
constexpr int kRounds = 8;

class Search {
 public:
  Search(const NullFits& null, std::span<const Candidate> candidates, const Linearisation& null_at,
         const std::vector<TrialProblem>& train, const NamingOptions& options)
      : null_(*null.settled),
        null_at_(null_at),
        train_(train),
        options_(options),
        given_(static_cast<int>(candidates.size())),
        refits_(*null.plain, *null.settled, train, options, naming_),
        rankings_(naming_, train, options.jobs) {
    FillPool(naming_, candidates, null_at, train, options);
  }

  Naming Run() {
    if (options_.max_effects < 1) {
      naming_.best = null_;
      naming_.worth = refits_.Worth({});
      naming_.unlisted_probability = null_.evidence.discrepancy_probability();
      Judge({});
      return std::move(naming_);
    }
    const CandidateSet begun = Begun();
    CandidateSet current = BesideInSomeTrials(Grown(begun.empty() ? OneByOne() : begun));
    if (LeavesMuch(current)) {
      const CandidateSet exchanged = Exchanged(current);
      if (exchanged != current) current = Grown(exchanged);
    }
    current = Confirmed(current);
    naming_.best = refits_.At(current);
    naming_.best_set = current;
    naming_.worth = refits_.Worth(current);
    for (const CandidateSet& less : Eliminations(current))
      naming_.without.push_back(refits_.Usable(less) ? refits_.At(less) : FittedModel());
    for (std::size_t i = 0; i < naming_.candidates.size(); ++i) {
      CandidateResult& c = naming_.candidates[i];
      const CandidateSet alone = {static_cast<int>(i)};
      if (!(c.separable || c.has_threshold) || !refits_.Has(alone)) continue;
      c.alone = refits_.At(alone);
      c.gain = c.alone.ok() ? refits_.Gain(alone) : 0.0;
    }
    FindGroups(current, refits_, naming_);
    Weigh(refits_, naming_);
    Judge(current);
    naming_.interrupted = Stopped();
    return std::move(naming_);
  }

 private:
  bool Stopped() const { return options_.stop && *options_.stop; }

  // With the best of what was given, if that is worth more than nothing.
  CandidateSet Begun() {
    std::vector<CandidateSet> given;
    for (const FittedModel& model : options_.begin) given.push_back(refits_.Adopt(model));
    std::erase(given, CandidateSet());
    return refits_.Better({}, given, static_cast<int>(given.size()));
  }

  CandidateSet OneByOne() {
    const CandidateSet single = refits_.Better({}, Singles(), kSingleWidth, BestScored(naming_));
    CandidateSet current = refits_.Better(single, Pairs(), kPairsSettled);
    const bool slow_ones = SeeksSlowOnes(current);
    if (slow_ones) current = refits_.Better(current, SlowOnes(current), kPairsSettled);
    if (!current.empty())
      current = refits_.Better(current, BeyondThresholds(single, slow_ones), kPairsSettled);
    return current;
  }

  // Cause by cause, as long as one more pays.
  CandidateSet Grown(CandidateSet set) {
    while (!set.empty() && static_cast<int>(set.size()) < options_.max_effects && !Stopped()) {
      const std::vector<CandidateSet> further = Forward(set);
      const CandidateSet grown = refits_.Better(set, further, kForwardWidth, further);
      if (grown == set) break;
      set = Tidy(grown);
    }
    return Tidy(set);
  }

  // What acts in some trials shows once the set explains what acts in all. It is looked for where
  // one such cause promises most of what is left.
  CandidateSet BesideInSomeTrials(const CandidateSet& set) {
    if (set.empty() || !options_.in_some_trials || !MisfitIsSeen(set) || Stopped()) return set;
    const std::vector<int> places = PlacesBeside(naming_, set, given_);
    const Linearisation at =
        LineariseAt(refits_.White(set), CandidatesAt(naming_, places), train_, options_.jobs);
    if (!AddInSomeTrials(naming_, at, places, train_, StandsOut() * Left(set))) return set;
    rankings_.Clear();
    return Grown(set);
  }

  // The share of what is left by which one trial stands out.
  double StandsOut() const {
    std::set<std::string> recordings;
    for (const TrialProblem& t : train_) recordings.insert(t.recording);
    return std::min(kMostOfWhatIsLeft,
                    kTimesAnAverageTrial / static_cast<double>(recordings.size()));
  }

  // A set whose members are each needed, by small steps, too.
  CandidateSet Confirmed(CandidateSet set) {
    for (int round = 0; round < kRounds && refits_.SettleByLeadingOut(set); ++round) {
      const CandidateSet tidied = Tidy(set);
      if (tidied == set) break;
      set = Grown(tidied);
    }
    return set;
  }

  const Effect* EffectOf(int i) const { return naming_.candidates[i].candidate.effect; }
  // Where little is missing, those alone that promise most under either noise.
  std::vector<CandidateSet> Singles() {
    if (!options_.singles_by_promise) return SinglesOf(naming_, nullptr);
    std::set<int> promising;
    for (const FittedModel* null : {&refits_.White({}), &null_})
      AddFirst(rankings_.Beside({}, *null), kSinglesByPromise, kWorthATry, promising);
    return SinglesOf(naming_, &promising);
  }

  // By what gains most beside the set under its own noise, and under white noise.
  std::vector<CandidateSet> Forward(const CandidateSet& set) {
    const Ranking& white = rankings_.Beside(set, refits_.White(set));
    std::set<int> matters;
    for (const Promise& p : white)
      if (p.gain >= LeastGain()) matters.insert(p.place);
    std::vector<CandidateSet> sets;
    const auto add = [&](const CandidateSet& grown) {
      if (std::find(sets.begin(), sets.end(), grown) == sets.end()) sets.push_back(grown);
    };
    const auto take = [&](const Ranking& ranked) {
      int taken = 0;
      for (const auto& [gain, i, information] : ranked) {
        if (taken >= kForwardWidth || gain < kWorthATry) break;
        if (!matters.contains(i)) continue;
        ++taken;
        add(With(set, i));
      }
    };
    if (!matters.empty() && !refits_.At(set).problem.noise.IsWhite())
      take(rankings_.Beside(set, refits_.At(set)));
    take(white);
    for (const CandidateSet& grown : BeyondThresholds(set, SeeksSlowOnes(set))) add(grown);
    return sets;
  }
  bool IsSlow(std::size_t i) const { return naming_.candidates[i].candidate.effect->info.slow; }
  // The set misses more than noise does, by three of its standard deviations, and no mere detail.
  bool MisfitIsSeen(const CandidateSet& set) const {
    const double noise = 0.5 * null_at_.degrees_of_freedom();
    return Left(set) > std::max(3.0 * std::sqrt(noise), kMuch * Misfit());
  }
  bool LeavesLittle(const CandidateSet& set) const { return Left(set) < kLittle * Misfit(); }
  bool SeeksSlowOnes(const CandidateSet& set) const {
    if (options_.slow_ones_only_beside && !LeavesLittle(set)) return false;
    for (std::size_t i = 0; i < naming_.candidates.size(); ++i)
      if (IsSlow(i)) return MisfitIsSeen(set);
    return false;
  }
  // What is slow and gained nothing where it was first tried is not tried beside others, each a
  // minute and more.
  bool GainedFirst(int i) const {
    const CandidateSet first = With(slow_beside_, i);
    return !refits_.Has(first) ||
           (refits_.Usable(first) &&
            refits_.White(slow_beside_).cost - refits_.White(first).cost >= kWorthATry);
  }
  // Beside a set that leaves little: there a look at what is not there is soon over. Else alone,
  // since what stands in for it may be in the set.
  std::vector<CandidateSet> SlowOnes(const CandidateSet& set) {
    slow_beside_ = LeavesLittle(set) ? set : CandidateSet();
    std::vector<CandidateSet> sets;
    for (std::size_t i = 0; i < naming_.candidates.size(); ++i)
      if (IsSlow(i)) sets.push_back(With(slow_beside_, static_cast<int>(i)));
    return sets;
  }
  // No linear model promises what has a threshold: it is tried, and taken as far as it gains.
  std::vector<CandidateSet> BeyondThresholds(const CandidateSet& set, bool slow_ones) {
    std::vector<CandidateSet> tried, together, sets;
    for (int i = 0; i < static_cast<int>(naming_.candidates.size()); ++i) {
      if (!naming_.candidates[i].has_threshold || Holds(set, i)) continue;
      if (IsSlow(i) && !(slow_ones && GainedFirst(i))) continue;
      tried.push_back(With(set, i));
      const std::optional<int> other = ShowsBeside(naming_, i);
      if (!other || Holds(set, *other)) continue;
      together.push_back(With(tried.back(), *other));
      tried.push_back(With(set, *other));
    }
    for (std::vector<CandidateSet>* of : {&tried, &together}) {
      std::erase_if(*of, [&](const CandidateSet& grown) { return !refits_.MayBeTold(grown); });
      refits_.Try(*of);  // those together from the best of their parts
    }
    tried.insert(tried.end(), together.begin(), together.end());
    for (const CandidateSet& grown : tried) {
      const double gain = refits_.White(set).cost - refits_.White(grown).cost;
      if (refits_.Usable(grown) && gain >= std::max(LeastGain(), kWorthATry)) sets.push_back(grown);
    }
    return sets;
  }
  // Nats under white noise.
  double LeastGain() const {
    return std::min(kLeastShare * Misfit(),
                    kLeastPerSample * (null_at_.samples - null_at_.alike_rows));
  }
  // Beyond noise, of the null fit and of a set.
  double Misfit() const { return std::max(Left({}), 0.0); }
  double Left(const CandidateSet& set) const {
    return refits_.White(set).cost - 0.5 * null_at_.degrees_of_freedom();
  }

  // More than a detail is left beside the set, and no noise.
  bool LeavesMuch(const CandidateSet& set) const {
    if (set.size() < 2 || Stopped()) return false;
    return refits_.At(set).evidence.discrepancy_probability() > 0.5 && Left(set) > kMuch * Misfit();
  }

  // One cause at a time does not lead from stand-ins to the causes they stand in for. So what
  // promises most beside the set joins it, one on top of another, and what is not needed leaves.
  CandidateSet Exchanged(const CandidateSet& set) {
    CandidateSet all = set;
    for (int joined = 0; joined < kJoin && !Stopped(); ++joined) {
      const Ranking& ranked = rankings_.Beside(all, refits_.White(all));
      if (ranked.empty() || ranked.front().gain < kWorthATry) break;
      const CandidateSet grown = With(all, ranked.front().place);
      refits_.Try({grown});
      if (!refits_.Usable(grown)) break;
      all = grown;
    }
    if (all == set) return set;
    refits_.SettleAll({all});
    while (refits_.Settled(all) && all.size() > 1 && !Stopped()) {
      const CandidateSet best = refits_.BestPart(all, options_.max_effects);
      if (best == all) break;
      all = best;
    }
    const bool is_better = refits_.Settled(all) && refits_.Worth(all) > refits_.Worth(set);
    return is_better && refits_.MayBeTold(all) ? all : set;
  }

  std::vector<CandidateSet> Pairs() const {
    if (options_.max_effects < 2) return {};
    return PairsFromNull(naming_.candidates, null_at_, 3.0 * kWorthATry);
  }

  // Backward elimination and swaps, until neither helps.
  CandidateSet Tidy(CandidateSet set) {
    for (int round = 0; round < kRounds && !set.empty() && !Stopped(); ++round) {
      CandidateSet best = refits_.BestPart(set);
      best = refits_.Better(best, Swaps(best), 2 * kForwardWidth);
      if (best == set) break;
      set = best;
    }
    return set;
  }
  // Sets in which one member gives its place to another candidate that promises, by the linear
  // model, nearly what that member gains, or that moves the data as it does.
  std::vector<CandidateSet> Swaps(const CandidateSet& set) {
    std::vector<CandidateSet> swaps;
    if (set.size() < 2) return swaps;
    for (const CandidateSet& less : refits_.SettleParts(set)) {
      if (!refits_.Settled(less)) continue;
      const double needed = refits_.Worth(set) - refits_.Worth(less) - kIndistinguishable;
      int taken = 0;
      const Ranking& without = rankings_.Beside(less, refits_.At(less));
      for (const auto& [gain, i, information] : without) {
        if (taken >= kForwardWidth || gain < std::max(needed, kWorthATry)) break;
        if (Holds(set, i)) continue;
        swaps.push_back(With(less, i));
        ++taken;
      }
      // Far from the set without the member the linear model promises too little.
      std::vector<int> alike = AlikeTo(without, rankings_.Beside(set, refits_.At(set)));
      if (alike.size() > kForwardWidth) alike.resize(kForwardWidth);
      for (const int i : alike) swaps.push_back(With(less, i));
    }
    return swaps;
  }

  void Judge(const CandidateSet& model) {
    std::set<int> looked_at;
    for (int i = 0; i < static_cast<int>(naming_.candidates.size()); ++i)
      if ((options_.slow_ones_only_beside && IsSlow(i)) || refits_.WasTried(i)) looked_at.insert(i);
    SetStatuses(refits_.At(model), model, looked_at, train_, options_.jobs, naming_);
  }

  const FittedModel& null_;  // settled
  const Linearisation& null_at_;
  const std::vector<TrialProblem>& train_;
  const NamingOptions& options_;
  const int given_;  // candidates, before those of single trials
  Naming naming_;
  Refits refits_;
  Rankings rankings_;
  CandidateSet slow_beside_;  // what slow causes were first tried beside
};

}  // namespace

Naming NameCauses(const NullFits& null, std::span<const Candidate> candidates,
                  const Linearisation& null_at, const std::vector<TrialProblem>& train,
                  const NamingOptions& options) {
  return Search(null, candidates, null_at, train, options).Run();
}

}  // namespace hoplab
