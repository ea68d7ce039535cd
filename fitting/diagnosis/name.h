#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "fitting/diagnosis/fitted_model.h"
#include "fitting/diagnosis/score.h"

namespace hoplab {

/// Log-likelihood within which two models count as equally good (a likelihood ratio of 6 to 20).
inline constexpr double kIndistinguishable = 3.0;  // nats
/// A candidate is tested if a typical size of it has this noncentrality: 80 % power at 5 %.
inline constexpr double kTestable = 7.85;

/// Places of a model's causes among the candidates, ascending; empty: the null fit.
using CandidateSet = std::vector<int>;

struct NamingOptions {
  int max_effects = 5;
  bool in_some_trials = true;  // a cause may act in some trials only
  int picked_from = 0;         // how many the candidates were picked out of; 0: they are all
  /// Models of these trials whose causes the search begins with, instead of one by one: one, and
  /// what was as good in its causes' places.
  std::span<const FittedModel> begin = {};
  /// Slow causes were tried on shorter parts of these trials and not needed: they are sought
  /// only beside a set that leaves little, which is soon over, and not alone.
  bool slow_ones_only_beside = false;
  /// Shorter parts of these trials show nothing that is missing. Then little is, and the linear
  /// model tells which causes are worth a refit alone.
  bool singles_by_promise = false;
  Discrepancy discrepancy = Discrepancy::kMatern;
  int jobs = 1;
  const std::atomic<bool>* stop = nullptr;
  /// How far the search is: refits done, how many are planned so far, and what the last one was.
  std::function<void(int refits, int of, std::string_view what)> progress = nullptr;
};

/// What the data say about one candidate.
enum class CandidateStatus {
  kSupported,          // in the accepted extension, and nothing takes its place
  kIndistinguishable,  // in the accepted extension or as good in a member's place
  kExcluded,           // tested, not needed, and bounded where nothing material is left
  kNotNeeded,          // tested and not needed beside the causes found; what is left may hide it
  kNotTested           // an effect of typical size could not have shown
};
std::string_view NameOf(CandidateStatus status);

struct CandidateResult {
  Candidate candidate;
  Score score;  // at the null fit
  /// Noncentrality of a typical size (PowerOf): at the null fit, or beside the accepted extension
  /// of what is not in it and does not do as well as a member.
  double power = 0.0;
  bool separable = false;      // some of it can be told from the fitted values
  bool has_threshold = false;  // no slope at null tells of it: it is tried at a few sizes
  /// Added alone to the null model and refitted; status kFailed if it was not.
  FittedModel alone;
  double gain = 0.0;         // nats over the null fit, of `alone`, under white noise
  double probability = 0.0;  // that it acts, by the evidence of the models visited
  CandidateStatus status = CandidateStatus::kNotTested;
  /// 95 % bound of |value| per parameter if added to the accepted extension, own units (linear);
  /// NaN where it cannot be told or is a member.
  Eigen::VectorXd bound95;
};

/// A group of names that do as well in one place, with further ones that do nearly as well.
struct WiderGroup {
  double told = 1.0;    // posterior weight of the group in it
  double gap = 0.0;     // to the best model without any of it [nats]
  double others = 0.0;  // names beside the first
};

/// The search for the effects a model lacks.
struct Naming {
  std::vector<CandidateResult> candidates;  // the given ones, then those of some trials only
  double log_odds = 0.0;                    // prior, against one cause: one is expected in all
  int recordings = 0;                       // in which one may act alone
  FittedModel best;                         // without members if none pays
  CandidateSet best_set;
  double worth = 0.0;  // logarithm of its posterior weight, of all models' common constant [nats]
  double unlisted_probability = 0.0;  // that something acts that no list holds
  /// One a member of `best`: places in `candidates` of what does as well there, itself first.
  std::vector<std::vector<int>> groups;
  std::vector<std::vector<FittedModel>> rivals;  // the models behind `groups`, in the same order
  /// The posterior weights within each group, which add to one, and how far each group is from the
  /// best model without any of it [nats].
  std::vector<std::vector<double>> group_weights;
  std::vector<double> gaps;
  /// The same of each group with those that come next, one after another.
  std::vector<std::vector<WiderGroup>> wider;
  /// One a member of `best`: the model without it, settled.
  std::vector<FittedModel> without;
  /// Settled models with their posterior weight, the best first, down to 1e-4 of it.
  std::vector<std::pair<CandidateSet, double>> posterior;
  int refits = 0;
  bool interrupted = false;

  /// Prior, against a cause: of one in some trials only their picking is paid for.
  double LogOdds(const Candidate& candidate) const;
  /// The group of a member of `best`, by its place in `candidates`.
  const std::vector<int>& GroupOf(int candidate) const { return groups[MemberOf(candidate)]; }
  /// Its place among the members of `best`.
  std::size_t MemberOf(int candidate) const;
};

/// The model without causes: under white noise, and under the noise that suits it.
struct NullFits {
  const FittedModel* plain = nullptr;
  const FittedModel* settled = nullptr;
};

/// Refits every candidate alone, or begins with what is given, then looks for a second and third by
/// forward steps, pairs, backward elimination and swaps; models are compared by their evidence.
/// `null_at` is the linearisation at the settled null fit with the candidates' columns in their
/// order.
Naming NameCauses(const NullFits& null, std::span<const Candidate> candidates,
                  const Linearisation& null_at, const std::vector<TrialProblem>& train,
                  const NamingOptions& options);

}  // namespace hoplab
