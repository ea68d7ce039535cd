#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab reproduce`.
void AddReproduceCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
