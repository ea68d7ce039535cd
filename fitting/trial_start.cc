#include "fitting/trial_start.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/input_error.h"
#include "base/nan.h"
#include "fitting/model_of_spec.h"
#include "fitting/robot_problem.h"
#include "fitting/turning_rows.h"
#include "model/mechanism_traits.h"

namespace hoplab {
namespace {

// Sizes of a change of start that matter where no prior tells one: [m], [m], [m/s], [m/s].
constexpr std::array<double, 4> kStartScale = {0.01, 0.01, 0.05, 0.05};
constexpr std::array<const char*, 4> kStartNames = {"x0", "y0", "vx0", "vy0"};

bool Sees(const FitProblem& problem, Channel channel) {
  return std::any_of(problem.channels.begin(), problem.channels.end(),
                     [&](const ChannelProblem& c) { return c.channel == channel; });
}

// The contact of a record that begins in stance.
void SetContact(const Trial& trial, TrialProblem& t) {
  t.start_mode = ModeOfSpec(trial.initial->mode, trial.mechanism.type);
  const bool known = trial.initial_sigma && trial.initial_sigma->contact_x_m;
  OwnParameter contact{.name = "contact0",
                       .direction = SensitivityDirection::InitialState(4),
                       .scale = kStartScale[0],
                       .prior_mean = *trial.initial->contact_x_m};
  if (known) contact.prior_sigma = std::max(*trial.initial_sigma->contact_x_m, kTightestPrior);
  contact.scale = std::min(contact.scale, contact.prior_sigma);
  t.start.conservativeResize(5);
  t.start[4] = contact.prior_mean;
  t.own.push_back(contact);
}

// values = offset + slope t + curvature t^2 over the first rows, by least squares.
void LineFit(const TrialProblem& t, const std::vector<double>& values, std::size_t rows,
             double curvature, double& offset, double& slope) {
  double n = 0, st = 0, stt = 0, sv = 0, stv = 0;
  for (std::size_t i = 0; i < std::min(rows, values.size()); ++i) {
    if (std::isnan(values[i])) continue;
    const double time = t.row_times[i], v = values[i] - curvature * time * time;
    n += 1;
    st += time;
    stt += time * time;
    sv += v;
    stv += time * v;
  }
  const double det = n * stt - st * st;
  if (n < 1) return;
  if (n < 3 || det <= 0) {
    offset = sv / n;
    return;
  }
  slope = (n * stv - st * sv) / det;
  offset = (sv - slope * st) / n;
}

double SigmaOf(const FitProblem& problem, Channel channel) {
  for (const ChannelProblem& c : problem.channels)
    if (c.channel == channel) return c.sigma;
  return kNaN;
}

// Rows before the body is seen below its touch-down height, or turned by a ground that lies between
// two rows.
std::size_t FirstFlightRows(const std::vector<double>& y, double touchdown, double sigma) {
  std::size_t rows = 0;
  while (rows < y.size() && !(y[rows] < touchdown)) ++rows;
  const std::vector<int> turns = TurningRows(
      [&](int row) { return y[static_cast<std::size_t>(row)]; }, static_cast<int>(y.size()), sigma);
  return turns.empty() ? rows : std::min(rows, static_cast<std::size_t>(turns.front()));
}

// Start of a trial that states none: a parabola through the first flight, line in x.
OwnValues StartFromTrace(const Trial& trial, const FitProblem& problem, const TrialProblem& t) {
  if (TraitsOf(problem.law).has_pitch) {
    throw InputError({trial.origin.place, "initial", "is absent, and a robot needs it",
                      "State initial: {x_m, y_m, vx_m_per_s, vy_m_per_s, pitch_rad, "
                      "pitch_rate_rad_per_s} of the first row."});
  }
  const double g = t.parameters.g;
  OwnValues start = Eigen::Vector4d(0.0, kNaN, 0.0, 0.0);
  const double touchdown = TouchdownHeight(trial.mechanism, trial.touchdown_angle_rad);
  const std::vector<double>* y = trial.trace.Find(Channel::kBodyY);
  std::size_t rows = t.row_times.size();
  if (y) {
    rows = FirstFlightRows(*y, touchdown, SigmaOf(problem, Channel::kBodyY));
    LineFit(t, *y, rows, -0.5 * g, start[1], start[3]);
  }
  if (const std::vector<double>* x = trial.trace.Find(Channel::kBodyX))
    LineFit(t, *x, rows, 0.0, start[0], start[2]);
  if (const std::vector<double>* v = trial.trace.Find(Channel::kBodyVx);
      v && !std::isnan(v->front()))
    start[2] = v->front();
  if (const std::vector<double>* v = trial.trace.Find(Channel::kBodyVy);
      v && !std::isnan(v->front()))
    start[3] = v->front();
  if (!(start[1] >= touchdown)) {
    throw InputError({trial.origin.place, "initial",
                      "is absent, and the trace does not show where the first flight begins",
                      "State `initial: {x_m, y_m, vx_m_per_s, vy_m_per_s}` of the first row."});
  }
  return start;
}

}  // namespace

void SetStart(const Trial& trial, const FitProblem& problem, TrialProblem& t) {
  t.start =
      trial.initial ? OwnValues(StateOfSpec(*trial.initial)) : StartFromTrace(trial, problem, t);
  for (int i = 0; i < 4; ++i) {
    t.own.push_back({.name = kStartNames[i],
                     .direction = SensitivityDirection::InitialState(i),
                     .scale = kStartScale[i],
                     .prior_mean = t.start[i]});
  }
  if (trial.initial && trial.initial_sigma) {
    const OwnValues sigma = StateOfSpec(*trial.initial_sigma);
    for (int i = 0; i < 4; ++i) {
      t.own[i].prior_sigma = std::max(sigma[i], kTightestPrior);
      t.own[i].scale = std::min(t.own[i].scale, t.own[i].prior_sigma);
    }
  }
  if (TraitsOf(problem.law).has_pitch) AddPitch(trial, t);
  if (trial.initial && trial.initial->mode != StartMode::kFlight) SetContact(trial, t);
  // Without a channel that knows where the hopper is along the ground, x is a free choice.
  if (!Sees(problem, Channel::kBodyX) && std::isinf(t.own[0].prior_sigma)) t.own[0].free = false;
}

}  // namespace hoplab
