#include "app/reports/run_folder.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "app/reports/report_page.h"
#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kParent = "runs";
constexpr const char* kReport = "report.html";

// A dataset's name as part of a file name: nothing that means something to a shell or a path.
std::string FileNameOf(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || (c == '.' && !out.empty());
    out += plain ? c : '-';
  }
  return out.empty() ? "unnamed" : out.substr(0, 100);
}

}  // namespace

RunFolder::RunFolder(RunFolderOptions options, const std::string& name, const std::string& command)
    : options_(std::move(options)), stem_(FileNameOf(name) + "-" + command) {
  if (options_.out) CheckFolderIsFree(*options_.out, {options_.force, kRunFile});
}

fs::path RunFolder::Partial() const {
  if (!options_.out) return fs::path(kParent) / (stem_ + ".partial");
  fs::path out = *options_.out;
  if (!out.has_filename()) out = out.parent_path();  // written with a slash at its end
  return out += ".partial";
}

fs::path RunFolder::NextFree() const {
  int last = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(kParent, error)) {
    const std::string found = entry.path().filename().string();
    if (!found.starts_with(stem_ + "-")) continue;
    int number = 0;
    const char* begin = found.data() + stem_.size() + 1;
    const auto [end, fault] = std::from_chars(begin, found.data() + found.size(), number);
    if (fault == std::errc() && end == found.data() + found.size()) last = std::max(last, number);
  }
  char number[16];
  std::snprintf(number, sizeof number, "%03d", last + 1);
  return fs::path(kParent) / (stem_ + "-" + number);
}

fs::path RunFolder::Write(const std::map<std::string, std::string>& files) const {
  const std::string report = ReportPage(Json::parse(files.at(kRunFile)), files);
  const auto fill = [&](const fs::path& folder) {
    WriteFileAtomically(folder / kReport, report);
    for (const auto& [name, content] : files) WriteFileAtomically(folder / name, content);
  };
  if (options_.out) {
    WriteFolderAtomically(*options_.out, fill, {options_.force, kRunFile});
    return *options_.out;
  }
  // Another process may take the number meanwhile: then the next one.
  constexpr int kAttempts = 20;
  for (int attempt = 1;; ++attempt) {
    const fs::path folder = NextFree();
    try {
      WriteFolderAtomically(folder, fill, {false, kRunFile});
      return folder;
    } catch (const std::exception&) {
      if (attempt == kAttempts || !fs::exists(folder)) throw;
    }
  }
}

fs::path WriteReport(const fs::path& folder, const StoredRun& run) {
  fs::path file = folder / kReport;
  WriteFileAtomically(file, ReportPage(run.record, run.files), {.force = true});
  return file;
}

}  // namespace hoplab
