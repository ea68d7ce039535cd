#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/temp_folder.h"

namespace hoplab::testing {

struct ProcessRequest {
  std::vector<std::string> command;  // the program first
  std::filesystem::path folder;      // where it runs
  /// Sent once `signal_after` has appeared on standard error; 0: none.
  int signal = 0;
  std::string signal_after = {};
  std::chrono::seconds timeout{120};
};

struct ProcessResult {
  int exit_code = -1;  // 128 + signal if one ended it
  bool timed_out = false;
  std::string out, err;
};

/// In a child process: becomes the program, in `folder` unless that is empty.
[[noreturn]] inline void Become(const std::vector<std::string>& command,
                                const std::filesystem::path& folder) {
  if (!folder.empty() && chdir(folder.c_str()) != 0) _exit(126);
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  execv(argv[0], argv.data());
  _exit(127);
}
/// Of a status that waitpid gave: 128 + signal if one ended the program.
inline int ExitCodeOf(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Runs a program to its end, or kills it at the timeout. Standard input is empty, output goes
/// through files, so that no pipe fills up.
inline ProcessResult RunProcess(const ProcessRequest& request) {
  const TempFolder output;
  const std::filesystem::path out = output.path() / "out", err = output.path() / "err";
  const pid_t child = fork();
  if (child == 0) {
    const auto redirect = [](const char* file, int flags, int to) {
      const int from = open(file, flags, 0600);
      if (from < 0 || dup2(from, to) < 0) _exit(126);
    };
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    Become(request.command, request.folder);
  }
  ProcessResult result;
  const auto end = std::chrono::steady_clock::now() + request.timeout;
  bool signalled = request.signal == 0;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (!signalled && ReadText(err).find(request.signal_after) != std::string::npos) {
      kill(child, request.signal);
      signalled = true;
    }
    if (std::chrono::steady_clock::now() > end && !result.timed_out) {
      kill(child, SIGKILL);
      result.timed_out = true;
    }
    // Waiting for another process, not for a time: the pause only spares the processor.
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  result.exit_code = ExitCodeOf(status);
  result.out = ReadText(out);
  result.err = ReadText(err);
  return result;
}

}  // namespace hoplab::testing
