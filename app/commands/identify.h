#pragma once

#include "app/command.h"

namespace hoplab {

/// `hoplab identify`: constants and reading of the published study's law, from its tables.
void AddIdentifyCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
