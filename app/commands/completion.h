#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab completion`.
void AddCompletionCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
