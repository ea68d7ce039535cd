#include "app/trajectory_tables.h"

#include <cmath>

namespace hoplab {
namespace {

std::vector<Channel> AllChannels() {
  std::vector<Channel> channels;
  for (int c = 0; c < kChannelCount; ++c) channels.push_back(static_cast<Channel>(c));
  return channels;
}

}  // namespace

std::vector<std::string> TrajectoryHeader(bool with_trial) {
  std::vector<std::string> header;
  if (with_trial) header.emplace_back("trial");
  header.emplace_back("time_s");
  for (const Channel channel : AllChannels()) header.emplace_back(NameOf(channel));
  return header;
}

void AddTrajectoryRows(SimulationRequest request, double rate_hz, const std::string& trial,
                       double time_offset_s, CsvText& csv) {
  // Where the run ends is not known beforehand, and a horizon may be far longer.
  request.row_times = {};
  request.directions = {};
  const double end = Simulate(request).end_time;
  std::vector<double> times;
  for (long row = 0; static_cast<double>(row) / rate_hz <= end; ++row)
    times.push_back(static_cast<double>(row) / rate_hz);
  const std::vector<Channel> channels = AllChannels();
  request.row_times = times;
  request.channels = channels;
  const Trajectory run = Simulate(request);
  for (std::size_t row = 0; row < times.size(); ++row) {
    if (!trial.empty()) csv.Cell(trial);
    csv.Cell(times[row] + time_offset_s);
    for (std::size_t c = 0; c < channels.size(); ++c)
      csv.Cell(run.samples[row * channels.size() + c]);
    csv.EndRow();
  }
}

std::vector<std::string> EventHeader(bool with_trial) {
  std::vector<std::string> header;
  if (with_trial) header.emplace_back("trial");
  for (const char* name :
       {"time_s", "event", "mode_before", "mode_after", "x_m", "y_m", "vx_m_per_s", "vy_m_per_s",
        "vx_after_m_per_s", "vy_after_m_per_s", "crossing_rate_per_s"})
    header.emplace_back(name);
  return header;
}

void AddEventRows(const Trajectory& trajectory, const std::string& trial, double time_offset_s,
                  CsvText& csv) {
  for (const Event& e : trajectory.events) {
    if (!trial.empty()) csv.Cell(trial);
    csv.Cell(e.time + time_offset_s)
        .Cell(NameOf(e.kind))
        .Cell(NameOf(e.mode_before))
        .Cell(NameOf(e.mode_after));
    for (const double v : {e.x, e.y, e.vx, e.vy, e.vx_after, e.vy_after, e.crossing_rate})
      csv.Cell(v);
    csv.EndRow();
  }
}

}  // namespace hoplab
