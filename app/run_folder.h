#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace hoplab {

/// Where the outcome of a command goes.
struct RunFolderOptions {
  std::optional<std::filesystem::path> out;  // absent: runs/<name>-<command>-NNN, the next free one
  bool force = false;                        // replace a run that stands there
};

/// A folder with run.json and the tables behind its plots; it appears whole or not at all.
class RunFolder {
 public:
  /// Throws InputError if the place is taken: called before the work is done.
  RunFolder(RunFolderOptions options, const std::string& name, const std::string& command);

  /// Writes files by name; returns where they are. Throws InputError if that is not possible.
  std::filesystem::path Write(const std::map<std::string, std::string>& files) const;

  /// Where a command that can be interrupted and resumed keeps what it has so far: beside the
  /// folder, `<out>.partial`, or `runs/<name>-<command>.partial`.
  std::filesystem::path Partial() const;

 private:
  std::filesystem::path NextFree() const;

  RunFolderOptions options_;
  std::string stem_;  // "rig-drops-fit"
};

}  // namespace hoplab
