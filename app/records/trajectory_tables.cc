#include "app/records/trajectory_tables.h"

#include <algorithm>
#include <array>
#include <limits>

namespace hoplab {
namespace {

// Where the leg stands.
constexpr std::array kLegChannels = {Channel::kContactX, Channel::kContactY, Channel::kContactArc};

std::vector<Channel> AllChannels(int robot_legs) {
  std::vector<Channel> channels;
  for (const Channel c : RecordedChannels())
    if (c != Channel::kContactX && !IsRobotChannel(c)) channels.push_back(c);
  if (robot_legs > 0) channels.push_back(Channel::kBodyPitch);
  for (const Channel first : {Channel::kLegAngle1, Channel::kHipTorque1, Channel::kContact1})
    for (int leg = 0; leg < robot_legs; ++leg) channels.push_back(OfLeg(first, leg));
  return channels;
}

// Where the leg stands; of a robot, each of its legs.
std::vector<Channel> StandingChannels(int robot_legs) {
  std::vector<Channel> channels(kLegChannels.begin(), kLegChannels.end());
  for (const Channel first : {Channel::kLegContactX1, Channel::kLegContactY1, Channel::kLegArc1,
                              Channel::kLegForceX1, Channel::kLegForceY1})
    for (int leg = 0; leg < robot_legs; ++leg) channels.push_back(OfLeg(first, leg));
  return channels;
}

double GroundSlope(const SimulationRequest& request) {
  double slope = request.parameters.slope;
  for (const EffectSetting& setting : request.effects) {
    if (setting.effect->info.name == "ground_slope") slope += setting.values[0];
  }
  return slope;
}

Mode ModeAt(const Trajectory& run, double time) {
  const auto after = std::find_if(run.segments.begin(), run.segments.end(),
                                  [time](const Segment& segment) { return time < segment.end; });
  return after == run.segments.end() ? run.final_mode : after->mode;
}

// The times of a grid from 0 to the end of a run.
std::vector<double> Grid(double rate_hz, double end) {
  std::vector<double> times;
  for (long row = 0; static_cast<double>(row) / rate_hz <= end; ++row)
    times.push_back(static_cast<double>(row) / rate_hz);
  return times;
}

}  // namespace

int RobotLegsOf(const Parameters<double>& parameters) {
  return parameters.robot ? parameters.robot->legs : 0;
}

std::vector<std::string> TrajectoryHeader(const RunLabels& names, int robot_legs) {
  std::vector<std::string> header = names;
  header.emplace_back("time_s");
  for (const Channel channel : AllChannels(robot_legs)) header.emplace_back(NameOf(channel));
  for (const Channel channel : StandingChannels(robot_legs)) header.emplace_back(NameOf(channel));
  header.emplace_back("mode");
  return header;
}

void AddTrajectoryRows(SimulationRequest request, double rate_hz, const RunLabels& labels,
                       double time_offset_s, CsvText& csv) {
  // Where the run ends is not known beforehand, and a horizon may be far longer.
  request.row_times = {};
  request.directions = {};
  const std::vector<double> times = Grid(rate_hz, Simulate(request).end_time);
  const std::vector<Channel> channels = AllChannels(RobotLegsOf(request.parameters));
  request.row_times = times;
  request.channels = channels;
  const Trajectory seen = Simulate(request);
  // The leg stands where it stands, whatever the sensors say.
  std::vector<EffectSetting> physical(request.effects.begin(), request.effects.end());
  std::erase_if(physical,
                [](const auto& e) { return e.effect->info.kind == EffectKind::kObservation; });
  request.effects = physical;
  const std::vector<Channel> standing = StandingChannels(RobotLegsOf(request.parameters));
  request.channels = standing;
  const Trajectory truth = Simulate(request);
  for (std::size_t row = 0; row < times.size(); ++row) {
    for (const std::string& label : labels) csv.Cell(label);
    csv.Cell(times[row] + time_offset_s);
    for (std::size_t c = 0; c < channels.size(); ++c)
      csv.Cell(seen.samples[row * channels.size() + c]);
    const Mode mode = ModeAt(truth, times[row]);
    // In flight it stands nowhere, though a trace may tell where it would.
    for (std::size_t c = 0; c < standing.size(); ++c)
      csv.Cell(mode == Mode::kFlight ? std::numeric_limits<double>::quiet_NaN()
                                     : truth.samples[row * standing.size() + c]);
    csv.Cell(NameOf(mode)).EndRow();
  }
}

std::vector<std::string> EventHeader(const RunLabels& names, int robot_legs) {
  std::vector<std::string> header = names;
  for (const char* name :
       {"time_s", "event", "mode_before", "mode_after", "x_m", "y_m", "vx_m_per_s", "vy_m_per_s",
        "vx_after_m_per_s", "vy_after_m_per_s", "crossing_rate_per_s"})
    header.emplace_back(name);
  if (robot_legs > 0) header.emplace_back("leg");
  return header;
}

void AddEventRows(const Trajectory& trajectory, const RunLabels& labels, double time_offset_s,
                  CsvText& csv, int robot_legs) {
  for (const Event& e : trajectory.events) {
    for (const std::string& label : labels) csv.Cell(label);
    csv.Cell(e.time + time_offset_s)
        .Cell(NameOf(e.kind))
        .Cell(NameOf(e.mode_before))
        .Cell(NameOf(e.mode_after));
    for (const double v : {e.x, e.y, e.vx, e.vy, e.vx_after, e.vy_after, e.crossing_rate})
      csv.Cell(v);
    if (robot_legs > 0) csv.Cell(static_cast<double>(e.leg + 1));
    csv.EndRow();
  }
}

Json MechanismRecord(const SimulationRequest& request) {
  const MechanismKind mechanism = MechanismOf(request.law);
  Json parameters = Json::object();
  for (const ParameterId id : ParametersOf(mechanism))
    if (IsOfLegs(id, request.parameters))
      parameters[std::string(InfoOf(id).name)] = NumberOrNull(Field(request.parameters, id));
  if (mechanism == MechanismKind::kBall) {
    parameters["radius"] = NumberOrNull(request.parameters.radius);
    parameters["air_density"] = NumberOrNull(request.parameters.air_density);
  }
  if (request.parameters.m_toe > 0.0) {
    for (const ParameterId id : ToeParameters())
      parameters[std::string(InfoOf(id).name)] = NumberOrNull(Field(request.parameters, id));
  }
  Json effects = Json::array(), driven_by = Json::array();
  for (const EffectSetting& setting : request.effects) {
    const EffectInfo& info = setting.effect->info;
    Json values = Json::object();
    for (std::size_t i = 0; i < info.parameters.size(); ++i)
      values[std::string(info.parameters[i].name)] = NumberOrNull(setting.values[i]);
    effects.push_back({{"name", info.name}, {"parameters", values}});
  }
  for (const DrivenInput& input : request.inputs) driven_by.push_back(InfoOf(input.kind).name);
  const bool at_force = request.liftoff == LiftoffRule::kZeroForce;
  Json record = {{"type", NameOf(mechanism)},
                 {"ground_slope_rad", NumberOrNull(GroundSlope(request))},
                 {"parameters", parameters},
                 {"law", NameOf(request.law)},
                 {"variant", ThesisReadingRecord(request.parameters.reading)},
                 {"liftoff", at_force ? "zero_force" : "rest_length"},
                 {"torque_limit_N_m", NumberOrNull(request.parameters.torque_limit)},
                 {"on_guide", request.parameters.on_guide},
                 {"effects", effects},
                 {"driven_by", driven_by}};
  if (request.parameters.robot) {
    const RobotParameters<double>& robot = *request.parameters.robot;
    Json hips = Json::array();
    for (int leg = 0; leg < robot.legs; ++leg)
      hips.push_back({NumberOrNull(robot.hip_x[leg]), NumberOrNull(robot.hip_y[leg])});
    record["hips_m"] = hips;
  }
  return record;
}

}  // namespace hoplab
