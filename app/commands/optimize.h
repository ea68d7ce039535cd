#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab optimize`.
void AddOptimizeCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
