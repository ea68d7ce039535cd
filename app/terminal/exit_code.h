#pragma once

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

}  // namespace hoplab
