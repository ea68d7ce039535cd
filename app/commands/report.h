#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab report`.
void AddReportCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
