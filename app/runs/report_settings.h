#pragma once

#include <string>
#include <vector>

#include "app/runs/run_settings.h"

namespace hoplab {

/// What the command line of `hoplab report` says.
struct ReportSettings : RunSettings {
  std::vector<std::string> folders;
};

void AddReportOptions(CLI::App& sub, ReportSettings& settings);

}  // namespace hoplab
