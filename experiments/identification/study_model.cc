#include "experiments/identification/study_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/units.h"
#include "experiments/leg_stiffness.h"

namespace hoplab {
namespace {

using C = StudyConstant;

// What the study does print.
constexpr double kModulus = 22e9;  // Pa
constexpr double kHeight = 0.3;    // m, of the start
constexpr double kControlledAngle = DegToRad(40.0);
constexpr double kDesiredSpeed = 1.8;  // m/s
constexpr double kRunTime = 15.0;      // s
constexpr double kGravity = 9.81;      // m/s^2
// What nothing hangs on.
constexpr double kWidth = 0.03;        // m
constexpr double kShearModulus = 4e9;  // Pa

// A start at 0.2 m has to be above touch-down at 40 deg: r < 0.1132 m.
constexpr std::array<StudyConstantInfo, kStudyConstantCount> kInfo = {{
    {"body_mass", "kg", "body mass", 0.08, 5.0},
    {"rest_radius", "m", "radius of the unloaded leg", 0.06, 0.113},
    {"bending_stiffness", "N m^2", "E I at 22 GPa", 0.3, 30.0},
    {"kp", "N s", "gain of the speed controller", 0.02, 20.0},
    {"start_speed", "m/s", "start speed of table 6.5", 0.7, 1.4},
    {"damping_scale", "", "damping over the printed one", 0.1, 3.0},
    {"rolling_blend", "", "share of the arc laid down in the rolling (M27); no reading of the text",
     0.001, 1.0},
    {"toe_mass", "kg", "mass at the toe (M40-M46); 0: the massless leg", 1e-3, 0.1},
}};

// The effect by which a hopper rolls between M7 and M8; none where the share is 0.
std::vector<EffectSetting> EffectsOf(const StudyHopper& hopper) {
  const double blend = At(hopper.constants, C::kRollingBlend);
  if (blend == 0.0) return {};
  EffectSetting setting = EffectSetting::Null(*FindEffect("rolling_law"));
  setting.values[0] = blend;
  return {setting};
}

SimulationRequest RequestOf(const StudyHopper& hopper, double modulus, double damping) {
  const StudySection section = SectionOf(At(hopper.constants, C::kBendingStiffness));
  SimulationRequest request;
  request.law = Law::kThesis;
  request.liftoff = hopper.reading.liftoff;
  request.integrator = hopper.integrator;
  Parameters<double>& p = request.parameters;
  p.variant = hopper.reading.variant;
  p.m = At(hopper.constants, C::kMass);
  p.g = kGravity;
  p.r = At(hopper.constants, C::kRadius);
  p.E = modulus;
  p.G = kShearModulus;
  p.I = section.second_moment_m4;
  p.A = section.area_m2;
  p.d = At(hopper.constants, C::kDampingScale) * damping;
  p.m_toe = At(hopper.constants, C::kToeMass);
  const StudyPlacement placement = PlacementOf(p.m_toe, p.r);
  p.kp_place = placement.kp_N_m_per_rad;
  p.kd_place = placement.kd_N_m_s_per_rad;
  return request;
}

// Rows over each stance after `begin`, ends included, as times after `begin`.
std::vector<double> StanceRows(const Trajectory& run, double begin) {
  constexpr int kRows = 40;
  constexpr double kInside = 1e-7;  // s: rows belong to the stance, not to what follows
  std::vector<double> rows;
  for (const Segment& s : run.segments) {
    if (s.mode == Mode::kFlight || s.begin < begin || s.end - s.begin < 4.0 * kInside) continue;
    const double first = s.begin - begin + kInside, last = s.end - begin - kInside;
    for (int i = 0; i <= kRows; ++i) rows.push_back(first + (last - first) * i / kRows);
  }
  return rows;
}

// The last five hops again, with rows; a leg with a toe mass from the start, since its toe moves at
// an apex.
void FindStiffness(SimulationRequest request, const Trajectory& run, ControlledRun& out) {
  constexpr std::size_t kHops = 5;
  std::vector<const Event*> apexes;
  for (const Event& e : run.events) {
    if (e.kind == EventKind::kApex) apexes.push_back(&e);
  }
  if (apexes.size() < kHops + 1) return;
  const Event& from = *apexes[apexes.size() - 1 - kHops];
  std::vector<double> rows = StanceRows(run, from.time);
  if (request.parameters.m_toe > 0.0) {
    for (double& t : rows) t += from.time;
  } else {
    request.initial = {from.x, from.y, from.vx, 0.0};
    request.max_hops = kHops;
  }
  constexpr std::array kChannels = {Channel::kLegAngle, Channel::kLegLength, Channel::kContact};
  request.row_times = rows;
  request.channels = kChannels;
  const Trajectory last = Simulate(request);
  if (!IsComplete(last.outcome)) return;
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double* row = &last.samples[i * kChannels.size()];
    if (!(row[2] > 0.5)) continue;
    const double k = StanceStiffness(request, row[0], row[1]);
    low = std::min(low, k);
    high = std::max(high, k);
  }
  if (high == 0.0) return;
  out.k_min_N_per_m = low;
  out.k_max_N_per_m = high;
}

}  // namespace

const StudyConstantInfo& InfoOf(StudyConstant constant) {
  return kInfo[static_cast<std::size_t>(constant)];
}

StudySection SectionOf(double bending_stiffness_N_m2) {
  const double second_moment = bending_stiffness_N_m2 / kModulus;
  const double thickness = std::cbrt(12.0 * second_moment / kWidth);
  return {kWidth, thickness, second_moment, kWidth * thickness};
}

StudyPlacement PlacementOf(double toe_mass_kg, double rest_radius_m) {
  constexpr double kRate = 60.0;    // rad/s
  constexpr double kDamping = 0.7;  // of critical
  const double inertia = toe_mass_kg * 4.0 * rest_radius_m * rest_radius_m;
  return {kRate * kRate * inertia, 2.0 * kDamping * kRate * inertia};
}

std::optional<double> EnergyPercent(const StudyHopper& hopper, const EnergyCell& cell,
                                    StudySlopes* slopes) {
  using D = SensitivityDirection;
  std::vector<D> directions = {D::Parameter(ParameterId::kM),
                               D::Parameter(ParameterId::kR),
                               D::Parameter(ParameterId::kSecondMoment),
                               D::Parameter(ParameterId::kArea),
                               D::Parameter(ParameterId::kD),
                               D::InitialState(2)};
  SimulationRequest request = RequestOf(hopper, kModulus, cell.damping_N_s_per_m);
  const double speed = At(hopper.constants, C::kStartSpeed);
  request.parameters.theta_td = cell.touchdown_angle_rad;
  request.initial = {0.0, kHeight, speed, 0.0};
  request.horizon = 5.0;
  request.max_hops = 1;
  const std::vector<EffectSetting> effects = EffectsOf(hopper);
  request.effects = effects;
  const bool has_toe = request.parameters.m_toe > 0.0;
  if (!effects.empty()) directions.push_back(D::EffectParameter(0, 0));
  if (has_toe) {
    for (ParameterId id : {ParameterId::kToeMass, ParameterId::kKpPlace, ParameterId::kKdPlace})
      directions.push_back(D::Parameter(id));
  }
  if (slopes) request.directions = directions;
  const Trajectory run = Simulate(request);
  if (!IsComplete(run.outcome) || run.hops < 1) return std::nullopt;
  const std::vector<double>& z = run.final_state;
  const double before = kGravity * kHeight + 0.5 * speed * speed;  // per kg
  const double after = kGravity * z[1] + 0.5 * (z[2] * z[2] + z[3] * z[3]);
  const double percent = 100.0 * after / before;
  if (!slopes) return percent;
  // Along the apex, for a body that its leg's vibration shakes in flight.
  std::vector<double> by(directions.size());
  for (std::size_t i = 0; i < by.size(); ++i) {
    const double apex_time = run.event_time_sensitivities[(run.events.size() - 1) * by.size() + i];
    const auto slope = [&](std::size_t component) {
      return run.final_sensitivities[component * by.size() + i] +
             run.final_rate[component] * apex_time;
    };
    by[i] = 100.0 / before * (kGravity * slope(1) + z[2] * slope(2) + z[3] * slope(3));
  }
  const Parameters<double>& p = request.parameters;
  slopes->fill(0.0);
  (*slopes)[static_cast<std::size_t>(C::kMass)] = p.m * by[0];
  (*slopes)[static_cast<std::size_t>(C::kRadius)] = p.r * by[1];
  (*slopes)[static_cast<std::size_t>(C::kBendingStiffness)] = p.I * by[2] + p.A / 3.0 * by[3];
  (*slopes)[static_cast<std::size_t>(C::kDampingScale)] = p.d * by[4];
  (*slopes)[static_cast<std::size_t>(C::kStartSpeed)] = speed * (by[5] - percent * speed / before);
  if (!effects.empty())
    (*slopes)[static_cast<std::size_t>(C::kRollingBlend)] = effects[0].values[0] * by[6];
  if (has_toe) {
    // The placement is in proportion to m_toe r^2.
    const std::size_t toe = by.size() - 3;
    const double placement = p.kp_place * by[toe + 1] + p.kd_place * by[toe + 2];
    (*slopes)[static_cast<std::size_t>(C::kToeMass)] = p.m_toe * by[toe] + placement;
    (*slopes)[static_cast<std::size_t>(C::kRadius)] += 2.0 * placement;
  }
  return percent;
}

ControlledRun RunControlled(const StudyHopper& hopper, const ControlledSettings& settings) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  SimulationRequest request = RequestOf(hopper, settings.modulus_Pa, settings.damping_N_s_per_m);
  request.parameters.theta_td = kControlledAngle;
  request.parameters.kp = At(hopper.constants, C::kGain);
  request.parameters.v_des = kDesiredSpeed;
  request.initial = {0.0, settings.height_m, settings.speed_m_per_s, 0.0};
  request.horizon = kRunTime;
  const std::vector<EffectSetting> effects = EffectsOf(hopper);
  request.effects = effects;
  const Trajectory run = Simulate(request);
  ControlledRun out{run.outcome, run.end_time, {}, kNaN, kNaN};
  if (!IsComplete(run.outcome)) return out;
  out.convergence = ConvergenceTimeOf(ApexSpeeds(run));
  if (settings.with_stiffness) FindStiffness(request, run, out);
  return out;
}

}  // namespace hoplab
