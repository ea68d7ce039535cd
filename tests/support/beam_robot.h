#pragma once

#include <filesystem>

#include "model/parameters.h"
#include "tests/support/beam_extras.h"

namespace hoplab::testing {

/// Runs of a robot as a dataset in `folder`, two in three to train: nine drops on held legs, or six
/// runs by the clock that `p` has. Rows of 2 ms up to shortly before a fall, at most 0.8 s of a
/// drop and 1 s by a clock. `p` is the robot that runs; what the dataset says of it is `told`.
/// Angles, heights, speeds, periods, sweeps and noise by `seed`. The torques motors are told are
/// columns; the dataset compares them where `compares_torque` says so.
void RecordRobot(const Parameters<double>& p, const Parameters<double>& told, int seed,
                 bool compares_torque, const std::filesystem::path& folder,
                 const BeamExtras& extras = {});

}  // namespace hoplab::testing
