#include "fitting/filtered_noise.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/nan.h"
#include "datasets/smoothness.h"
#include "fitting/flight_tops.h"
#include "fitting/left_by_parabola.h"
#include "model/mechanism_traits.h"

namespace hoplab {
namespace {

constexpr double kWidth = 8.0 * std::numbers::sqrt2 / 3.0;  // M116

using ByTrial = std::vector<std::vector<double>>;

// What parabolas leave of such noise: its mean square a degree of freedom that white noise would
// have, and how many it has itself.
struct Share {
  double square, freedom;
};
Share LeftOfFiltered(double tau, double apart) {
  constexpr int kSamples = FlightTops::kSamples;
  Eigen::MatrixXd noise(kSamples, kSamples);
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j) noise(i, j) = CorrelationThroughFilter((i - j) * apart, tau);
  const Eigen::MatrixXd parabola = LeftByParabola(kSamples), left = parabola * noise * parabola;
  const double trace = left.trace();
  return {trace / (kSamples - 3), trace * trace / left.squaredNorm()};
}

// By the mean of the windows' squares, those left out that the median shows to be no noise.
double SigmaAt(const FlightTops& tops, const ByTrial& samples, const Share& share) {
  const Eigen::MatrixXd parabola = LeftByParabola(FlightTops::kSamples);
  std::vector<double> squares;
  for (const FlightTops::Top& top : tops.found)
    squares.push_back((parabola * tops.Window(top, samples[top.trial])).squaredNorm() /
                      (FlightTops::kSamples - 3));
  std::sort(squares.begin(), squares.end());
  const boost::math::chi_squared chi2(share.freedom);
  const double middle = squares[squares.size() / 2] / boost::math::quantile(chi2, 0.5);
  const double most = middle * boost::math::quantile(chi2, 0.999);
  const auto end = std::upper_bound(squares.begin(), squares.end(), most);
  const double sum = std::accumulate(squares.begin(), end, 0.0);
  return std::sqrt(sum / static_cast<double>(end - squares.begin()) / share.square);
}

}  // namespace

double StrengthThroughFilter(double tau, double step) {
  return std::sqrt(std::max(1.0, kWidth * tau / step));
}

std::optional<FilteredNoise> FindFilteredNoise(const FitProblem& problem) {
  if (TraitsOf(problem.law).lands_leg_by_leg) return std::nullopt;
  std::vector<ByTrial> samples(problem.channels.size());
  std::vector<PlaceTrace> traces;
  for (const TrialProblem& trial : problem.trials)
    traces.push_back({trial.row_times, {}, {}, trial.parameters.g});
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    const Channel channel = problem.channels[c].channel;
    if (channel != Channel::kBodyX && channel != Channel::kBodyY) continue;
    samples[c] = SamplesOf(problem, c);
    for (std::size_t i = 0; i < traces.size(); ++i)
      (channel == Channel::kBodyX ? traces[i].x : traces[i].y) = samples[c][i];
  }
  const FlightTops tops = FindFlightTops(traces);
  FilteredNoise noise{.tau = FilterTimeOf(traces, tops)};
  if (!std::isfinite(noise.tau)) return std::nullopt;
  noise.strength = StrengthThroughFilter(noise.tau, tops.step);
  const Share share = LeftOfFiltered(noise.tau, tops.apart());
  for (const ByTrial& of_channel : samples)
    noise.sigma.push_back(of_channel.empty() ? kNaN : SigmaAt(tops, of_channel, share));
  return noise;
}

}  // namespace hoplab
