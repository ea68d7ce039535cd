#include "fitting/diagnosis/gate.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fitting/filtered_noise.h"
#include "fitting/noise.h"
#include "fitting/noise_correlation.h"
#include "fitting/trial_evaluator.h"
#include "fitting/trial_noise.h"
#include "model/mechanism_traits.h"

namespace hoplab {
namespace {

constexpr double kNoiseExcess = 1.25;

std::string Text(const char* format, double a, double b = 0.0) {
  char text[160];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

using Samples = std::vector<std::vector<double>>;
std::vector<SampledColumn> ColumnsOf(const FitProblem& problem, const Samples& samples) {
  std::vector<SampledColumn> columns;
  for (std::size_t i = 0; i < samples.size(); ++i)
    columns.push_back({problem.trials[i].row_times, samples[i]});
  return columns;
}

// The samples in the upper two thirds of each trial's highest flight, the others missing; none of a
// robot, whose legs land one by one.
Samples HighUp(const FitProblem& problem, Samples samples) {
  const MechanismTraits& traits = TraitsOf(problem.law);
  std::size_t y = 0;
  while (y < problem.channels.size() && problem.channels[y].channel != Channel::kBodyY) ++y;
  if (y == problem.channels.size() || traits.lands_leg_by_leg) return Samples(samples.size());
  const Samples heights = SamplesOf(problem, y);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double contact = traits.touchdown_height(problem.trials[i].parameters);
    double top = contact;
    for (const double height : heights[i]) top = std::fmax(top, height);
    for (std::size_t row = 0; row < samples[i].size(); ++row)
      if (!(heights[i][row] > contact + (top - contact) / 3.0))
        samples[i][row] = std::numeric_limits<double>::quiet_NaN();
  }
  return samples;
}

// Coordinates come of one instrument, and so do speeds.
bool ComeTogether(Channel a, Channel b) {
  return (a <= Channel::kBodyY) == (b <= Channel::kBodyY) && std::max(a, b) <= Channel::kBodyVy;
}

// How alike the noise of neighbouring samples is in the channels that come with this one, each in
// units of its own noise; 0 where they were smoothed.
double CorrelationOf(const FitProblem& problem, std::size_t channel) {
  std::vector<Samples> high;
  std::vector<SampledColumn> flights;
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    if (!ComeTogether(problem.channels[c].channel, problem.channels[channel].channel)) continue;
    const Samples samples = SamplesOf(problem, c);
    const std::vector<SampledColumn> columns = ColumnsOf(problem, samples);
    if (IsSmoothed(columns)) return 0.0;
    const double noise = EstimateNoise(columns);
    high.push_back(HighUp(problem, samples));
    for (std::vector<double>& column : high.back())
      for (double& value : column) value /= noise;
  }
  for (const Samples& of_channel : high)
    for (const SampledColumn& column : ColumnsOf(problem, of_channel)) flights.push_back(column);
  return NoiseCorrelation(flights);
}

// Noise of a channel over all trials, NaN where there are too few samples, and how many times as
// strong white noise must be to do the same to a slow motion, and why. Only coordinates and speeds
// are parabolas in flight.
struct FlightNoise {
  double sigma = std::numeric_limits<double>::quiet_NaN(), strength = 1.0;
  std::string why = {};
};
std::string WhyAlike(const NoiseShape& shape) {
  if (shape.filter == RecordFilter::kMovingAverage)
    return Text("went through a moving average over %.3g ms", 1e3 * shape.time);
  return Text(shape.filter == RecordFilter::kOnePass
                  ? "went through a filter that lags (time constant %.3g ms)"
                  : "went through a filter (time constant %.3g ms)",
              1e3 * shape.time);
}
FlightNoise NoiseInFlight(const FitProblem& problem, std::size_t channel,
                          const std::optional<FilteredNoise>& filtered) {
  FlightNoise noise;
  if (problem.channels[channel].channel > Channel::kBodyVy) return noise;
  if (filtered && filtered->Tells(channel))
    return {filtered->sigma[channel], filtered->shape.strength, WhyAlike(filtered->shape)};
  const double correlation = CorrelationOf(problem, channel);
  noise.sigma =
      EstimateNoise(ColumnsOf(problem, SamplesOf(problem, channel))) / SeenByParabolas(correlation);
  noise.strength = WhiteStrength(correlation);
  noise.why = Text("of neighbouring samples is alike (correlation %.2f)", correlation);
  return noise;
}

// The first trial that the model does not simulate to its end, and how it ends; empty: none.
std::string NotSimulated(const FittedModel& model, const std::vector<TrialProblem>& train) {
  for (std::size_t i = 0; i < std::min(train.size(), model.initial_states.size()); ++i) {
    TrialEvaluation e;
    TrialEvaluator(model.problem, train[i])
        .Evaluate({model.shared, model.initial_states[i], true}, e);
    if (!e.complete)
      return train[i].file + ": the simulation " + std::string(SentenceOf(e.trajectory.outcome)) +
             Text(", at %.3f s", train[i].begin_s + e.trajectory.end_time);
  }
  return "";
}

}  // namespace

bool Gate::passed() const {
  return std::all_of(checks.begin(), checks.end(), [](const GateCheck& c) { return c.passed; });
}

bool Gate::OnlyGradientsFailed() const {
  return !passed() && !std::isnan(certificate.max_relative_error) &&
         std::all_of(checks.begin(), checks.end(),
                     [](const GateCheck& c) { return c.passed || c.name == "gradients"; });
}

std::string Gate::Refusal() const {
  for (const GateCheck& c : checks) {
    if (!c.passed) return c.name + ": " + c.text;
  }
  return "";
}

GateCheck CheckGradients(const GradientCertificate& certificate) {
  const double worst = certificate.max_relative_error;
  const double clear = certificate.max_error_without_flags;
  if (worst < kGradientBound)
    return {"gradients", true, Text("agree with differences to %.1e through every event", worst)};
  if (std::isnan(worst))
    return {"gradients", false,
            "could not be checked, since no sample changes with what is fitted; times of contacts "
            "are not enough: record body_y_m, too"};
  const std::string differ =
      Text("differ from differences by %.1e", worst) + " (" + certificate.worst_parameter + ")";
  if (clear < kGradientBound)
    return {"gradients", true,
            differ + " in a trial where an event is met without crossing it; " +
                Text("in the trials without one they agree to %.1e", clear)};
  return {"gradients", false, differ + ": an event is met without crossing it"};
}

std::vector<std::string> CorrectNoise(FitProblem& problem) {
  std::vector<std::string> notes;
  const std::optional<FilteredNoise> filtered = FindFilteredNoise(problem);
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    ChannelProblem& channel = problem.channels[c];
    const FlightNoise noise = NoiseInFlight(problem, c, filtered);
    const bool is_filtered = filtered && filtered->Tells(c);
    const std::string name(NameOf(channel.channel));
    if (!channel.sigma_estimated && is_filtered) {
      // What is stated is the sensor's, before the filter, unless that is too little.
      if (!(noise.sigma * noise.strength > kNoiseExcess * channel.sigma)) continue;
      notes.push_back(name + Text(": before a filter the flights scattered by more than the stated "
                                  "sigma %.3g; that is used",
                                  channel.sigma));
      channel.sigma = noise.sigma;
      channel.sigma_estimated = true;
    } else if (!channel.sigma_estimated) {
      if (noise.sigma > kNoiseExcess * channel.sigma) {
        notes.push_back(name + Text(": the flights scatter by %.3g, more than the stated sigma "
                                    "%.3g; the larger one is used",
                                    noise.sigma, channel.sigma));
        channel.sigma = noise.sigma;
        channel.sigma_estimated = true;
      }
      for (std::string& found : FindTrialNoise(problem, c, !channel.sigma_estimated))
        notes.push_back(std::move(found));
    } else if (noise.strength > 1.0) {
      channel.sigma = noise.sigma;
    }
    if (!(noise.strength > 1.0)) continue;
    channel.sigma *= noise.strength;
    notes.push_back(name + ": the noise " + noise.why +
                    Text(", so it counts as white noise of %.3g", channel.sigma));
  }
  return notes;
}

std::vector<double> NoiseSquares(const FitProblem& problem) {
  std::vector<double> squares;
  const std::optional<FilteredNoise> filtered = FindFilteredNoise(problem);
  for (std::size_t c = 0; c < problem.channels.size(); ++c)
    squares.push_back(std::pow(NoiseInFlight(problem, c, filtered).strength, -2));
  return squares;
}

double AlikeRows(const std::vector<TrialProblem>& trials, const std::vector<double>& squares) {
  double rows = 0.0;
  for (const TrialProblem& t : trials)
    for (std::size_t cell = 0; cell < t.data.size() && !squares.empty(); ++cell)
      if (!std::isnan(t.data[cell])) rows += 1.0 - squares[cell % squares.size()];
  return rows;
}

Gate CheckGate(const FittedModel& null, const std::vector<TrialProblem>& train, int jobs) {
  Gate gate;
  const std::string incomplete = NotSimulated(null, train);
  if (!null.ok()) {
    gate.checks.push_back({"fit", false,
                           IsUsable(null.status)
                               ? "no values found let every train trial be simulated to its end (" +
                                     incomplete + "); try another law or --span whole_else_hops"
                               : "the fit without further effects ended as " +
                                     std::string(NameOf(null.status)) +
                                     "; try --starts 8 or another law with `hoplab fit`"});
    return gate;
  }
  const StopCheck stop = CheckStop(null.problem, train, null.shared, null.initial_states, {}, jobs);
  gate.at_minimum = stop.IsMinimum();
  std::string fault;
  for (const std::string& f : stop.faults) fault += (fault.empty() ? "" : "; ") + f;
  gate.checks.push_back({"fit", true,
                         stop.IsMinimum()
                             ? "the model without further effects is at its optimum"
                             : "the fit without further effects is no minimum: " + fault});
  gate.checks.push_back({"events", incomplete.empty(),
                         incomplete.empty()
                             ? "the simulation goes through every contact of every train trial"
                             : incomplete});

  std::string sigmas;
  bool known = true;
  for (const ChannelProblem& c : null.problem.channels) {
    known = known && std::isfinite(c.sigma) && c.sigma > 0.0;
    sigmas += (sigmas.empty() ? "" : ", ") + std::string(NameOf(c.channel)) +
              Text(" %.3g", c.sigma) + (c.sigma_estimated ? " (from the flights)" : " (stated)");
  }
  gate.checks.push_back({"noise", known, known ? sigmas : "is not known: " + sigmas});

  gate.certificate = CertifyGradients(null.problem, train, null.shared, null.initial_states, jobs);
  gate.checks.push_back(CheckGradients(gate.certificate));
  return gate;
}

}  // namespace hoplab
