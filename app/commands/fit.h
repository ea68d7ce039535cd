#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab fit`.
void AddFitCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
