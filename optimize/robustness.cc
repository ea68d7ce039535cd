#include "optimize/robustness.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "optimize/stride_map.h"
#include "optimize/stride_search.h"

namespace hoplab {
namespace {

// Evenly from -1 to 1.
double Spread(int i, int count) { return count > 1 ? 2.0 * i / (count - 1) - 1.0 : 0.0; }

WorstCase TryAll(const std::vector<Hopper>& hoppers, int jobs) {
  std::vector<ConvergenceTime> times(hoppers.size());
  std::vector<char> ended(hoppers.size(), 0), settled(hoppers.size(), 0);
  ParallelFor(static_cast<int>(hoppers.size()), jobs, [&](int i) {
    if (HasStrides(hoppers[i])) {
      const StrideEnd end = EndOfStrides(hoppers[i]);
      ended[i] = end.ended;
      settled[i] = end.settled;
      return;
    }
    const Trajectory run = Simulate(RequestOf(hoppers[i]));
    ended[i] = !IsComplete(run.outcome);
    if (!ended[i]) times[i] = ConvergenceTimeOf(ApexSpeeds(run));
    settled[i] = times[i].converged();
  });
  WorstCase worst;
  worst.runs = static_cast<int>(hoppers.size());
  for (std::size_t i = 0; i < hoppers.size(); ++i) {
    worst.ended += ended[i];
    worst.converged += settled[i];
    worst.worst_time = std::fmax(worst.worst_time, times[i].time);
  }
  return worst;
}

std::vector<Hopper> OverStiffness(const Hopper& hopper, const RobustnessOptions& options) {
  const auto& robot = hopper.request.parameters.robot;
  const bool straight =
      robot ? robot->straight_legs : MechanismOf(hopper.request.law) == MechanismKind::kStraightLeg;
  const ParameterId id = straight ? ParameterId::kStiffness : ParameterId::kE;
  std::vector<Hopper> hoppers(static_cast<std::size_t>(options.stiffness_points), hopper);
  for (int i = 0; i < options.stiffness_points; ++i) {
    Parameters<double>& p = hoppers[i].request.parameters;
    const double factor = 1.0 + options.stiffness_range * Spread(i, options.stiffness_points);
    Field(p, id) *= factor;
    if (!p.robot) continue;
    p.robot->lateral_stiffness *= factor;
    for (double& E : p.robot->E) E *= factor;
  }
  return hoppers;
}

std::vector<Hopper> OverInitialStates(const Hopper& hopper, const RobustnessOptions& options) {
  const double height_range =
      HasStrides(hopper) ? options.robot_height_range : options.height_range;
  std::vector<Hopper> hoppers;
  for (int i = 0; i < options.start_points; ++i) {
    for (int j = 0; j < options.start_points; ++j) {
      Hopper moved = hopper;
      moved.request.initial[2] *= 1.0 + options.speed_range * Spread(i, options.start_points);
      moved.request.initial[1] *= 1.0 + height_range * Spread(j, options.start_points);
      hoppers.push_back(std::move(moved));
    }
  }
  return hoppers;
}

// Apex speeds of a hopper that lands at another angle every time; shorter than asked for if it
// falls.
std::vector<double> HopNoisily(const Hopper& hopper, const RobustnessOptions& options, int run,
                               int hops) {
  RandomStream random(options.seed, 7000 + static_cast<std::uint64_t>(run));
  ApexMap map(hopper);
  const double angle = hopper.request.parameters.theta_td;
  const auto& s = hopper.request.initial;
  ApexState z(s[2], s[1] + s[3] * s[3] / (2.0 * hopper.request.parameters.g));
  std::vector<double> speeds;
  for (int hop = 0; hop < hops; ++hop) {
    map.hopper().request.parameters.theta_td = angle + options.touchdown_noise * random.Normal();
    const Hop next = map.Apply(z);
    if (!next.ok()) break;
    z = next.next;
    speeds.push_back(z[0]);
  }
  return speeds;
}

NoisyHops WithNoise(const Hopper& hopper, const RobustnessOptions& options) {
  constexpr int kHops = 60;
  if (HasStrides(hopper)) return {};  // a clock lands its legs
  std::vector<std::vector<double>> speeds(static_cast<std::size_t>(options.noise_runs));
  ParallelFor(options.noise_runs, options.jobs,
              [&](int i) { speeds[i] = HopNoisily(hopper, options, i, kHops); });
  NoisyHops noise;
  noise.runs = options.noise_runs;
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (const std::vector<double>& run : speeds) {
    noise.fell += static_cast<int>(run.size()) < kHops;
    for (std::size_t i = kHops / 2; i < run.size(); ++i, ++count) {
      sum += run[i];
      squares += run[i] * run[i];
    }
  }
  if (count > 1) {
    const double mean = sum / count;
    noise.speed_deviation =
        std::sqrt(std::max(squares / count - mean * mean, 0.0)) / std::abs(mean);
  }
  return noise;
}

}  // namespace

Robustness AssessRobustness(const Hopper& hopper, const RobustnessOptions& options) {
  return {TryAll(OverStiffness(hopper, options), options.jobs),
          TryAll(OverInitialStates(hopper, options), options.jobs), WithNoise(hopper, options)};
}

}  // namespace hoplab
