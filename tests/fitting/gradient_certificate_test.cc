#include "fitting/gradient_certificate.h"

#include <gtest/gtest.h>

#include "fitting/check.h"
#include "tests/support/fit_cases.h"

namespace hoplab {
namespace {

using testing::NominalStarts;
using testing::SmallDataset;

struct Case {
  FitProblem problem = MakeProblem(SmallDataset(), {.with_effects = {"air_drag", "sensor_delay"}});
  std::vector<TrialProblem> trials = TrialsOf(problem, TrialRole::kTrain);
  GradientCertificate Certify(const JacobianSource& source = nullptr) const {
    return CertifyGradients(problem, trials, InitialShared(problem), NominalStarts(trials), 1,
                            source);
  }
};

TEST(GradientCertificate, PassesOnCorrectDerivatives) {
  const GradientCertificate c = Case().Certify();
  EXPECT_LT(c.max_relative_error, 1e-6);
  EXPECT_EQ(c.columns.size(), 4u + 2u * 4u);
  EXPECT_TRUE(c.flags.empty());
}

TEST(GradientCertificate, NamesAWrongDerivative) {
  const auto wrong = [](const TrialEvaluator& evaluator, const EvaluationRequest& request,
                        Trajectory& out) {
    evaluator.Simulate(request, {}, out);
    // The saltation forgotten in one place would look like this: one column off by 0.1 % after
    // the first hop.
    const std::size_t width = static_cast<std::size_t>(out.directions);
    for (std::size_t i = out.sensitivities.size() / 2; i < out.sensitivities.size(); i += width)
      out.sensitivities[i + 1] *= 1.001;
  };
  const GradientCertificate c = Case().Certify(wrong);
  EXPECT_EQ(c.worst_parameter, "d");
  EXPECT_GT(c.max_relative_error, 1e-4);
}

TEST(GradientCertificate, ATrialThatNeverTouchesSaysNothingOfTheLeg) {
  Dataset d = SmallDataset(1, 0);
  // Keep the first flight only.
  Trace& trace = d.trials[0].trace;
  trace.time_s.resize(10);
  for (TraceColumn& c : trace.columns) c.values.resize(10);
  const FitProblem p = MakeProblem(d, {});
  const CheckReport report = CheckDataset(d, p, 1);
  ASSERT_TRUE(report.uncertainty && report.certificate);
  EXPECT_EQ(report.uncertainty->identifiability.rank, 0);
  EXPECT_FALSE(report.uncertainty->parameters[0].std_error.has_value());
  EXPECT_FALSE(report.certificate->columns[0].relative_error.has_value());
  bool told = false;
  for (const std::string& w : report.warnings)
    told = told || w.find("never touches the ground") != std::string::npos;
  EXPECT_TRUE(told);
}

}  // namespace
}  // namespace hoplab
