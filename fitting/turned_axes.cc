#include "fitting/turned_axes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fitting/fit.h"
#include "fitting/missed_motion.h"

namespace hoplab {
namespace {

constexpr std::size_t kTrials = 6;  // are enough
constexpr double kMissed = 0.2;     // rms, of the motion's own rms
constexpr double kFollowed = 0.3;   // likewise, at most, with one turned
constexpr double kBetter = 0.5;     // of what is missed as it stands

// What may have been recorded otherwise.
enum class Axis { kX, kPitch, kLegOrder, kLegAngles };
struct Turn {
  Axis axis;
  const char* what;
  const char* rule;
};
constexpr std::array kTurns = {
    Turn{Axis::kX, "the sign of x", "x must grow ahead, where a touch-down angle takes the foot"},
    Turn{Axis::kPitch, "the sign of the pitch", "it must grow as the nose goes up"},
    Turn{Axis::kLegOrder, "the order of the legs", "leg 1 is the hindmost, and hip_m grows ahead"},
    Turn{Axis::kLegAngles, "the signs of the legs' angles",
         "they must grow as the toe goes ahead"}};

bool Turns(Axis axis, Channel c) {
  if (axis == Axis::kPitch) return c == Channel::kBodyPitch;
  return axis == Axis::kX && (c == Channel::kBodyX || c == Channel::kBodyVx);
}
bool Turns(Axis axis, const std::string& start) {
  if (axis == Axis::kPitch) return start == "pitch0" || start == "pitch_rate0";
  return axis == Axis::kX && (start == "x0" || start == "vx0" || start == "contact0");
}

void Apply(Axis axis, const FitProblem& problem, TrialProblem& trial) {
  const std::size_t width = problem.channels.size();
  for (std::size_t c = 0; c < width; ++c) {
    if (!Turns(axis, problem.channels[c].channel)) continue;
    for (std::size_t i = c; i < trial.data.size(); i += width) trial.data[i] = -trial.data[i];
  }
  for (int k = 0; k < trial.own_count(); ++k)
    if (Turns(axis, trial.own[static_cast<std::size_t>(k)].name)) trial.start[k] = -trial.start[k];
  if (!trial.parameters.robot) return;
  RobotParameters<double>& robot = *trial.parameters.robot;
  if (axis == Axis::kLegOrder) {
    std::reverse(robot.hip_x.begin(), robot.hip_x.begin() + robot.legs);
    std::reverse(robot.hip_y.begin(), robot.hip_y.begin() + robot.legs);
  }
  if (axis == Axis::kLegAngles) {
    for (double& angle : robot.angle) angle = -angle;
    for (double& rate : robot.rate) rate = -rate;
    for (DrivenColumn& column : trial.inputs) {
      if (column.kind < InputKind::kHipTorque1) continue;  // no motor's
      for (double& value : column.values) value = -value;
    }
  }
}

double MeanMissed(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                  const Turn* turn) {
  double sum = 0.0;
  for (TrialProblem trial : trials) {
    if (turn) Apply(turn->axis, problem, trial);
    sum += MissedMotion(problem, trial);
  }
  return sum / static_cast<double>(trials.size());
}

// A clock turns one way only, so that no sign of its angles turns it.
bool MeansSomething(Axis axis, const TrialProblem& trial) {
  if (axis == Axis::kX) return true;
  if (!trial.parameters.robot) return false;
  const RobotParameters<double>& robot = *trial.parameters.robot;
  if (axis == Axis::kLegOrder) return robot.legs > 1;
  return axis == Axis::kPitch || robot.control != MotorControl::kClock;
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
    if (!MeansSomething(turn.axis, trials.front())) continue;
    const double missed = MeanMissed(problem, trials, &turn);
    if (missed >= least) continue;
    least = missed;
    best = &turn;
  }
  if (!best) return {};
  return {std::string("at the nominal values the simulation misses the body by ") +
          MissedPercent(as_it_stands) + " of its motion, and by " + MissedPercent(least) +
          " with " + best->what + " turned; " + best->rule};
}

}  // namespace hoplab
