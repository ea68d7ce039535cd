#pragma once

#include <string>
#include <vector>

#include "app/terminal/command.h"
#include "app/terminal/console.h"
#include "app/terminal/exit_code.h"

namespace hoplab {

/// What the command line is made of.
struct Program {
  std::vector<const Command*> commands;  // in the order of help
  /// What --json prints of a command that failed.
  std::string (*failure_text)(const std::string& command, const std::string& message);
};

/// Runs the command that `argv` names. Throws nothing: every failure becomes a message and an exit
/// code here.
ExitCode RunCommandLine(const Program& program, int argc, const char* const* argv,
                        Console& console);

}  // namespace hoplab
