#include "fitting/trial_noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/nan.h"
#include "base/text.h"
#include "datasets/suspect_things.h"
#include "fitting/noise.h"

namespace hoplab {
namespace {

constexpr double kLeastFactor = 1.3, kSureOf = 4.0;
constexpr double kSamplesOfWindow = 12.0;
// Relative standard error of the median of so many windows' deviations, each with 9 degrees of
// freedom.
double ErrorOf(double windows) { return 1.25 / std::sqrt(2.0 * 9.0 * windows); }

double MedianOf(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return kNaN;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// How many times the noise of others one is, as logarithm; 0 where that is not clear.
double ClearlyOff(double noise, double of_all, double high, double high_of_all, double windows) {
  const double by_flights = std::log(noise / of_all), by_high = std::log(high / high_of_all);
  if (!std::isfinite(by_flights) || !std::isfinite(by_high)) return 0.0;
  if (by_flights * by_high <= 0.0) return 0.0;
  const double less = std::min(std::abs(by_flights), std::abs(by_high));
  const double least = std::max(std::log(kLeastFactor), kSureOf * ErrorOf(windows));
  return less > least ? 0.5 * (by_flights + by_high) : 0.0;
}

}  // namespace

double SigmaIn(const FitProblem& problem, const TrialProblem& trial, std::size_t channel) {
  return problem.channels[channel].sigma * NoiseFactorIn(trial, channel);
}

double NoiseFactorIn(const TrialProblem& trial, std::size_t channel) {
  return trial.noise_factors.empty() ? 1.0 : trial.noise_factors[channel];
}

double AmplitudeIn(const NoiseModel& noise, const TrialProblem& trial, std::size_t channel) {
  return noise.AmplitudeOf(channel) / NoiseFactorIn(trial, channel);
}

std::vector<std::string> FindTrialNoise(FitProblem& problem, std::size_t channel,
                                        bool only_louder) {
  const ChannelProblem& of = problem.channels[channel];
  if (of.channel > Channel::kBodyVy || problem.trials.size() < 2) return {};
  const std::vector<std::vector<double>> samples = SamplesOf(problem, channel);
  std::vector<double> high;
  for (std::size_t i = 0; i < samples.size(); ++i)
    high.push_back(HighFrequencyNoise(problem.trials[i].row_times, samples[i]));
  const double high_of_all = MedianOf(high);
  std::vector<std::string> found;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    TrialProblem& trial = problem.trials[i];
    const std::array<SampledColumn, 1> column = {{{trial.row_times, samples[i]}}};
    const auto count = std::count_if(samples[i].begin(), samples[i].end(),
                                     [](double v) { return !std::isnan(v); });
    const double off = ClearlyOff(EstimateNoise(column), of.sigma, high[i], high_of_all,
                                  static_cast<double>(count) / kSamplesOfWindow);
    if (off == 0.0 || (only_louder && off < 0.0)) continue;
    trial.noise_factors.resize(problem.channels.size(), 1.0);
    trial.noise_factors[channel] = std::exp(off);
    found.push_back(trial.file + ": " + std::string(NameOf(of.channel)) + " scatters by " +
                    Rounded(SigmaIn(problem, trial, channel)) + ", " +
                    (off > 0.0 ? "more" : "less") +
                    " than in the other trials; it counts by its own noise");
  }
  return found;
}

}  // namespace hoplab
