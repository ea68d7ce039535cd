#include "app/commands/all_commands.h"
#include "app/records/run_record.h"
#include "app/terminal/command_line.h"

int main(int argc, char** argv) {
  hoplab::Console console = hoplab::ProcessConsole();
  const hoplab::Program program{hoplab::AllCommands(), hoplab::FailureText};
  return static_cast<int>(hoplab::RunCommandLine(program, argc, argv, console));
}
