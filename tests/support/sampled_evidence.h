#pragma once

#include <cstdio>

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
  out.sampled =
      SampleIntegral([&](const Eigen::VectorXd& x) { return integrand(x); },
                     integrand.CoordinatesOf(model.shared, model.starts, model.problem.noise),
                     integrand.Spread(model.shared, model.starts), settings);
  std::printf(
      "%s: Laplace %.3f, sampled %.3f +- %.3f, difference %+.3f nats; moved %.0f %%, %ld "
      "evaluations\n",
      what, out.laplace, out.sampled.log_value, out.sampled.std_error, out.difference(),
      100.0 * out.sampled.acceptance, out.sampled.evaluations);
  std::fflush(stdout);
  return out;
}

}  // namespace hoplab::testing
