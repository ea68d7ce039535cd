#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab simulate`.
void AddSimulateCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
