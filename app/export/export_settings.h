#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/export/exported_model.h"
#include "app/export/mjcf.h"

namespace hoplab {

/// What the command line of `hoplab export` says.
struct ExportSettings {
  std::string folder, c_file, mjcf_file;
  MjcfOptions mjcf;
  bool force = false, json = false;
};

void AddExportOptions(CLI::App& sub, ExportSettings& settings);

/// What was written, and of which model: the record that `hoplab export --json` prints.
Json ExportRecord(const ExportSettings& settings, const StoredRun& run, const ExportedModel& model);

}  // namespace hoplab
