#pragma once

#include <filesystem>
#include <string>

#include "datasets/dataset.h"
#include "datasets/scenario.h"
#include "datasets/yaml_cursor.h"

namespace hoplab {

// What a log of a real machine brings along, read and held together: angles hop by hop, columns
// that drive the simulation, clocks of sensors, initial states in stance.

/// `touchdown_angle_deg` and `touchdown_angle_sigma_deg` of a trial: an angle, a list of them, or
/// {from: leg_angle}. Inputs and mechanism of `trial` are read already. Throws InputError where it
/// is missing, out of range or said twice.
void ReadTouchdownAngles(const YamlCursor& item, Trial& trial);

/// Throws InputError, at `item`, where what drives a trial contradicts itself or its mechanism: a
/// hip torque from the log and from a controller, a ball with a leg angle, ...
void CheckDriven(const YamlCursor& item, const Trial& trial);

/// What only the trace tells: that its inputs' columns are there and hold what they should, the
/// angles read from leg_angle_rad, and that there is an angle for each touch-down. `trace_place` is
/// the CSV file in messages. Throws InputError.
void CompleteWithTrace(Trial& trial, const std::string& trace_place);

/// The block `inputs` of a scenario: {hip_torque_N_m: {file: log.csv, delay_s: 0.004}}, the files
/// in `folder`.
std::vector<ScenarioInput> ReadScenarioInputs(const YamlCursor& cursor,
                                              const std::filesystem::path& folder);
/// Whether they say at which angle the leg touches down.
bool DrivesAngle(const std::vector<ScenarioInput>& inputs);
/// As CheckDriven of a trial.
void CheckDriven(const YamlCursor& root, const Scenario& scenario);

/// Throws InputError where a clock is named that does not exist, or a column both drives the
/// simulation and is compared with it.
void CheckRoles(const Dataset& dataset);

}  // namespace hoplab
