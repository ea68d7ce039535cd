#pragma once

#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/run_process.h"

namespace hoplab::testing {

struct TerminalRequest {
  std::vector<std::string> command;  // the program first
  std::filesystem::path folder;      // where it runs
  std::string typed = {};            // sent once `typed_after` has been shown
  std::string typed_after = {};
  /// Shown when there is nothing more to wait for; empty: the program's end.
  std::string until = {};
  unsigned short columns = 80;
  std::chrono::seconds timeout{60};
};

struct TerminalResult {
  int exit_code = -1;  // 128 + signal if one ended it
  std::string shown;   // everything that came to the screen
};

/// Runs a program on a terminal of its own (a pseudo-terminal: both of its outputs, and its input).
inline TerminalResult RunOnTerminal(const TerminalRequest& request) {
  winsize size{.ws_row = 40, .ws_col = request.columns, .ws_xpixel = 0, .ws_ypixel = 0};
  int master = -1;
  const pid_t child = forkpty(&master, nullptr, nullptr, &size);
  if (child == 0) {
    Become(request.command, request.folder);
  }
  TerminalResult result;
  const auto end = std::chrono::steady_clock::now() + request.timeout;
  bool typed = request.typed.empty();
  while (std::chrono::steady_clock::now() < end) {
    if (!typed && result.shown.find(request.typed_after) != std::string::npos) {
      typed = write(master, request.typed.data(), request.typed.size()) > 0;
    }
    if (!request.until.empty() && result.shown.find(request.until) != std::string::npos) break;
    pollfd waiting{.fd = master, .events = POLLIN, .revents = 0};
    if (poll(&waiting, 1, 50) == 0) continue;
    char bytes[4096];
    const ssize_t count = read(master, bytes, sizeof bytes);
    if (count <= 0) break;  // the program has closed its terminal
    result.shown.append(bytes, static_cast<std::size_t>(count));
  }
  close(master);  // hangs up on what still runs
  int status = 0;
  if (waitpid(child, &status, request.until.empty() ? 0 : WNOHANG) == 0) {
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
  }
  result.exit_code = ExitCodeOf(status);
  return result;
}

}  // namespace hoplab::testing
