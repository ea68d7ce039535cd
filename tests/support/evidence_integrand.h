#pragma once

#include <Eigen/Core>
#include <vector>

#include "fitting/problem.h"

namespace hoplab::testing {

/// What the evidence of a model is the integral of, written down from its definition and not from
/// the code that takes Laplace's approximation of it: the likelihood of the rows, times the priors
/// of initial states, of shared values and, with a discrepancy, of its amplitudes and its time
/// scale. Coordinates: shared values per scale, each trial's initial states per scale, then the
/// logarithms of the amplitudes (in sigma) and of the time scale. Not linearised, no value held. In
/// units of the channels' sigma, and with a factor of 1/sqrt(2 pi) for each start, as the evidence
/// is: constants that all models share.
class EvidenceIntegrand {
 public:
  EvidenceIntegrand(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                    bool discrepancy);

  double operator()(const Eigen::VectorXd& x) const;

  /// Where values lie in its coordinates; `noise` is taken with a discrepancy.
  Eigen::VectorXd CoordinatesOf(const Eigen::VectorXd& shared,
                                const std::vector<OwnValues>& initial_states,
                                const hoplab::NoiseModel& noise) const;
  /// A first guess of the spread there: that of the linearised rows under white noise.
  Eigen::MatrixXd Spread(const Eigen::VectorXd& shared,
                         const std::vector<OwnValues>& initial_states) const;

 private:
  struct Noise {
    std::vector<double> amplitude;
    double time_scale = 0.0;
  };
  double LogNoisePrior(const Noise& noise) const;
  double LogRows(const TrialProblem& trial, const Eigen::VectorXd& residuals,
                 const Noise& noise) const;

  const FitProblem& problem_;
  const std::vector<TrialProblem>& trials_;
  bool discrepancy_;
  double shortest_ = 0.0, longest_ = 0.0;  // time scales [s]
};

}  // namespace hoplab::testing
