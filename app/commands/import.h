#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab import`.
void AddImportCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
