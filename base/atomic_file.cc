#include "base/atomic_file.h"

#include <unistd.h>

#include <atomic>
#include <fstream>
#include <system_error>

#include "base/input_error.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void FailToWrite(const fs::path& path, const std::string& reason) {
  throw InputError({path.string(), "", "cannot be written (" + reason + ")",
                    "Choose another place or free this one."});
}

// A name in the same folder, hence on the same file system, that no other call or process uses.
fs::path NameBeside(const fs::path& path, const char* purpose) {
  static std::atomic<unsigned> counter{0};
  fs::path name = ".";
  name += path.filename();
  name +=
      std::string(".") + purpose + "-" + std::to_string(getpid()) + "-" + std::to_string(counter++);
  return path.parent_path() / name;
}

// `folder/` and `folder` are the same place; the first has no filename.
fs::path WithoutTrailingSlash(const fs::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

void MakeFoldersAbove(const fs::path& path) {
  std::error_code error;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (error) FailToWrite(path, error.message());
}

// Removes what it was given unless told to keep it.
class RemoveOnExit {
 public:
  explicit RemoveOnExit(fs::path path) : path_(std::move(path)) {}
  RemoveOnExit(const RemoveOnExit&) = delete;
  RemoveOnExit& operator=(const RemoveOnExit&) = delete;
  ~RemoveOnExit() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  void Keep() { path_.clear(); }

 private:
  fs::path path_;
};

void RefuseToOverwrite(const fs::path& path) {
  throw InputError({path.string(), "", "exists already and is not overwritten",
                    "Choose another name or use --force."});
}

struct FolderPlace {
  fs::path folder;  // without a slash at the end
  bool replace;     // something stands there that may go
};

// Where a folder is to appear; throws if it may not.
FolderPlace PlaceOfFolder(const fs::path& folder_or_slash, const OverwriteOptions& options) {
  const fs::path folder = WithoutTrailingSlash(folder_or_slash);
  if (folder.empty() || folder == "." || folder == ".." || folder.filename() == "." ||
      folder.filename() == "..")
    FailToWrite(folder_or_slash, "a folder is made whole, this one is in use");

  std::error_code error;
  const bool exists = fs::exists(fs::symlink_status(folder, error));
  const bool empty_folder = fs::is_directory(folder, error) && fs::is_empty(folder, error);
  const bool replace = exists && !empty_folder;
  if (replace && !options.force) RefuseToOverwrite(folder);
  if (replace && !options.marker.empty() && !fs::exists(folder / options.marker, error))
    throw InputError({folder.string(), "",
                      "is not replaced: it holds no " + options.marker +
                          ", so it was not written by this command",
                      "Choose another name."});
  return {folder, replace};
}

}  // namespace

void CheckFileIsFree(const fs::path& file, const OverwriteOptions& options) {
  std::error_code error;
  if (fs::is_directory(file, error)) FailToWrite(file, "it is a folder");
  if (!options.force && fs::exists(file, error)) RefuseToOverwrite(file);
}

void WriteFileAtomically(const fs::path& file, std::string_view content,
                         const OverwriteOptions& options) {
  std::error_code error;
  CheckFileIsFree(file, options);
  MakeFoldersAbove(file);
  const fs::path staged = NameBeside(file, "partial");
  RemoveOnExit cleanup(staged);
  std::ofstream out(staged, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) FailToWrite(file, "no such folder, no permission or no space");
  fs::rename(staged, file, error);
  if (error) FailToWrite(file, error.message());
  cleanup.Keep();
}

void CheckFolderIsFree(const fs::path& folder, const OverwriteOptions& options) {
  PlaceOfFolder(folder, options);
}

void WriteFolderAtomically(const fs::path& folder_or_slash,
                           const std::function<void(const fs::path&)>& fill,
                           const OverwriteOptions& options) {
  const auto [folder, replace] = PlaceOfFolder(folder_or_slash, options);
  std::error_code error;
  MakeFoldersAbove(folder);
  const fs::path staged = NameBeside(folder, "partial");
  RemoveOnExit cleanup(staged);
  fs::create_directory(staged, error);
  if (error) FailToWrite(folder, error.message());
  fill(staged);

  // Two renames, because no portable call swaps two folders; the old one is put back if the second
  // fails.
  const fs::path old = NameBeside(folder, "old");
  if (replace) {
    fs::rename(folder, old, error);
    if (error) FailToWrite(folder, error.message());
  }
  fs::rename(staged, folder, error);
  if (error) {
    std::error_code ignored;
    if (replace) fs::rename(old, folder, ignored);
    FailToWrite(folder, error.message());
  }
  cleanup.Keep();
  if (replace) fs::remove_all(old, error);
}

}  // namespace hoplab
