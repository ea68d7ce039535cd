#include "app/command_line.h"

int main(int argc, char** argv) {
  hoplab::Console console = hoplab::ProcessConsole();
  return static_cast<int>(hoplab::RunCommandLine(argc, argv, console));
}
