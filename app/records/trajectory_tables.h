#pragma once

#include <string>
#include <vector>

#include "app/records/csv.h"
#include "app/records/run_record.h"
#include "model/simulate.h"

namespace hoplab {

/// What stands before the columns of a simulated run where a table holds several: the names of
/// these columns, or one run's values in them, as "trial" or "train-1.csv".
using RunLabels = std::vector<std::string>;

/// Columns of a simulated run: labels, time_s, every channel, then how the leg stands: contact_x_m,
/// contact_y_m, contact_arc_rad, mode. A robot with that many legs has pitch, motor angles, torques
/// and contacts before these, and of each leg contact point, arc and force after them.
std::vector<std::string> TrajectoryHeader(const RunLabels& names, int robot_legs = 0);
/// Legs of a robot; 0 of any other mechanism.
int RobotLegsOf(const Parameters<double>& parameters);

/// Simulates `request` on a grid of `rate_hz` up to its end and adds the rows. Times are shifted by
/// `time_offset_s`. The channels are what the sensors see; contact point and arc are the leg's own,
/// empty in flight and for a ball, the arc (hip to contact) also for a straight leg.
void AddTrajectoryRows(SimulationRequest request, double rate_hz, const RunLabels& labels,
                       double time_offset_s, CsvText& csv);

/// Columns of a list of events, and its rows; of a robot with the leg each is of, 1 the hindmost.
std::vector<std::string> EventHeader(const RunLabels& names, int robot_legs = 0);
void AddEventRows(const Trajectory& trajectory, const RunLabels& labels, double time_offset_s,
                  CsvText& csv, int robot_legs = 0);

/// What hops, for whoever draws it or takes it along: {type, ground_slope_rad, parameters: {name:
/// SI value}, law, variant, liftoff, torque_limit_N_m (null: none), on_guide, effects: [{name,
/// parameters}], driven_by: kinds of inputs}.
Json MechanismRecord(const SimulationRequest& request);

}  // namespace hoplab
