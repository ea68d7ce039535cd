#pragma once

#include "app/console.h"
#include "app/exit_code.h"

namespace hoplab {

/// Runs the command that `argv` names. Throws nothing: every failure becomes a message and an exit
/// code here.
ExitCode RunCommandLine(int argc, const char* const* argv, Console& console);

}  // namespace hoplab
