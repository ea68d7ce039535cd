#pragma once

#include <string>

#include "app/records/run_record.h"
#include "app/terminal/console.h"
#include "app/terminal/exit_code.h"

namespace hoplab {

/// Ends a command that was interrupted and keeps what it has: `done` ("12 of 40 rows") in `file`,
/// from where the same command goes on. The record is printed as failed where `json` is wanted.
ExitCode TellKeptWork(const std::string& done, const std::string& file, Json record, bool json,
                      Console& console);

}  // namespace hoplab
