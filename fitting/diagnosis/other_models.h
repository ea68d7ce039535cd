#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fitting/diagnosis/name.h"
#include "fitting/uncertainty.h"

namespace hoplab {

/// A model that is not told, and that the data leave nearly as likely as the told one.
struct OtherModel {
  int candidate = -1;      // place in Naming::candidates of what it has more, or in another's place
  int instead_of = -1;     // place of that other; -1: it is there beside all told causes
  double log_odds = 0.0;   // over the told model [nats]
  Eigen::VectorXd size;    // of the candidate, own units
  Eigen::VectorXd moved;   // what each shared value of the told model is less or more in it, own
                           // units; 0 for a value it does not have
  Eigen::VectorXd spread;  // standard deviation this adds to each by what is not known of `size`
};

/// Models less likely than this share of the told one are ruled out: they have a twentieth of the
/// probability of both.
inline constexpr double kRuledOut = 1.0 / 19.0;

/// `told` with one cause more where the evidence of the linear model for it is not below kRuledOut
/// of that of `told` and the data tell its size to within a typical one. The search leaves out a
/// cause that explains too little to be named, but such a cause may still move a fitted value.
/// `at`: `told` linearised with candidates it does not have as its first columns, in the order of
/// `others`, all of them candidates of `naming`.
std::vector<OtherModel> WithOneMoreOf(const Naming& naming, const FittedModel& told,
                                      const Linearisation& at, std::span<const Candidate> others);

/// The same of `naming.best`, and the rivals of its causes; the likeliest first.
std::vector<OtherModel> OtherModelsOf(const Naming& naming, const Linearisation& at,
                                      std::span<const Candidate> others);

/// `told` with all the causes of `larger`, whose names have this probability together; none where
/// that rules it out.
std::optional<OtherModel> LargerModelOf(const FittedModel& told, const FittedModel& larger,
                                        int candidate, double probability);

/// Both 95 % intervals of each value, widened until no more than 2.5 % of the probability lies past
/// either end where the told model and any one of `models` are all there are; what they were is
/// kept as `ci95_given_model`. `told`: the model of `uncertainty`.
void HoldOtherModels(std::span<const OtherModel> models, const FittedModel& told,
                     Uncertainty& uncertainty);

}  // namespace hoplab
