#include "fitting/diagnosis/other_models.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numbers>
#include <optional>

namespace hoplab {
namespace {

constexpr double kBeyond = 0.025;  // of the probability, past either end of an interval

// log of the evidence of the told model with one cause more over that without, by Laplace: the gain
// at the best size, the prior there, and the volume the data leave.
double LogOdds(const Candidate& candidate, const Score& score, const Eigen::MatrixXd& covariance,
               double prior_log_odds) {
  double sum = score.predicted_gain - prior_log_odds +
               0.5 * std::log((2.0 * std::numbers::pi * covariance).determinant());
  for (int i = 0; i < candidate.parameter_count(); ++i) {
    const EffectParameter& p = candidate.Parameter(i);
    sum += LogSizePrior(score.size[i] / p.typical, p.lower >= p.null || p.upper <= p.null) -
           std::log(std::abs(p.typical));
  }
  return sum;
}

// How many of its standard deviations an interval has to reach into a model: as far as leaves
// kBeyond of the probability past its end, the told model and this one being all there are. Below
// kRuledOut it need not even hold its middle.
double ReachInto(double log_odds) {
  const double share = 1.0 / (1.0 + std::exp(-log_odds));
  return boost::math::quantile(boost::math::complement(boost::math::normal(), kBeyond / share));
}

bool Possible(const Candidate& candidate, const Eigen::VectorXd& size) {
  for (int i = 0; i < candidate.parameter_count(); ++i) {
    const EffectParameter& p = candidate.Parameter(i);
    const double value = p.null + size[i];
    if (!(value >= p.lower && value <= p.upper)) return false;
  }
  return true;
}

// The data tell its size to within a typical one. Of what they cannot show they say nothing for or
// against, and what it would do to the fitted values has no end.
bool Shows(const Candidate& candidate, const Eigen::MatrixXd& covariance) {
  for (int i = 0; i < candidate.parameter_count(); ++i)
    if (!(std::sqrt(covariance(i, i)) <= std::abs(candidate.Parameter(i).typical))) return false;
  return true;
}

int PlaceOf(const Naming& naming, const Candidate& candidate) {
  for (std::size_t i = 0; i < naming.candidates.size(); ++i)
    if (naming.candidates[i].candidate == candidate) return static_cast<int>(i);
  return -1;
}

std::optional<OtherModel> WithOneMore(const Naming& naming, const FittedModel& told,
                                      const Linearisation& at, const Candidate& candidate,
                                      const Hypothesis& hypothesis) {
  const Score score = ScoreOf(at, hypothesis);
  if (score.rank < hypothesis.count || !Possible(candidate, score.size)) return std::nullopt;
  const Eigen::MatrixXd A = at.columns.middleCols(hypothesis.first, hypothesis.count);
  const Eigen::MatrixXd covariance = (A.transpose() * A).inverse();
  if (!Shows(candidate, covariance)) return std::nullopt;
  OtherModel out;
  out.candidate = PlaceOf(naming, candidate);
  out.size = score.size;
  out.log_odds = LogOdds(candidate, score, covariance, naming.LogOdds(candidate));
  if (out.candidate < 0 || !(out.log_odds > std::log(kRuledOut))) return std::nullopt;
  out.moved = out.spread = Eigen::VectorXd::Zero(told.shared.size());
  const std::vector<int> fitted = FreeShared(told.problem, told.shared);
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    const double scale = told.problem.shared[static_cast<std::size_t>(fitted[k])].scale;
    const Eigen::VectorXd shift = scale * at.fitted_shift.row(static_cast<Eigen::Index>(k))
                                              .segment(hypothesis.first, hypothesis.count)
                                              .transpose();
    out.moved[fitted[k]] = shift.dot(score.size);
    out.spread[fitted[k]] = std::sqrt(std::max(shift.dot(covariance * shift), 0.0));
  }
  return out;
}

OtherModel Rival(const FittedModel& told, const FittedModel& rival) {
  OtherModel out;
  out.moved = out.spread = Eigen::VectorXd::Zero(told.shared.size());
  for (int k = 0; k < told.problem.shared_count(); ++k) {
    for (int j = 0; j < rival.problem.shared_count(); ++j) {
      const auto at = static_cast<std::size_t>(k), other = static_cast<std::size_t>(j);
      if (rival.problem.shared[other].name == told.problem.shared[at].name)
        out.moved[k] = rival.shared[j] - told.shared[k];
    }
  }
  return out;
}

}  // namespace

std::vector<OtherModel> WithOneMoreOf(const Naming& naming, const FittedModel& told,
                                      const Linearisation& at, std::span<const Candidate> others) {
  const std::vector<Hypothesis> hypotheses =
      HypothesesOf(std::vector<Candidate>(others.begin(), others.end()));
  std::vector<OtherModel> out;
  for (std::size_t i = 0; i < others.size(); ++i)
    if (auto more = WithOneMore(naming, told, at, others[i], hypotheses[i])) out.push_back(*more);
  return out;
}

std::vector<OtherModel> OtherModelsOf(const Naming& naming, const Linearisation& at,
                                      std::span<const Candidate> others) {
  std::vector<OtherModel> out;
  for (std::size_t m = 0; m < naming.groups.size(); ++m) {
    for (std::size_t k = 1; k < naming.groups[m].size(); ++k) {
      const double odds = naming.group_weights[m][k] / naming.group_weights[m][0];
      if (!(odds > kRuledOut)) continue;
      const FittedModel& rival = naming.rivals[m][k];
      OtherModel other = Rival(naming.best, rival);
      other.candidate = naming.groups[m][k];
      other.instead_of = naming.groups[m][0];
      other.log_odds = std::log(odds);
      const Candidate& candidate =
          naming.candidates[static_cast<std::size_t>(other.candidate)].candidate;
      other.size = Eigen::VectorXd::Zero(candidate.parameter_count());
      for (std::size_t i = 0; i < rival.members.size(); ++i)
        if (rival.members[i] == candidate)
          other.size = rival.ValuesOf(static_cast<int>(i)) - NullValues({&candidate, 1});
      out.push_back(std::move(other));
    }
  }
  const std::vector<OtherModel> more = WithOneMoreOf(naming, naming.best, at, others);
  out.insert(out.end(), more.begin(), more.end());
  std::stable_sort(out.begin(), out.end(), [](const OtherModel& a, const OtherModel& b) {
    return a.log_odds > b.log_odds;
  });
  return out;
}

std::optional<OtherModel> LargerModelOf(const FittedModel& told, const FittedModel& larger,
                                        int candidate, double probability) {
  const double log_odds = std::log(probability / (1.0 - probability));
  if (!(log_odds > std::log(kRuledOut))) return std::nullopt;
  OtherModel out = Rival(told, larger);
  out.candidate = candidate;
  out.log_odds = log_odds;
  out.size = larger.ValuesOf(0) - NullValues({&larger.members.front(), 1});
  return out;
}

void HoldOtherModels(std::span<const OtherModel> models, const FittedModel& told,
                     Uncertainty& uncertainty) {
  for (int k = 0; k < told.problem.shared_count(); ++k) {
    const SharedParameter& s = told.problem.shared[static_cast<std::size_t>(k)];
    ParameterUncertainty& p = uncertainty.parameters[static_cast<std::size_t>(k)];
    if (!p.ci95 || !p.std_error) continue;
    p.ci95_given_model = p.ci95;
    for (const OtherModel& other : models) {
      const double middle = told.shared[k] + other.moved[k];
      const double half = ReachInto(other.log_odds) * std::hypot(*p.std_error, other.spread[k]);
      for (auto* interval : {&p.ci95, &p.ci95_between_trials}) {
        if (!interval->has_value()) continue;
        auto& [low, high] = **interval;
        low = std::max(std::min(low, middle - half), s.lower);
        high = std::min(std::max(high, middle + half), s.upper);
      }
    }
  }
}

}  // namespace hoplab
