#pragma once

#include <string>
#include <vector>

#include "tests/support/run_process.h"

namespace hoplab::testing {

/// Runs commands one after the other in `folder`; what the first that fails said, else "".
inline std::string RunSteps(const std::vector<std::vector<std::string>>& commands,
                            const std::filesystem::path& folder) {
  for (const std::vector<std::string>& command : commands) {
    const ProcessResult r =
        RunProcess({.command = command, .folder = folder, .timeout = std::chrono::seconds(300)});
    if (r.exit_code != 0)
      return command.front() + " ended with " + std::to_string(r.exit_code) + "\n" + r.out + r.err;
  }
  return "";
}

}  // namespace hoplab::testing
