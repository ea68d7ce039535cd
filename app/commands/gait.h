#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab gait`.
void AddGaitCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
