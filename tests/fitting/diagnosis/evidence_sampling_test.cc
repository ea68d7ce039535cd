// The oracle of the evidence: the same integral by sampling. First the sampler itself, on integrals
// with a closed form.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "tests/support/sampled_evidence.h"

namespace hoplab {
namespace {

using testing::ComparedEvidence;
using testing::CompareEvidence;
using testing::EffectOfSize;
using testing::NullFit;
using testing::SampledIntegral;
using testing::SampleIntegral;
using testing::SamplingSettings;

constexpr double kLogTwoPi = 1.8378770664093453;

// Measurements y = A b + e, e standard normal, b normal with deviation 2: the logarithm of the
// likelihood times the prior, and its integral, the density of y, which is normal as well.
struct LinearModel {
  Eigen::MatrixXd A = Eigen::MatrixXd(30, 8);
  Eigen::VectorXd y = Eigen::VectorXd(30);

  LinearModel() {
    RandomStream random(3, 9);
    for (double& a : A.reshaped()) a = 0.3 * random.Normal();
    for (double& v : y) v = 2.0 * random.Normal();
  }
  double LogPosterior(const Eigen::VectorXd& b) const {
    return -0.5 * ((y - A * b).squaredNorm() + 30.0 * kLogTwoPi) -
           0.5 * (0.25 * b.squaredNorm() + 8.0 * (kLogTwoPi + std::log(4.0)));
  }
  double LogEvidence() const {
    const Eigen::MatrixXd C = 4.0 * A * A.transpose() + Eigen::MatrixXd::Identity(30, 30);
    const Eigen::LLT<Eigen::MatrixXd> llt(C);
    return -0.5 * (y.dot(llt.solve(y)) + 30.0 * kLogTwoPi) -
           llt.matrixLLT().diagonal().array().log().sum();
  }
};

SamplingSettings ManyDraws() {
  return {.warm_up = 20'000, .chains = 10, .draws = 20'000, .proposals = 10'000};
}

TEST(SampleIntegral, IsTheEvidenceOfALinearModel) {
  const LinearModel model;
  const SampledIntegral found =
      SampleIntegral([&](const Eigen::VectorXd& b) { return model.LogPosterior(b); },
                     Eigen::VectorXd::Zero(8), Eigen::MatrixXd::Identity(8, 8), ManyDraws());
  std::printf("sampled %.4f +- %.4f, closed form %.4f\n", found.log_value, found.std_error,
              model.LogEvidence());
  EXPECT_NEAR(found.log_value, model.LogEvidence(), 0.02);
  EXPECT_LT(found.std_error, 0.01);
  EXPECT_LT(std::abs(found.log_value - model.LogEvidence()), 4.0 * found.std_error);
}

// A bound that cuts most of a normal off, whose other values lean against it.
TEST(SampleIntegral, IsTheIntegralOverAHalfSpace) {
  const Eigen::VectorXd mean{{-1.0, 0.5, 2.0}};
  const Eigen::MatrixXd C{{1.0, 0.6, -0.3}, {0.6, 2.0, 0.2}, {-0.3, 0.2, 0.5}};
  const Eigen::MatrixXd P = C.inverse();
  const auto log_f = [&](const Eigen::VectorXd& x) {
    if (x[0] < 0.0) return -std::numeric_limits<double>::infinity();
    return -0.5 * (x - mean).dot(P * (x - mean)) - 1.5 * kLogTwoPi -
           0.5 * std::log(C.determinant());
  };
  const SampledIntegral found =
      SampleIntegral(log_f, Eigen::VectorXd{{0.1, 0.0, 2.0}}, C, ManyDraws());
  const double exact = std::log(boost::math::cdf(boost::math::normal(), -1.0));
  std::printf("sampled %.4f +- %.4f, closed form %.4f\n", found.log_value, found.std_error, exact);
  EXPECT_NEAR(found.log_value, exact, 0.02);
  EXPECT_LT(std::abs(found.log_value - exact), 4.0 * found.std_error);
}

// Tails heavier than a normal's, and a bend no normal follows.
TEST(SampleIntegral, IsTheIntegralOfABentDensity) {
  const auto log_f = [](const Eigen::VectorXd& x) {
    const double bent = x[1] - 0.7 * x[0] * x[0];
    return -2.5 * std::log1p(x[0] * x[0] / 4.0) - 0.5 * bent * bent;
  };
  const SampledIntegral found =
      SampleIntegral(log_f, Eigen::VectorXd::Zero(2), Eigen::MatrixXd::Identity(2, 2), ManyDraws());
  // Student's t of four degrees of freedom: 1/density at 0 is 8/3; times a normal's sqrt(2 pi).
  const double exact = std::log(8.0 / 3.0) + 0.5 * kLogTwoPi;
  std::printf("sampled %.4f +- %.4f, closed form %.4f\n", found.log_value, found.std_error, exact);
  EXPECT_NEAR(found.log_value, exact, 0.05);
}

// Seconds each; more of them, and longer, in evidence_statistics_test.cc. With a discrepancy the
// walk begins far from where it ends, and fewer steps do not get it there.
SamplingSettings FewDraws(bool discrepancy) {
  if (discrepancy) return {.warm_up = 12'000, .chains = 6, .draws = 3000, .proposals = 1500};
  return {.warm_up = 3000, .chains = 6, .draws = 1500, .proposals = 750};
}

void ExpectSampled(const char* what, const NullFit& fit, const FittedModel& model,
                   bool discrepancy = false) {
  const ComparedEvidence e =
      CompareEvidence(what, model, fit.train, discrepancy, FewDraws(discrepancy));
  EXPECT_LT(e.sampled.std_error, 0.1);
  EXPECT_NEAR(e.difference(), 0.0, 0.3);
}

FittedModel WithCause(const NullFit& fit, const char* effect) {
  FittedModel model = fit.RefittedWith(testing::CandidateOf(effect));
  Settle(model, fit.SettingsOf(Discrepancy::kNone));
  return model;
}

TEST(EvidenceOf, IsTheSampledIntegralOfAModelWithoutACause) {
  const NullFit fit(testing::ShortWorld({}));
  ExpectSampled("no cause", fit, fit.null);
}

TEST(EvidenceOf, IsTheSampledIntegralOfAModelWithACause) {
  const NullFit fit(testing::ShortWorld({EffectOfSize("touchdown_angle_bias", 0.02)}));
  ExpectSampled("touchdown_angle_bias 0.02", fit, WithCause(fit, "touchdown_angle_bias"));
}

// What data leave open is wider than the narrowest prior of a size, and half of it is cut off.
TEST(EvidenceOf, IsTheSampledIntegralOfACauseOnItsBound) {
  const NullFit fit(testing::ShortWorld({}, 1));
  const FittedModel model = WithCause(fit, "air_drag");
  ASSERT_EQ(model.shared[model.shared.size() - 1], 0.0);
  ExpectSampled("air_drag, not there", fit, model);
}

// The likelihood of a discrepancy has its optimum away from the least squares, where its values
// are.
TEST(EvidenceOf, IsTheSampledIntegralOfAModelWithADiscrepancy) {
  Dataset dataset = testing::DatasetOf(testing::ShortWorld({}, 1));
  testing::Disturb(dataset, {3.0, 3.0}, 1);
  const NullFit fit(dataset);
  ASSERT_FALSE(fit.settled.problem.noise.IsWhite());
  ExpectSampled("a discrepancy", fit, fit.settled, true);
}

}  // namespace
}  // namespace hoplab
