#include "experiments/study/hopping_run.h"

#include <array>
#include <cmath>

#include "base/input_error.h"
#include "experiments/leg_stiffness.h"

namespace hoplab {
namespace {

constexpr std::array kChannels = {Channel::kBodyX,  Channel::kBodyY,    Channel::kBodyVx,
                                  Channel::kBodyVy, Channel::kLegAngle, Channel::kLegLength,
                                  Channel::kContact};

// The body's settings alone, without what belongs to the reading of one law.
MechanismSpec BodyOf(const MechanismSpec& full, MechanismKind type) {
  MechanismSpec body;
  body.type = type;
  body.body_mass_kg = full.body_mass_kg;
  body.gravity_m_per_s2 = full.gravity_m_per_s2;
  body.liftoff = full.liftoff;
  body.toe_mass_kg = full.toe_mass_kg;
  body.placement = full.placement;
  return body;
}

// The leg begins at the angle of a caption and is placed at its share of that.
void PutDown(const Study& study, double angle_rad, Scenario& scenario) {
  scenario.touchdown_angle_rad = study.PlacedShare() * angle_rad;
  scenario.start_angle_rad = study.places_first_landing ? scenario.touchdown_angle_rad : angle_rad;
}

Scenario StraightScenario(const Study& study, const CaptionSettings& settings) {
  Scenario scenario = study.constants;
  scenario.law = NameOf(Law::kStraightLeg);
  scenario.mechanism = BodyOf(study.constants.mechanism, MechanismKind::kStraightLeg);
  scenario.mechanism.straight_leg = {settings.straight->rest_length_m,
                                     settings.straight->stiffness_N_per_m,
                                     settings.damping_N_s_per_m};
  scenario.mechanism.reading.torque_sign = study.constants.mechanism.reading.torque_sign;
  PutDown(study,
          settings.straight->touchdown_angle_rad.value_or(0.5 * settings.touchdown_angle_rad),
          scenario);
  scenario.effects.clear();
  return scenario;
}

Scenario CLegScenario(const Study& study, const CaptionSettings& settings) {
  Scenario scenario = study.constants;
  scenario.mechanism.c_leg.E_Pa = settings.modulus_Pa;
  scenario.mechanism.c_leg.damping_N_s_per_m = settings.damping_N_s_per_m;
  PutDown(study, settings.touchdown_angle_rad, scenario);
  return scenario;
}

}  // namespace

double Study::PlacedShare() const {
  return constants.start_angle_rad ? constants.touchdown_angle_rad / *constants.start_angle_rad
                                   : 1.0;
}

Study StudyOfScenario(const Scenario& scenario, const IntegratorOptions& integrator) {
  const std::string& place = scenario.origin.place;
  if (scenario.mechanism.type != MechanismKind::kCLeg)
    throw InputError({place, "mechanism.type", "must be c_leg: the study's hopper has such a leg",
                      "The straight leg beside it is made from its runs."});
  if (!scenario.controller)
    throw InputError({place, "", "must have the key controller",
                      "Add controller: {kp_N_s: 3, v_des_m_per_s: 1.8}; runs without torque leave "
                      "it out by themselves."});
  RequireInitial(scenario);
  if (scenario.start_angle_rad == 0.0)
    throw InputError({place, "start_angle_deg = 0",
                      "says no share that later landings are placed at: that is "
                      "touchdown_angle_deg over it",
                      "Give the angle of a caption, as 40, or leave it out."});
  Study study{scenario, integrator};
  // Laws and effects that do not exist are told now; a law that is not named is the default one.
  study.constants.law = NameOf(HopperOfScenario(scenario, integrator).request.law);
  return study;
}

Study WithLaw(const Study& study, Law law) {
  Study other = study;
  other.constants.law = NameOf(law);
  other.constants.mechanism = BodyOf(study.constants.mechanism, MechanismKind::kCLeg);
  other.constants.mechanism.fall_height_m = study.constants.mechanism.fall_height_m;
  other.constants.mechanism.c_leg = study.constants.mechanism.c_leg;
  return other;
}

Hopper HopperOfCaption(const Study& study, const CaptionSettings& settings) {
  Scenario scenario =
      settings.straight ? StraightScenario(study, settings) : CLegScenario(study, settings);
  scenario.initial = StateSpec{0.0, settings.start_height_m, settings.start_speed_m_per_s, 0.0};
  if (settings.controlled && scenario.controller)
    scenario.controller->v_des_m_per_s = settings.v_des_m_per_s;
  else
    scenario.controller.reset();
  scenario.stop = {settings.time_limit_s, settings.hops};
  return HopperOfScenario(scenario, study.integrator);
}

bool HoppingRun::fell() const {
  switch (outcome) {
    case Outcome::kFellHeight:
    case Outcome::kFellAngle:
    case Outcome::kFellArc:
    case Outcome::kFellPitch:
    case Outcome::kFellNoReturn:
    case Outcome::kNoSupport:
      return true;
    default:
      return false;
  }
}

HoppingRun RunHopping(const Hopper& hopper, double sample_step_s) {
  SimulationRequest request = RequestOf(hopper);
  std::vector<double> rows;
  for (int i = 0; sample_step_s > 0.0 && i * sample_step_s <= request.horizon; ++i)
    rows.push_back(i * sample_step_s);
  request.row_times = rows;
  request.channels = kChannels;
  const Trajectory run = Simulate(request);

  const double m = request.parameters.m, g = request.parameters.g;
  const auto energy = [&](double y, double vx, double vy) {
    return m * (0.5 * (vx * vx + vy * vy) + g * y);
  };
  HoppingRun result;
  result.outcome = run.outcome;
  result.end_time_s = run.end_time;
  result.hops = run.hops;
  if (run.final_state.size() >= 4) result.final_speed_m_per_s = run.final_state[2];
  result.speeds = SpeedHistoryOf(run, request.initial[0], {}, {});
  const auto& s = request.initial;
  result.apexes.push_back({0.0, s[0], s[1], s[2], energy(s[1], s[2], s[3])});
  for (const Event& e : run.events) {
    if (e.kind == EventKind::kApex && e.time > 0.0)
      result.apexes.push_back({e.time, e.x, e.y, e.vx, energy(e.y, e.vx, e.vy)});
  }
  for (std::size_t i = 0; i < rows.size() && rows[i] <= run.end_time; ++i) {
    const double* row = run.samples.data() + i * kChannels.size();
    if (!std::isfinite(row[0])) break;
    const bool in_contact = row[6] == 1.0;
    result.samples.push_back({rows[i], row[0], row[1], row[2], energy(row[1], row[2], row[3]),
                              row[4], row[5],
                              in_contact ? StanceStiffness(request, row[4], row[5])
                                         : std::numeric_limits<double>::quiet_NaN(),
                              in_contact});
  }
  return result;
}

ConvergenceTime ConvergenceOf(const HoppingRun& run) {
  return IsComplete(run.outcome) ? ConvergenceTimeOf(run.speeds, ConvergenceReading())
                                 : ConvergenceTime{};
}

StiffnessRange SteadyStiffness(const HoppingRun& run) {
  constexpr std::size_t kSteadyHops = 5;
  StiffnessRange range{std::numeric_limits<double>::quiet_NaN(),
                       std::numeric_limits<double>::quiet_NaN()};
  if (run.apexes.size() < kSteadyHops + 1) return range;
  const double from = run.apexes[run.apexes.size() - kSteadyHops - 1].time_s;
  const double to = run.apexes.back().time_s;
  for (const HoppingSample& sample : run.samples) {
    if (sample.time_s < from || sample.time_s > to) continue;
    range.min_N_per_m = std::fmin(range.min_N_per_m, sample.stiffness_N_per_m);
    range.max_N_per_m = std::fmax(range.max_N_per_m, sample.stiffness_N_per_m);
  }
  return range;
}

std::vector<StanceRange> StancesOf(const HoppingRun& run) {
  std::vector<StanceRange> stances;
  for (std::size_t i = 0; i < run.samples.size();) {
    std::size_t end = i;
    while (end < run.samples.size() && run.samples[end].in_contact) ++end;
    if (end > i) stances.push_back({i, end});
    i = end + 1;
  }
  return stances;
}

StraightSpringLeg MeanLeg(const HoppingRun& run) {
  double stiffness = 0.0, length = 0.0, count = 0.0;
  for (const HoppingSample& sample : run.samples) {
    if (!sample.in_contact) continue;
    stiffness += sample.stiffness_N_per_m;
    length += sample.leg_length_m;
    count += 1.0;
  }
  return {stiffness / count, length / count};  // 0/0 without a stance
}

}  // namespace hoplab
