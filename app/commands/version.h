#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab version`.
void AddVersionCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
