#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab man`.
void AddManCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
