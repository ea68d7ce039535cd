#include "fitting/diagnosis/measure.h"

#include <algorithm>
#include <cmath>

#include "base/nan.h"
#include "base/random.h"
#include "fitting/apex_segments.h"
#include "fitting/contact_reading.h"

namespace hoplab {
namespace {

constexpr int kDraws = 2000;
constexpr int kFewestBlocks = 4;
constexpr int kFewestRows = 10;  // of a block

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
    const OwnValues& at = pieces[k].start;
    const double g = trial.parameters.g;
    apexes.push_back(
        {pieces[k].begin_s - trial.begin_s + at[3] / g, at[1] + 0.5 * at[3] * at[3] / g});
  }
  return apexes;
}

// The contacts of a trial at the instants its column was read, as the fit takes them [s].
ContactTimes SeenContacts(const FitProblem& problem, const TrialProblem& trial,
                          const Eigen::VectorXd& shared, const OwnValues& own) {
  const ContactReading reading(problem, trial, {shared, own});
  ContactTimes seen = trial.contact;
  for (std::vector<double>* times : {&seen.touchdown_s, &seen.liftoff_s})
    for (double& stamp : *times) stamp = reading.Time(stamp);
  return seen;
}

FeatureErrors Features(const FitProblem& problem, const Eigen::VectorXd& shared,
                       const std::vector<TrialErrors>& trials) {
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
    const ContactTimes seen = SeenContacts(problem, trial, shared, trials[i].start);
    for (std::size_t k = 0; k < std::min(down.size(), seen.touchdown_s.size()); ++k)
      touchdown.Add(down[k] - seen.touchdown_s[k]);
    for (std::size_t k = 0;
         k < std::min({down.size(), up.size(), seen.touchdown_s.size(), seen.liftoff_s.size()});
         ++k)
      stance.Add((up[k] - down[k]) - (seen.liftoff_s[k] - seen.touchdown_s[k]));
  }
  return {height.Root(), time.Root(), touchdown.Root(), stance.Root()};
}

// What one stretch of a held-out trial gains.
struct Block {
  double gain = 0.0;
  long samples = 0;
};

// A trial cut at the hops of the extended model, and these into stretches of about `length`.
void AddBlocks(const TrialErrors& before, const TrialErrors& after, double length,
               std::vector<Block>& blocks) {
  std::vector<double> cuts;
  for (std::size_t h = 0; h < after.hops.size(); ++h) {
    const double begin = after.hops[h].begin, end = after.hops[h].end;
    const int parts = std::max(1, static_cast<int>(std::floor((end - begin) / length)));
    for (int p = 0; p < parts; ++p) cuts.push_back(begin + (end - begin) * p / parts);
  }
  std::vector<Block> found(cuts.size());
  for (std::size_t i = 0; i < after.sample_nll.size(); ++i) {
    const auto next = std::upper_bound(cuts.begin(), cuts.end(), after.sample_times[i]);
    if (next == cuts.begin()) continue;
    Block& block = found[static_cast<std::size_t>(next - cuts.begin()) - 1];
    block.gain += before.sample_nll[i] - after.sample_nll[i];
    ++block.samples;
  }
  // What the start has to be moved from where it was stated counts like what it moves.
  if (!found.empty()) found.front().gain += before.prior_nll - after.prior_nll;
  for (const Block& b : found) {
    if (b.samples > 0) blocks.push_back(b);
  }
}

}  // namespace

HeldOutErrors MeasureHeldOut(const FittedModel& model, int jobs, bool test_only,
                             const HeldOutErrors* like) {
  FitResult fit;
  fit.ok = model.ok();
  fit.shared = model.shared;
  fit.initial_states = model.initial_states;
  fit.cost = model.cost;
  FitOptions options;
  options.jobs = jobs;
  HeldOutErrors out;
  out.trials = AssessTrials(model.problem, fit, options, test_only, like ? &like->trials : nullptr);
  out.test = Summarise(model.problem, out.trials, TrialRole::kTest);
  out.features = Features(model.problem, model.shared, out.trials);
  return out;
}

HeldOutGain CompareHeldOut(const FittedModel& before, const HeldOutErrors& errors_before,
                           const HeldOutErrors& errors_after, std::uint64_t seed,
                           std::vector<std::string>* left_out) {
  const double together = before.problem.noise.IsWhite() ? 0.0 : before.problem.noise.time_scale;
  std::vector<Block> blocks;
  HeldOutGain out;
  for (std::size_t i = 0; i < before.problem.trials.size(); ++i) {
    const TrialProblem& trial = before.problem.trials[i];
    if (trial.role != TrialRole::kTest) continue;
    const TrialErrors &b = errors_before.trials[i], &a = errors_after.trials[i];
    if (!b.complete || !a.complete) {
      if (left_out) left_out->push_back(trial.file);
      continue;
    }
    const double step = trial.row_times.back() / static_cast<double>(trial.row_times.size());
    AddBlocks(b, a, std::max(together, kFewestRows * step), blocks);
    out.hops += static_cast<int>(a.hops.size());
  }
  double gain = 0.0;
  for (const Block& b : blocks) {
    gain += b.gain;
    out.samples += b.samples;
  }
  out.blocks = static_cast<int>(blocks.size());
  out.nats_per_sample = out.samples > 0 ? gain / static_cast<double>(out.samples) : kNaN;
  if (out.blocks < kFewestBlocks) return out;
  RandomStream random(seed, 1);
  std::vector<double> draws(kDraws);
  for (double& draw : draws) {
    double g = 0.0, n = 0.0;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const auto pick =
          static_cast<std::size_t>(random.Uniform(0.0, 1.0) * static_cast<double>(blocks.size()));
      g += blocks[pick].gain;
      n += static_cast<double>(blocks[pick].samples);
    }
    draw = g / n;
  }
  std::sort(draws.begin(), draws.end());
  out.ci95 = {draws[static_cast<std::size_t>(0.025 * kDraws)],
              draws[static_cast<std::size_t>(0.975 * kDraws)]};
  return out;
}

}  // namespace hoplab
