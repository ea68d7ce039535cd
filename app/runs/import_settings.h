#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "datasets/import/import.h"

namespace hoplab {

/// What the command line of `hoplab import` says.
struct ImportSettings {
  std::vector<std::string> logs, map, cut, role, shift, set, unit;
  std::string out, name, format;
  std::string type;  // empty: as the columns are
  std::optional<int> legs;
  std::optional<double> rate_hz;
  bool accept_guesses = false, zero_time = false, mend_times = false, force = false, json = false;
};

void AddImportOptions(CLI::App& sub, ImportSettings& settings);

/// Throws UsageError for an option that is not of its form, InputError for a file, channel or unit
/// that is none.
ImportRequest ImportRequestOf(const ImportSettings& settings);

}  // namespace hoplab
