#include "fitting/diagnosis/gate.h"

#include <algorithm>
#include <cmath>

#include "fitting/noise.h"
#include "fitting/trial_evaluator.h"
#include "fitting/trial_noise.h"

namespace hoplab {
namespace {

constexpr double kNoiseExcess = 1.25;

// Estimated noise of a channel over all trials; NaN where there are too few samples. Only
// coordinates and speeds are parabolas in flight.
double EstimatedNoise(const FitProblem& problem, std::size_t channel) {
  if (problem.channels[channel].channel > Channel::kBodyVy)
    return std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::vector<double>> samples = SamplesOf(problem, channel);
  std::vector<SampledColumn> columns;
  for (std::size_t i = 0; i < samples.size(); ++i)
    columns.push_back({problem.trials[i].row_times, samples[i]});
  return EstimateNoise(columns);
}

std::string Text(const char* format, double a, double b = 0.0) {
  char text[160];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

}  // namespace

bool Gate::passed() const {
  return std::all_of(checks.begin(), checks.end(), [](const GateCheck& c) { return c.passed; });
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
  for (std::size_t c = 0; c < problem.channels.size(); ++c) {
    ChannelProblem& channel = problem.channels[c];
    if (channel.sigma_estimated) continue;
    const double estimate = EstimatedNoise(problem, c);
    if (estimate > kNoiseExcess * channel.sigma) {
      notes.push_back(std::string(NameOf(channel.channel)) +
                      Text(": the flights scatter by %.3g, more than the stated sigma %.3g; the "
                           "larger one is used",
                           estimate, channel.sigma));
      channel.sigma = estimate;
      channel.sigma_estimated = true;
    }
    for (std::string& found : FindTrialNoise(problem, c, !channel.sigma_estimated))
      notes.push_back(std::move(found));
  }
  return notes;
}

Gate CheckGate(const FittedModel& null, const std::vector<TrialProblem>& train, int jobs) {
  Gate gate;
  if (!null.ok()) {
    gate.checks.push_back({"fit", false,
                           "the fit without further effects ended as " +
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
  std::string incomplete;
  for (std::size_t i = 0; i < train.size(); ++i) {
    const TrialEvaluator evaluator(null.problem, train[i]);
    TrialEvaluation e;
    evaluator.Evaluate({null.shared, null.initial_states[i], false}, e);
    if (!e.complete && incomplete.empty())
      incomplete =
          train[i].file + ": the simulation " + std::string(SentenceOf(e.trajectory.outcome));
  }
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
