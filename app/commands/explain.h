#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab explain`.
void AddExplainCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
