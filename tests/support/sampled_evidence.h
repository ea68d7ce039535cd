#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <cstdio>

#include "base/random.h"
#include "tests/support/bridge_sampling.h"
#include "tests/support/diagnosed_hops.h"
#include "tests/support/evidence_integrand.h"

namespace hoplab::testing {

/// Two trials of some fifty rows: a thousand evaluations take less than a second.
inline World ShortWorld(std::vector<EffectSpec> effects, std::uint64_t seed = 5) {
  return {.effects = std::move(effects),
          .train = 2,
          .test = 1,
          .hops = 2,
          .seed = seed,
          .rate_hz = 50.0};
}

/// Adds a Matern 3/2 process of a time scale of 0.1 s to every channel, its amplitudes
/// in sigma.
inline void Disturb(Dataset& dataset, const std::vector<double>& amplitude, std::uint64_t seed) {
  constexpr double kScale = 0.1, kSigma = 0.001;
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
      const Eigen::VectorXd delta = amplitude[c] * kSigma * (L * z);
      for (Eigen::Index a = 0; a < n; ++a) trace.columns[c].values[a] += delta[a];
    }
  }
}

/// Laplace's value of a model's evidence beside the sampled one [nats].
struct ComparedEvidence {
  double laplace = 0.0;
  SampledIntegral sampled;
  double difference() const { return laplace - sampled.log_value; }
};

/// Of a settled model, with white noise or with a discrepancy; printed.
inline ComparedEvidence CompareEvidence(const char* what, const FittedModel& model,
                                        const std::vector<TrialProblem>& train, bool discrepancy,
                                        const SamplingSettings& settings = {}) {
  ComparedEvidence out;
  out.laplace = discrepancy ? model.evidence.discrepancy : model.evidence.white;
  const EvidenceIntegrand integrand(model.problem, train, discrepancy);
  out.sampled = SampleIntegral(
      [&](const Eigen::VectorXd& x) { return integrand(x); },
      integrand.CoordinatesOf(model.shared, model.initial_states, model.problem.noise),
      integrand.Spread(model.shared, model.initial_states), settings);
  std::printf(
      "%s: Laplace %.3f, sampled %.3f +- %.3f, difference %+.3f nats; moved %.0f %%, %ld "
      "evaluations\n",
      what, out.laplace, out.sampled.log_value, out.sampled.std_error, out.difference(),
      100.0 * out.sampled.acceptance, out.sampled.evaluations);
  std::fflush(stdout);
  return out;
}

}  // namespace hoplab::testing
