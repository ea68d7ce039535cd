#include "fitting/diagnosis/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "fitting/apex_segments.h"

namespace hoplab {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kDraws = 2000;
constexpr int kFewestHops = 4;

struct MeanSquare {
  double sum = 0.0;
  int count = 0;
  void Add(double error) {
    sum += error * error;
    ++count;
  }
  double Root() const { return count > 0 ? std::sqrt(sum / count) : kNaN; }
};

std::vector<double> TimesOf(const Trajectory& trajectory, EventKind kind) {
  std::vector<double> times;
  for (const Event& e : trajectory.events) {
    if (e.kind == kind) times.push_back(e.time);
  }
  return times;
}

struct ShownApex {
  double time, height;  // s since the first row, m
};
std::vector<ShownApex> ApexesOf(const FitProblem& problem, const TrialProblem& trial) {
  std::vector<ShownApex> apexes;
  const std::vector<TrialProblem> pieces = CutAtApexes(problem, trial);
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    const std::array<double, 4>& at = pieces[k].start;
    const double g = trial.parameters.g;
    apexes.push_back(
        {pieces[k].begin_s - trial.begin_s + at[3] / g, at[1] + 0.5 * at[3] * at[3] / g});
  }
  return apexes;
}

FeatureErrors Features(const FitProblem& problem, const std::vector<TrialErrors>& trials) {
  MeanSquare height, time, touchdown, stance;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialProblem& trial = problem.trials[i];
    if (trials[i].role != TrialRole::kTest || !trials[i].complete) continue;
    // Apexes as the channels show them, measured and simulated read off by the same parabolas.
    TrialProblem simulated = trial;
    simulated.data = trials[i].trajectory.samples;
    const std::vector<ShownApex> seen_apexes = ApexesOf(problem, trial);
    const std::vector<ShownApex> simulated_apexes = ApexesOf(problem, simulated);
    if (seen_apexes.size() == simulated_apexes.size()) {
      for (std::size_t k = 0; k < seen_apexes.size(); ++k) {
        height.Add(simulated_apexes[k].height - seen_apexes[k].height);
        time.Add(simulated_apexes[k].time - seen_apexes[k].time);
      }
    }
    const std::vector<double> down = TimesOf(trials[i].trajectory, EventKind::kTouchdown);
    const std::vector<double> up = TimesOf(trials[i].trajectory, EventKind::kLiftoff);
    const ContactTimes& seen = trial.contact;
    for (std::size_t k = 0; k < std::min(down.size(), seen.touchdown_s.size()); ++k)
      touchdown.Add(down[k] - seen.touchdown_s[k]);
    for (std::size_t k = 0;
         k < std::min({down.size(), up.size(), seen.touchdown_s.size(), seen.liftoff_s.size()});
         ++k)
      stance.Add((up[k] - down[k]) - (seen.liftoff_s[k] - seen.touchdown_s[k]));
  }
  return {height.Root(), time.Root(), touchdown.Root(), stance.Root()};
}

// Chi-square of the rows of [begin, end) of a trial.
double ChiSquared(const FitProblem& problem, const TrialProblem& trial,
                  const Trajectory& trajectory, double begin, double end, long& samples) {
  const std::size_t channels = problem.channels.size();
  double sum = 0.0;
  for (std::size_t cell = 0; cell < trial.data.size(); ++cell) {
    const double t = trial.row_times[cell / channels];
    if (std::isnan(trial.data[cell]) || t < begin || t >= end) continue;
    const double r =
        (trajectory.samples[cell] - trial.data[cell]) / problem.channels[cell % channels].sigma;
    sum += r * r;
    ++samples;
  }
  return sum;
}

}  // namespace

HeldOutErrors MeasureHeldOut(const Extension& model, int jobs) {
  FitResult fit;
  fit.ok = model.ok();
  fit.shared = model.shared;
  fit.starts = model.starts;
  fit.cost = model.cost;
  FitOptions options;
  options.jobs = jobs;
  HeldOutErrors out;
  out.trials = AssessTrials(model.problem, fit, options);
  out.test = Summarise(model.problem, out.trials, TrialRole::kTest);
  out.features = Features(model.problem, out.trials);
  return out;
}

HeldOutGain CompareHeldOut(const Extension& before, const HeldOutErrors& errors_before,
                           const HeldOutErrors& errors_after, std::uint64_t seed,
                           std::vector<std::string>* left_out) {
  struct Hop {
    double gain;
    long samples;
  };
  std::vector<Hop> hops;
  for (std::size_t i = 0; i < before.problem.trials.size(); ++i) {
    const TrialProblem& trial = before.problem.trials[i];
    if (trial.role != TrialRole::kTest) continue;
    const TrialErrors &b = errors_before.trials[i], &a = errors_after.trials[i];
    if (!b.complete || !a.complete) {
      if (left_out) left_out->push_back(trial.file);
      continue;
    }
    // Hops as the extended model cuts them.
    for (std::size_t h = 0; h < a.hops.size(); ++h) {
      const double begin = a.hops[h].begin;
      const double end =
          h + 1 < a.hops.size() ? a.hops[h + 1].begin : std::numeric_limits<double>::infinity();
      long samples = 0, again = 0;
      const double gain =
          0.5 * (ChiSquared(before.problem, trial, b.trajectory, begin, end, samples) -
                 ChiSquared(before.problem, trial, a.trajectory, begin, end, again));
      if (samples > 0) hops.push_back({gain, samples});
    }
  }
  HeldOutGain out;
  double gain = 0.0;
  for (const Hop& h : hops) {
    gain += h.gain;
    out.samples += h.samples;
  }
  out.hops = static_cast<int>(hops.size());
  out.nats_per_sample = out.samples > 0 ? gain / static_cast<double>(out.samples) : kNaN;
  if (out.hops < kFewestHops) return out;
  RandomStream random(seed, 1);
  std::vector<double> draws(kDraws);
  for (double& draw : draws) {
    double g = 0.0, n = 0.0;
    for (std::size_t k = 0; k < hops.size(); ++k) {
      const auto pick =
          static_cast<std::size_t>(random.Uniform(0.0, 1.0) * static_cast<double>(hops.size()));
      g += hops[pick].gain;
      n += static_cast<double>(hops[pick].samples);
    }
    draw = g / n;
  }
  std::sort(draws.begin(), draws.end());
  out.ci95 = {draws[static_cast<std::size_t>(0.025 * kDraws)],
              draws[static_cast<std::size_t>(0.975 * kDraws)]};
  return out;
}

}  // namespace hoplab
