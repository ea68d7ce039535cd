#pragma once

#include <string>
#include <vector>

#include "app/csv.h"
#include "model/simulate.h"

namespace hoplab {

/// Columns of a simulated run: `trial` first if there are several, then time_s and every channel.
std::vector<std::string> TrajectoryHeader(bool with_trial);

/// Simulates `request` on a grid of `rate_hz` up to its end and adds the rows, all channels. Times
/// are shifted by `time_offset_s`. `trial` empty: no such column.
void AddTrajectoryRows(SimulationRequest request, double rate_hz, const std::string& trial,
                       double time_offset_s, CsvText& csv);

/// Columns of a list of events, and its rows.
std::vector<std::string> EventHeader(bool with_trial);
void AddEventRows(const Trajectory& trajectory, const std::string& trial, double time_offset_s,
                  CsvText& csv);

}  // namespace hoplab
