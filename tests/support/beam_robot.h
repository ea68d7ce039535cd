#pragma once

#include <filesystem>

#include "model/parameters.h"

namespace hoplab::testing {

/// Nine drops of a robot on held legs, six of them to train, as a dataset in `folder`: rows of 2 ms
/// up to shortly before a fall, at most 0.8 s. `p` is the robot that drops; what the dataset says
/// of it is `told`. Angles, heights, speeds and noise by `seed`.
void RecordRobotDrops(const Parameters<double>& p, const Parameters<double>& told, int seed,
                      const std::filesystem::path& folder);

}  // namespace hoplab::testing
