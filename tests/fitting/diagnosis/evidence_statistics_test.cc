// Laplace's evidence of many models against the same integral by sampling.
// ctest -L statistics
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numeric>

#include "base/random.h"
#include "tests/fitting/diagnosis/study.h"
#include "tests/support/sampled_evidence.h"

namespace hoplab::testing {
namespace {

struct EvidenceCase {
  const char* what;
  std::vector<EffectSpec> planted;
  std::vector<std::string> causes;  // of the model
  bool discrepancy = false;
  double disturbance = 0.0;  // amplitude of a Matern process on the traces, in sigma
  std::uint64_t seed = 5;
};

// A Matern 3/2 process of a time scale of 0.1 s on every channel.
void Disturb(Dataset& dataset, double amplitude, std::uint64_t seed) {
  constexpr double kScale = 0.1;
  for (std::size_t i = 0; i < dataset.trials.size(); ++i) {
    Trace& trace = dataset.trials[i].trace;
    const auto n = static_cast<Eigen::Index>(trace.time_s.size());
    Eigen::MatrixXd C(n, n);
    for (Eigen::Index a = 0; a < n; ++a) {
      for (Eigen::Index b = 0; b < n; ++b) {
        const double x = std::sqrt(3.0) * std::abs(trace.time_s[a] - trace.time_s[b]) / kScale;
        C(a, b) = (1.0 + x) * std::exp(-x) + (a == b ? 1e-10 : 0.0);
      }
    }
    const Eigen::MatrixXd L = C.llt().matrixL();
    for (std::size_t c = 0; c < trace.columns.size(); ++c) {
      RandomStream random(seed, 900 + 10 * i + c);
      Eigen::VectorXd z(n);
      for (double& value : z) value = random.Normal();
      const Eigen::VectorXd delta = amplitude * 0.001 * (L * z);
      for (Eigen::Index a = 0; a < n; ++a) trace.columns[c].values[a] += delta[a];
    }
  }
}

struct CaseFit {
  NullFit fit;
  FittedModel model;

  explicit CaseFit(const EvidenceCase& of) : fit(DatasetFor(of)), model(fit.null) {
    const RefitSettings settings =
        fit.SettingsOf(of.discrepancy ? Discrepancy::kMatern : Discrepancy::kNone);
    for (const std::string& name : of.causes) {
      const std::array added = {CandidateOf(name)};
      model = Refit(model, added, Eigen::VectorXd::Constant(1, 1e-3), settings);
    }
    model.problem.noise = {};
    Settle(model, settings);
  }
  static Dataset DatasetFor(const EvidenceCase& of) {
    Dataset dataset = DatasetOf(ShortWorld(of.planted, of.seed));
    if (of.disturbance > 0.0) Disturb(dataset, of.disturbance, of.seed);
    return dataset;
  }
};

TEST(EvidenceStatistics, LaplacesValueIsTheSampledOne) {
  const EffectSpec bias = EffectOfSize("touchdown_angle_bias", 0.02);
  const EffectSpec drag = EffectOfSize("air_drag", 0.03);
  std::vector<EvidenceCase> cases = {
      {"one cause", {bias}, {"touchdown_angle_bias"}},
      {"one, small", {EffectOfSize("touchdown_angle_bias", 0.003)}, {"touchdown_angle_bias"}},
      {"two causes", {bias, drag}, {"touchdown_angle_bias", "air_drag"}},
      {"two alike", {bias}, {"touchdown_angle_bias", "gravity_scale"}},
      {"three", {bias, drag}, {"touchdown_angle_bias", "air_drag", "gravity_scale"}},
  };
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    cases.push_back({"not there, free", {}, {"touchdown_angle_bias"}, false, 0.0, seed});
    cases.push_back({"not there, one side", {}, {"air_drag"}, false, 0.0, seed});
    cases.push_back({"not there, one side", {}, {"touchdown_loss"}, false, 0.0, seed});
    cases.push_back({"small, one side", {EffectOfSize("touchdown_loss", 0.004)}, {"touchdown_loss"}, false, 0.0, seed});
  }
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    cases.push_back({"disturbed", {}, {}, true, 3.0, seed});
    cases.push_back({"disturbed, a cause", {bias}, {"touchdown_angle_bias"}, true, 3.0, seed});
    cases.push_back({"another cause", {EffectOfSize("touchdown_angle_bias", 0.03)}, {}, true, 0.0, seed});
    cases.push_back({"another cause", {EffectOfSize("leg_material_damping", 5e-4)}, {"air_drag"}, true, 0.0, seed});
  }
  for (const EvidenceCase& c : cases) {
    const CaseFit f(c);
    if (!f.model.ok()) { std::printf("%s: no fit\n", c.what); continue; }
    for (int k = 2; k < f.model.shared.size(); ++k)
      std::printf("%s %.3f ", f.model.problem.shared[k].name.c_str(), f.model.shared[k] / f.model.problem.shared[k].scale);
    if (c.discrepancy) {
      if (f.model.problem.noise.IsWhite()) { std::printf("white\n"); continue; }
      std::printf("amp %.2f %.2f scale %.3f ", f.model.problem.noise.amplitude[0], f.model.problem.noise.amplitude[1], f.model.problem.noise.time_scale);
    }
    const ComparedEvidence e = CompareEvidence(c.what, f.model, f.fit.train, c.discrepancy);
    std::printf("   ");
    for (int k = 0; k < e.sampled.mean.size(); ++k)
      if (k < f.model.shared.size() || k >= f.model.shared.size() + 8) std::printf(" %.3f(%.3f)", e.sampled.mean[k], e.sampled.deviation[k]);
    std::printf("\n");
  }
}

}  // namespace
}  // namespace hoplab::testing
