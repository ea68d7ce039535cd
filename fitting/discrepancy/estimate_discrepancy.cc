#include "fitting/discrepancy/estimate_discrepancy.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

// Amplitudes in units of sigma that a search may reach at least, and below which one is none.
constexpr double kLeast = 1e-3, kNone = 0.02;
constexpr double kDifference = 1e-3;  // of a logarithm

// Unknowns: logarithms of the amplitudes, then of the time scale.
class NegativeLikelihood : public ceres::FirstOrderFunction {
 public:
  explicit NegativeLikelihood(const RestrictedLikelihood& likelihood) : likelihood_(likelihood) {}

  int NumParameters() const override { return static_cast<int>(likelihood_.channels()) + 1; }
  bool Evaluate(const double* x, double* cost, double* gradient) const override {
    cost[0] = Cost(x);
    if (!gradient) return std::isfinite(cost[0]);
    std::vector<double> moved(x, x + NumParameters());
    for (int k = 0; k < NumParameters(); ++k) {
      moved[k] = x[k] + kDifference;
      gradient[k] = (Cost(moved.data()) - cost[0]) / kDifference;
      moved[k] = x[k];
    }
    return std::isfinite(cost[0]);
  }
  NoiseModel NoiseOf(const double* x) const {
    NoiseModel noise;
    for (std::size_t c = 0; c < likelihood_.channels(); ++c)
      noise.amplitude.push_back(std::exp(Inside(x[c], std::log(kLeast), Most(c))));
    noise.time_scale = std::exp(Inside(x[likelihood_.channels()], std::log(likelihood_.shortest()),
                                       std::log(likelihood_.longest())));
    return noise;
  }

 private:
  // A discrepancy is no larger than what is left to see. Without that bound, one that fitted values
  // imitate grows at no cost: they are moved to cancel it.
  double Most(std::size_t channel) const {
    return std::log(std::max(likelihood_.RootMeanSquare(channel), kNone));
  }
  static double Inside(double x, double low, double high) { return std::clamp(x, low, high); }
  // A gentle slope back into the range.
  static double Outside(double x, double low, double high) {
    const double by = x - Inside(x, low, high);
    return 0.5 * by * by;
  }
  double Cost(const double* x) const {
    double beyond = Outside(x[likelihood_.channels()], std::log(likelihood_.shortest()),
                            std::log(likelihood_.longest()));
    for (std::size_t c = 0; c < likelihood_.channels(); ++c)
      beyond += Outside(x[c], std::log(kLeast), Most(c));
    return beyond - likelihood_.At(NoiseOf(x));
  }

  const RestrictedLikelihood& likelihood_;
};

// Amplitudes too small to matter are none.
NoiseModel Tidied(NoiseModel noise) {
  for (double& a : noise.amplitude) {
    if (a < kNone) a = 0.0;
  }
  return noise.IsWhite() ? NoiseModel() : noise;
}

DiscrepancyEstimate SearchFrom(const RestrictedLikelihood& likelihood, const NoiseModel& begin) {
  auto* function = new NegativeLikelihood(likelihood);  // the problem owns it
  const ceres::GradientProblem problem(function);
  std::vector<double> x;
  for (std::size_t c = 0; c < likelihood.channels(); ++c)
    x.push_back(std::log(std::max(begin.AmplitudeOf(c), kNone)));
  x.push_back(std::log(begin.time_scale));
  ceres::GradientProblemSolver::Options options;
  options.line_search_direction_type = ceres::BFGS;
  options.max_num_iterations = 25;
  options.function_tolerance = 1e-6;  // of some thousand nats: far below one
  options.gradient_tolerance = 0.02;
  options.logging_type = ceres::SILENT;
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(options, problem, x.data(), &summary);
  DiscrepancyEstimate out;
  out.noise = Tidied(function->NoiseOf(x.data()));
  out.log_likelihood = likelihood.At(out.noise);
  return out;
}

}  // namespace

DiscrepancyEstimate EstimateDiscrepancy(const RestrictedLikelihood& likelihood,
                                        const NoiseModel& known, bool known_only) {
  DiscrepancyEstimate best;
  best.white = best.log_likelihood = likelihood.At({});
  if (!(likelihood.shortest() > 0.0) || !(likelihood.longest() > likelihood.shortest()))
    return best;
  std::vector<NoiseModel> begins;
  if (!known.IsWhite()) begins.push_back(known);
  if (begins.empty() || !known_only) {
    NoiseModel large, tiny;
    large.time_scale = tiny.time_scale = std::sqrt(likelihood.shortest() * likelihood.longest());
    for (std::size_t c = 0; c < likelihood.channels(); ++c) {
      large.amplitude.push_back(std::max(likelihood.RootMeanSquare(c), 0.5));
      tiny.amplitude.push_back(0.1);
    }
    begins.push_back(large);
    begins.push_back(tiny);
  }
  for (const NoiseModel& begin : begins) {
    DiscrepancyEstimate found = SearchFrom(likelihood, begin);
    if (found.log_likelihood > best.log_likelihood) {
      found.white = best.white;
      best = std::move(found);
    }
  }
  if (best.gain() < kDiscrepancyPays) {
    best.noise = {};
    best.log_likelihood = best.white;
  }
  return best;
}

}  // namespace hoplab
