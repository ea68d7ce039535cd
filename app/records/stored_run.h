#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "app/records/run_record.h"

namespace hoplab {

/// The file that makes a folder a run.
inline constexpr const char* kRunFile = "run.json";

/// What a run folder holds.
struct StoredRun {
  Json record;                               // run.json
  std::map<std::string, std::string> files;  // its CSVs by name
};

/// Throws InputError for a folder that no command of hoplab wrote, or that was damaged.
StoredRun ReadRunFolder(const std::filesystem::path& folder);

}  // namespace hoplab
