#include "optimize/stride_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/check.h"
#include "model/mechanisms/gear.h"

namespace hoplab {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
// Body components of a section's state: y, vx, vy, pitch, its rate.
constexpr int kBodyStates = 5;
// Fewer strides than these have no section: the run fell while it started.
constexpr int kLeastStrides = 3;

const RobotParameters<double>& RobotOf(const Hopper& hopper) {
  return *hopper.request.parameters.robot;
}

// The ground's slope, effects included.
double SlopeOf(const Hopper& hopper) {
  double slope = hopper.request.parameters.slope;
  for (const EffectSetting& setting : hopper.effects)
    if (setting.effect->info.name == "ground_slope") slope += setting.values[0];
  return slope;
}

// Of which motors the gear has play, and whether motors lag so long that what they give is a state.
struct MotorStates {
  std::vector<int> geared;  // hindmost 1
  bool lag = false;
};
MotorStates MotorStatesOf(const Hopper& hopper, Eigen::Index states) {
  MotorStates motors;
  const int legs = RobotOf(hopper).legs;
  Parameters<double> acting = hopper.request.parameters;
  for (const EffectSetting& setting : hopper.effects)
    if (const auto change = setting.effect->hooks0.change_parameters)
      change(setting.values.data(), acting);
  for (int leg = 0; leg < legs; ++leg)
    if (Gear<double>::HasPlay(*acting.robot, leg)) motors.geared.push_back(leg + 1);
  const auto gears = static_cast<Eigen::Index>(motors.geared.size());
  motors.lag = states > kBodyStates + 3 * legs + 2 * gears;
  return motors;
}

// Share of a period, in [0, 1).
double Wrapped(double phase) { return phase - std::floor(phase); }

// Phases of the clock at which something happens in the stride that ends at `end` [s].
std::vector<double> BusyPhases(const RobotParameters<double>& robot, const Trajectory& run,
                               double end) {
  std::vector<double> phases;
  for (int leg = 0; leg < robot.legs; ++leg) {
    const double phase = robot.phase[static_cast<std::size_t>(leg)];
    phases.push_back(Wrapped(-phase));
    phases.push_back(Wrapped(robot.duty - phase));
  }
  for (const Event& event : run.events)
    if (event.time > end - robot.period && event.time <= end)
      phases.push_back(Wrapped(event.time / robot.period));
  std::sort(phases.begin(), phases.end());
  return phases;
}

double MiddleOfLongestGap(const std::vector<double>& sorted) {
  double best = 0.0, middle = 0.5;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double next = i + 1 < sorted.size() ? sorted[i + 1] : sorted.front() + 1.0;
    if (next - sorted[i] <= best) continue;
    best = next - sorted[i];
    middle = sorted[i] + 0.5 * best;
  }
  return Wrapped(middle);
}

}  // namespace

bool HasStrides(const Hopper& hopper) {
  return hopper.request.parameters.robot && RobotOf(hopper).control == MotorControl::kClock;
}

StrideMap::StrideMap(Hopper hopper, double phase, std::vector<Foot> feet)
    : ReturnMap(std::move(hopper)), phase_(phase), feet_(std::move(feet)) {
  HOPLAB_CHECK(HasStrides(this->hopper()));
}

std::unique_ptr<ReturnMap> StrideMap::Clone() const {
  return std::make_unique<StrideMap>(hopper(), phase_, feet_);
}

// The clock is turned on to the section, so that its phase there does not move with the period.
SimulationRequest StrideMap::RequestFrom(const SectionState& start) const {
  SimulationRequest request = RequestOf(hopper());
  RobotParameters<double>& robot = *request.parameters.robot;
  for (double& phase : robot.phase) phase += phase_;
  request.initial.assign(1, 0.0);
  request.initial.insert(request.initial.end(), start.begin(), start.end());
  request.feet = feet_;
  request.horizon = robot.period;
  request.max_hops = 0;
  return request;
}

Hop StrideMap::Read(std::span<const SensitivityDirection> parameters) const {
  Hop hop;
  ReadRun(run_, hop);
  for (const Event& event : run_.events)
    if (event.kind != EventKind::kApex) hop.events.push_back({event.kind, event.leg});
  // A heavy foot that slides has a speed that the section does not hold (M92).
  const bool holds_all =
      RobotOf(hopper()).leg_mass == 0.0 ||
      std::all_of(feet_.begin(), feet_.end(), [](const Foot& foot) { return foot.slides == 0; });
  hop.returned = run_.outcome == Outcome::kCompleted && run_.final_feet == feet_ && holds_all;
  if (!hop.ok()) return hop;
  const Eigen::Index n = static_cast<Eigen::Index>(run_.final_state.size()) - 1;
  const int legs = RobotOf(hopper()).legs;
  const std::size_t width = static_cast<std::size_t>(run_.directions);
  hop.period = run_.end_time;
  hop.advance = run_.final_state[0];

  // Row by row: the final state, and what a change does to it.
  Eigen::MatrixXd rates(n + 1, static_cast<Eigen::Index>(width));
  for (Eigen::Index i = 0; i <= n; ++i)
    for (std::size_t k = 0; k < width; ++k) {
      double& rate = rates(i, static_cast<Eigen::Index>(k));
      rate = run_.final_sensitivities[static_cast<std::size_t>(i) * width + k];
      // A longer period ends later.
      const std::size_t own = static_cast<std::size_t>(n);
      if (k >= own && parameters[k - own].of == SensitivityDirection::Of::kParameter &&
          parameters[k - own].parameter == ParameterId::kClockPeriod)
        rate += run_.final_rate[static_cast<std::size_t>(i)];
    }
  hop.next = Eigen::Map<const Eigen::VectorXd>(run_.final_state.data() + 1, n);
  Eigen::MatrixXd along = rates.bottomRows(n);
  const double slope = SlopeOf(hopper());
  hop.next[0] -= hop.advance * std::tan(slope);
  for (int leg = 0; leg < legs; ++leg) {
    hop.next[kBodyStates + leg] += kTurn;
    const Eigen::Index contact = kBodyStates + 2 * legs + leg;
    const bool holds = feet_[static_cast<std::size_t>(leg)].Holds();
    hop.next[contact] = holds ? hop.next[contact] - hop.advance / std::cos(slope) : 0.0;
    if (width == 0) continue;
    if (holds)
      along.row(contact) -= rates.row(0) / std::cos(slope);
    else
      along.row(contact).setZero();
  }
  if (width == 0) return hop;
  along.row(0) -= rates.row(0) * std::tan(slope);
  hop.jacobian = along.leftCols(n);
  hop.by_parameter = along.rightCols(static_cast<Eigen::Index>(parameters.size()));
  return hop;
}

Hop StrideMap::Differentiate(const SectionState& start,
                             std::span<const SensitivityDirection> parameters) {
  std::vector<SensitivityDirection> directions;
  for (int i = 0; i < start.size(); ++i)
    directions.push_back(SensitivityDirection::InitialState(i + 1));
  directions.insert(directions.end(), parameters.begin(), parameters.end());
  SimulationRequest request = RequestFrom(start);
  request.directions = directions;
  Simulate(request, run_);
  return Read(parameters);
}

Hop StrideMap::Apply(const SectionState& start) {
  Simulate(RequestFrom(start), run_);
  return Read({});
}

std::vector<SectionComponent> StrideMap::Components(const SectionState& at) const {
  const Parameters<double>& p = hopper().request.parameters;
  const double height = RobotOf(hopper()).straight_legs ? 0.5 * p.l0 : p.r;
  std::vector<SectionComponent> list = {{"y_m", height},
                                        {"vx_m_per_s", 1.0},
                                        {"vy_m_per_s", 1.0},
                                        {"pitch_rad", 0.1},
                                        {"pitch_rate_rad_per_s", 1.0}};
  const int legs = RobotOf(hopper()).legs;
  const auto of_legs = [&](const char* name, const char* unit, double size) {
    for (int leg = 1; leg <= legs; ++leg) list.push_back({name + std::to_string(leg) + unit, size});
  };
  of_legs("leg_angle_", "_rad", 0.1);
  of_legs("leg_angle_rate_", "_rad_per_s", 10.0);
  of_legs("contact_", "_m", height);
  const MotorStates motors = MotorStatesOf(hopper(), at.size());
  for (const int motor : motors.geared) {
    list.push_back({"gear_twist_" + std::to_string(motor) + "_rad", 0.01});
    list.push_back({"rotor_rate_" + std::to_string(motor) + "_rad_per_s", 10.0});
  }
  if (motors.lag) of_legs("motor_torque_", "_N_m", 1.0);
  return list;
}

double StrideMap::SpecificEnergy(const SectionState&) const {
  return std::numeric_limits<double>::quiet_NaN();
}

Eigen::RowVectorXd StrideMap::SpecificEnergyRate(const SectionState& state) const {
  return Eigen::RowVectorXd::Constant(state.size(), std::numeric_limits<double>::quiet_NaN());
}

namespace {

// The robot at the first section after `strides` whole strides of a run that ended there.
Trajectory GoOn(const Hopper& hopper, const Trajectory& run, double phase) {
  SimulationRequest request = RequestOf(hopper);
  request.max_hops = 0;
  request.parameters.time_origin += run.end_time;
  request.initial = run.final_state;
  request.feet = run.final_feet;
  request.horizon = phase * RobotOf(hopper).period;
  return Simulate(request);
}

// The section's state of a robot that stands so after whole turns of its clock.
SectionState OnSection(const Hopper& hopper, const Trajectory& there, int turns) {
  const int legs = RobotOf(hopper).legs;
  const Eigen::Index n = static_cast<Eigen::Index>(there.final_state.size()) - 1;
  SectionState state = Eigen::Map<const Eigen::VectorXd>(there.final_state.data() + 1, n);
  const double slope = SlopeOf(hopper), x = there.final_state[0];
  state[0] -= x * std::tan(slope);
  for (int leg = 0; leg < legs; ++leg) {
    state[kBodyStates + leg] += kTurn * turns;
    double& contact = state[kBodyStates + 2 * legs + leg];
    const bool holds = there.final_feet[static_cast<std::size_t>(leg)].Holds();
    contact = holds ? contact - x / std::cos(slope) : 0.0;
  }
  return state;
}

}  // namespace

StrideStart StartStrides(const Hopper& hopper, int strides) {
  HOPLAB_CHECK(HasStrides(hopper));
  const RobotParameters<double>& robot = RobotOf(hopper);
  SimulationRequest request = RequestOf(hopper);
  request.max_hops = 0;
  request.horizon = strides * robot.period;
  Trajectory run = Simulate(request);
  StrideStart start{.outcome = run.outcome, .strides = run.end_time / robot.period};
  int whole = strides;
  if (run.outcome != Outcome::kCompleted) {
    // A fall spoils the stride before it, too; the section lies in the one after `whole`.
    whole = static_cast<int>(start.strides) - 2;
    if (whole < kLeastStrides) return start;
    request.horizon = whole * robot.period;
    run = Simulate(request);
  }
  const double phase = MiddleOfLongestGap(BusyPhases(robot, run, run.end_time));
  const Trajectory there = GoOn(hopper, run, phase);
  if (there.outcome != Outcome::kCompleted) return start;
  start.map.emplace(hopper, phase, there.final_feet);
  start.state = OnSection(hopper, there, whole);
  return start;
}

SteadyStride FindSteadyStride(const Hopper& hopper) {
  SteadyStride steady;
  for (const int strides : {20, 60, 180}) {
    steady.start = StartStrides(hopper, strides);
    if (!steady.start.map) return steady;
    steady.point =
        FindFixedPoint(*steady.start.map, steady.start.state, {.tolerance = kStrideResidual});
    if (steady.point.found() || steady.start.outcome != Outcome::kCompleted) break;
  }
  return steady;
}

}  // namespace hoplab
