#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "fitting/diagnosis/extension.h"
#include "fitting/diagnosis/score.h"

namespace hoplab {

/// Log-likelihood within which two models count as equally good (a likelihood ratio of 6 to 20).
inline constexpr double kIndistinguishable = 3.0;  // nats
/// A candidate is tested if a typical size of it has this noncentrality: 80 % power at 5 %.
inline constexpr double kTestable = 7.85;

struct NamingOptions {
  int max_effects = 5;
  int jobs = 1;
  const std::atomic<bool>* stop = nullptr;
  /// How far the search is: refits done, how many are planned so far, and what the last one was.
  std::function<void(int refits, int of, std::string_view what)> progress = nullptr;
};

/// What the data say about one candidate.
enum class CandidateStatus {
  kSupported,          // in the accepted extension, and nothing takes its place
  kIndistinguishable,  // in the accepted extension or as good in a member's place
  kExcluded,           // tested, and not needed
  kNotTested           // an effect of typical size could not have shown
};
std::string_view NameOf(CandidateStatus status);

struct CandidateResult {
  Candidate candidate;
  Score score;             // at the null fit
  double power = 0.0;      // noncentrality of a typical size, typical^2 V (least of its parameters)
  bool separable = false;  // some of it can be told from the fitted values
  /// Added alone to the null model and refitted; status kFailed if it was not.
  Extension alone;
  double gain = 0.0;  // nats over the null fit, of `alone`
  CandidateStatus status = CandidateStatus::kNotTested;
  /// 95 % bound of |value| per parameter if added to the accepted extension, own units (linear);
  /// NaN where it cannot be told or is a member.
  Eigen::VectorXd bound95;
};

/// The search for the effects a model lacks.
struct Naming {
  std::vector<CandidateResult> candidates;  // the given ones, then those of single trials
  double penalty = 0.0;                     // nats a parameter must gain, ln(n/0.05)
  double local_penalty = 0.0;               // of an effect in one trial only
  Extension best;                           // without members if none pays
  /// One a member of `best`: places in `candidates` of what does as well there, itself first.
  std::vector<std::vector<int>> groups;
  std::vector<std::vector<Extension>> rivals;  // the models behind `groups`, in the same order
  int refits = 0;
  bool interrupted = false;
};

/// Refits every candidate alone, then looks for a second and third by forward steps, pairs,
/// backward elimination and swaps. `null_at` is the linearisation at the null fit with the
/// candidates' columns, in their order.
Naming NameCauses(const Extension& null, std::span<const Candidate> candidates,
                  const Linearisation& null_at, const std::vector<TrialProblem>& train,
                  const NamingOptions& options);

}  // namespace hoplab
