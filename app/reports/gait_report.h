#pragma once

#include <string>

#include "app/runs/gait_run.h"

namespace hoplab {

/// What the command prints.
std::string GaitReport(const std::string& name, const GaitRun& run, bool colours);

}  // namespace hoplab
