#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab laws`.
void AddLawsCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
