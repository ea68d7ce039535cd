#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace hoplab {

struct OverwriteOptions {
  bool force = false;  // replace what stands there
  /// A folder is replaced only if it holds a file of this name, so that `--force` with a wrong path
  /// does not delete a home. Empty: no such check.
  std::string marker;
};

/// Writes `content` to `file` whole or not at all: beside it first, then renamed over it; folders
/// above it are made. Throws InputError, leaving nothing behind, if `file` exists and `force` is
/// not set, or if it cannot be written.
void WriteFileAtomically(const std::filesystem::path& file, std::string_view content,
                         const OverwriteOptions& options = {});

/// Throws the InputError with which WriteFileAtomically would refuse what stands at `file`.
void CheckFileIsFree(const std::filesystem::path& file, const OverwriteOptions& options = {});

/// Throws the InputError with which WriteFolderAtomically would refuse `folder`, so that a long job
/// can find out before it does its work.
void CheckFolderIsFree(const std::filesystem::path& folder, const OverwriteOptions& options = {});

/// Lets `fill` write into an empty folder beside `folder`, then renames that to `folder`. An
/// existing empty folder counts as absent. Throws InputError if `folder` exists and `force` is not
/// set or the marker is missing, or if it cannot be written; whatever `fill` throws goes on to the
/// caller. In each of these cases nothing is left behind and what stood there still stands.
void WriteFolderAtomically(const std::filesystem::path& folder,
                           const std::function<void(const std::filesystem::path&)>& fill,
                           const OverwriteOptions& options = {});

}  // namespace hoplab
