#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab check`.
void AddCheckCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
