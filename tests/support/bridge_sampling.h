#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

namespace hoplab::testing {

/// Logarithm of a function that is nowhere negative; -infinity where it is zero.
using LogFunction = std::function<double(const Eigen::VectorXd&)>;

struct SamplingSettings {
  int warm_up = 4000;    // steps that learn the spread
  int chains = 8;        // repetitions; their scatter gives the standard error
  int draws = 2000;      // steps of a chain
  int proposals = 1000;  // independent points beside a chain
  std::uint64_t seed = 1;
};

struct SampledIntegral {
  double log_value = 0.0;
  double std_error = 0.0;   // of the logarithm
  double acceptance = 0.0;  // share of steps that moved
  long evaluations = 0;
  Eigen::VectorXd mean, deviation;  // of the coordinates under the function, taken as a density
};

/// Logarithm of the integral of exp(log_f) over all space. Points are drawn by Metropolis' rule, in
/// turn by a random walk and by independent draws from Student's t around what the warm-up found;
/// the integral is that of bridge sampling between them and a Student's t fitted to other points of
/// the same chain (Meng and Wong 1996, the optimal bridge, iterated). `begin` has a finite value;
/// `covariance` is a first guess of the spread.
SampledIntegral SampleIntegral(const LogFunction& log_f, const Eigen::VectorXd& begin,
                               const Eigen::MatrixXd& covariance,
                               const SamplingSettings& settings = {});

}  // namespace hoplab::testing
