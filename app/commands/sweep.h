#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab sweep`.
void AddSweepCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
