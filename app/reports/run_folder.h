#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "app/records/stored_run.h"
#include "app/runs/run_settings.h"

namespace hoplab {

/// A folder with run.json, the tables behind its plots and report.html; it appears whole or not at
/// all.
class RunFolder {
 public:
  /// Throws InputError if the place is taken: called before the work is done.
  RunFolder(RunFolderOptions options, const std::string& name, const std::string& command);

  /// Writes files by name, run.json among them, and the report they make; returns where they are.
  /// Throws InputError if that is not possible.
  std::filesystem::path Write(const std::map<std::string, std::string>& files) const;

  /// Where a command that can be interrupted and resumed keeps what it has so far: beside the
  /// folder, `<out>.partial`, or `runs/<name>-<command>.partial`.
  std::filesystem::path Partial() const;

 private:
  std::filesystem::path NextFree() const;

  RunFolderOptions options_;
  std::string stem_;  // "rig-drops-fit"
};

/// Writes report.html of a stored run into its folder, over the one that is there; returns where.
std::filesystem::path WriteReport(const std::filesystem::path& folder, const StoredRun& run);

}  // namespace hoplab
