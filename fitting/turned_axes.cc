#include "fitting/turned_axes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/units.h"
#include "fitting/fit.h"
#include "fitting/missed_motion.h"

namespace hoplab {
namespace {

constexpr std::size_t kTrials = 6;  // are enough
constexpr double kMissed = 0.2;     // rms, of the motion's own rms
constexpr double kFollowed = 0.3;   // likewise, at most, with one turned
constexpr double kBetter = 0.5;     // of what is missed as it stands
constexpr double kLargestUsual_rad = 1.6;

// What may have been recorded otherwise.
enum class Axis {
  kX,
  kPitch,
  kLegOrder,
  kLegAngles,
  kPitchDegrees,
  kLegColumns,
  kLegColumnSigns,
  kLegDegrees
};
struct Turn {
  Axis axis;
  bool of_start;  // of what is stated or found of it, too
  const char* what;
  const char* rule;
};
constexpr const char* kXAhead = "x must grow ahead, where a touch-down angle takes the foot";
constexpr const char* kNoseUp = "it must grow as the nose goes up";
constexpr const char* kToeAhead = "they must grow as the toe goes ahead";
constexpr const char* kHindmost = "leg 1 is the hindmost, and hip_m grows ahead";
constexpr const char* kRadians = "angles are in radians";
constexpr std::array kTurns = {
    Turn{Axis::kX, true, "the sign of x turned", kXAhead},
    Turn{Axis::kX, false, "the sign of x turned, but not that of its start", kXAhead},
    Turn{Axis::kPitch, true, "the sign of the pitch turned", kNoseUp},
    Turn{Axis::kPitch, false, "the sign of the pitch turned, but not that of its start", kNoseUp},
    Turn{Axis::kPitchDegrees, true, "the pitch and its start taken for degrees", kRadians},
    Turn{Axis::kPitchDegrees, false, "the pitch taken for degrees, but not its start", kRadians},
    Turn{Axis::kLegOrder, false, "the order of the legs turned", kHindmost},
    Turn{Axis::kLegAngles, false, "the signs of the legs' angles turned", kToeAhead},
    Turn{Axis::kLegColumns, false, "the columns of the legs' angles exchanged", kHindmost},
    Turn{Axis::kLegColumnSigns, false, "the signs of the columns of the legs' angles turned",
         kToeAhead},
    Turn{Axis::kLegDegrees, false, "the columns of the legs' angles taken for degrees", kRadians}};

// What a column and a start are multiplied by.
double FactorOf(Axis axis, Channel c) {
  const bool is_x = c == Channel::kBodyX || c == Channel::kBodyVx;
  const bool is_pitch = c == Channel::kBodyPitch;
  if (axis == Axis::kX) return is_x ? -1.0 : 1.0;
  if (axis == Axis::kPitch) return is_pitch ? -1.0 : 1.0;
  if (axis == Axis::kPitchDegrees) return is_pitch ? DegToRad(1.0) : 1.0;
  if (axis == Axis::kLegDegrees) return IsAngleOfLeg(c) ? DegToRad(1.0) : 1.0;
  const bool turns = axis == Axis::kLegAngles || axis == Axis::kLegColumnSigns;
  return turns && IsAngleOfLeg(c) ? -1.0 : 1.0;
}
double FactorOf(Axis axis, const std::string& start) {
  if (start == "pitch0" || start == "pitch_rate0") return FactorOf(axis, Channel::kBodyPitch);
  const bool is_x = start == "x0" || start == "vx0" || start == "contact0";
  return is_x ? FactorOf(axis, Channel::kBodyX) : 1.0;
}

// The first of the legs' columns changes places with the last one, and so on.
void ExchangeLegColumns(const FitProblem& problem, TrialProblem& trial) {
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < problem.channels.size(); ++c)
    if (IsAngleOfLeg(problem.channels[c].channel)) columns.push_back(c);
  for (std::size_t row = 0; row < trial.row_times.size(); ++row)
    for (std::size_t i = 0; i < columns.size() / 2; ++i)
      std::swap(trial.data[row * problem.channels.size() + columns[i]],
                trial.data[row * problem.channels.size() + columns[columns.size() - 1 - i]]);
}

void TurnRobot(Axis axis, RobotParameters<double>& robot, std::vector<DrivenColumn>& inputs) {
  if (axis == Axis::kLegOrder) {
    std::reverse(robot.hip_x.begin(), robot.hip_x.begin() + robot.legs);
    std::reverse(robot.hip_y.begin(), robot.hip_y.begin() + robot.legs);
  }
  if (axis != Axis::kLegAngles) return;
  for (double& angle : robot.angle) angle = -angle;
  for (double& rate : robot.rate) rate = -rate;
  for (DrivenColumn& column : inputs) {
    if (column.kind < InputKind::kHipTorque1) continue;  // no motor's
    for (double& value : column.values) value = -value;
  }
}

void Apply(const Turn& turn, const FitProblem& problem, TrialProblem& trial) {
  const std::size_t width = problem.channels.size();
  for (std::size_t c = 0; c < width; ++c) {
    const double factor = FactorOf(turn.axis, problem.channels[c].channel);
    if (factor == 1.0) continue;
    for (std::size_t i = c; i < trial.data.size(); i += width) trial.data[i] *= factor;
  }
  for (int k = 0; turn.of_start && k < trial.own_count(); ++k)
    trial.start[k] *= FactorOf(turn.axis, trial.own[static_cast<std::size_t>(k)].name);
  if (turn.axis == Axis::kLegColumns) ExchangeLegColumns(problem, trial);
  if (trial.parameters.robot) TurnRobot(turn.axis, *trial.parameters.robot, trial.inputs);
}

double MeanMissed(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                  const Turn* turn) {
  double sum = 0.0;
  for (TrialProblem trial : trials) {
    if (turn) Apply(*turn, problem, trial);
    sum += MissedMotion(problem, trial);
  }
  return sum / static_cast<double>(trials.size());
}

// Whether what a turn would take for degrees has values that are none of radians.
bool LooksLikeDegrees(Axis axis, const FitProblem& problem,
                      const std::vector<TrialProblem>& trials) {
  const std::size_t width = problem.channels.size();
  for (std::size_t c = 0; c < width; ++c) {
    if (FactorOf(axis, problem.channels[c].channel) == 1.0) continue;
    for (const TrialProblem& trial : trials)
      for (std::size_t i = c; i < trial.data.size(); i += width)
        if (std::abs(trial.data[i]) > kLargestUsual_rad) return true;
  }
  return false;
}

// A clock turns one way only, so that no sign of its angles turns it.
bool MeansSomething(Axis axis, const FitProblem& problem, const std::vector<TrialProblem>& trials) {
  const TrialProblem& trial = trials.front();
  if (axis == Axis::kX) return true;
  if (!trial.parameters.robot) return false;
  if (axis == Axis::kPitchDegrees || axis == Axis::kLegDegrees)
    return LooksLikeDegrees(axis, problem, trials);
  const RobotParameters<double>& robot = *trial.parameters.robot;
  if (axis == Axis::kLegOrder || axis == Axis::kLegColumns) return robot.legs > 1;
  return axis != Axis::kLegAngles || robot.control != MotorControl::kClock;
}

}  // namespace

std::vector<std::string> TurnedAxes(const FitProblem& problem) {
  std::vector<TrialProblem> trials = TrialsOf(problem, TrialRole::kTrain);
  if (trials.size() > kTrials) trials.resize(kTrials);
  for (TrialProblem& trial : trials) trial = FirstPart(problem, trial, kFirstMotion_s);
  if (trials.empty()) return {};
  const double as_it_stands = MeanMissed(problem, trials, nullptr);
  if (as_it_stands < kMissed * kMissed) return {};
  const Turn* best = nullptr;
  double least = std::min(kBetter * kBetter * as_it_stands, kFollowed * kFollowed);
  for (const Turn& turn : kTurns) {
    if (!MeansSomething(turn.axis, problem, trials)) continue;
    const double missed = MeanMissed(problem, trials, &turn);
    // Of a start near zero no sign tells: the column alone must be clearly better.
    const bool same_axis = best && best->axis == turn.axis;
    if (missed >= (same_axis ? kBetter * kBetter : 1.0) * least) continue;
    least = missed;
    best = &turn;
  }
  if (!best) return {};
  return {std::string("at the nominal values the simulation misses what is recorded by ") +
          MissedPercent(as_it_stands) + " of its motion, and by " + MissedPercent(least) +
          " with " + best->what + "; " + best->rule};
}

}  // namespace hoplab
