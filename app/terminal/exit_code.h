#pragma once

#include <string>

namespace hoplab {

/// What the process tells its caller, as in sysexits.
enum class ExitCode {
  kDone = 0,       // whatever the verdict
  kNoResult = 1,   // the run ended without a usable result
  kWrongUse = 64,  // the command line itself
  kBadInput = 65,  // what it names
  kBug = 70,
  kInterrupted = 130
};

/// Of a run that could be interrupted; `failure`: why it has no result, empty if it has one.
inline ExitCode ExitCodeOf(bool interrupted, const std::string& failure) {
  if (interrupted) return ExitCode::kInterrupted;
  return failure.empty() ? ExitCode::kDone : ExitCode::kNoResult;
}

}  // namespace hoplab
