#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab generate`.
void AddGenerateCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
