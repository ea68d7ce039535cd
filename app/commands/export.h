#pragma once

#include "app/command.h"

namespace hoplab {

/// `hoplab export`.
void AddExportCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
