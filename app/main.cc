#include "app/commands/all_commands.h"
#include "app/records/run_record.h"
#include "app/terminal/command_line.h"
#include "base/processor.h"

int main(int argc, char** argv) {
  hoplab::Console console = hoplab::ProcessConsole();
  if (const char* missing = hoplab::MissingOfProcessor()) {
    console.err << "hoplab: this program was built for processors with " << missing
                << ", and this one has none. Delete "
                   "build/release and build it here, or with -DHOPLAB_FOR_THIS_PROCESSOR=OFF.\n";
    return static_cast<int>(hoplab::ExitCode::kNoResult);
  }
  const hoplab::Program program{hoplab::AllCommands(), hoplab::FailureText};
  return static_cast<int>(hoplab::RunCommandLine(program, argc, argv, console));
}
