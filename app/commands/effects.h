#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab effects`.
void AddEffectsCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
