#include "app/run_folder.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "app/report_page.h"
#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/text.h"
#include "datasets/text_file.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kParent = "runs";
constexpr const char* kMarker = "run.json";
constexpr const char* kReport = "report.html";
constexpr std::uint64_t kMaxFileBytes = 2ULL << 30;

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
  if (options_.out) CheckFolderIsFree(*options_.out, {options_.force, kMarker});
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
  const std::string report = ReportPage(Json::parse(files.at(kMarker)), files);
  const auto fill = [&](const fs::path& folder) {
    WriteFileAtomically(folder / kReport, report);
    for (const auto& [name, content] : files) WriteFileAtomically(folder / name, content);
  };
  if (options_.out) {
    WriteFolderAtomically(*options_.out, fill, {options_.force, kMarker});
    return *options_.out;
  }
  // Another process may take the number meanwhile: then the next one.
  constexpr int kAttempts = 20;
  for (int attempt = 1;; ++attempt) {
    const fs::path folder = NextFree();
    try {
      WriteFolderAtomically(folder, fill, {false, kMarker});
      return folder;
    } catch (const std::exception&) {
      if (attempt == kAttempts || !fs::exists(folder)) throw;
    }
  }
}

StoredRun ReadRunFolder(const fs::path& folder) {
  const fs::path marker = folder / kMarker;
  std::error_code error;
  if (!fs::is_regular_file(marker, error)) {
    throw InputError({Printable(folder.string(), 200), "", "is no run folder: it has no run.json",
                      "Give a folder that fit, diagnose or another command wrote."});
  }
  StoredRun run;
  run.record = Json::parse(ReadFileBytes(marker, kMaxFileBytes), nullptr, false);
  if (run.record.is_discarded() || !run.record.is_object()) {
    throw InputError({Printable(marker.string(), 200), "", "is no JSON object; it was damaged",
                      "Write the run anew."});
  }
  const auto schema = run.record.find("schema");
  if (schema == run.record.end() || *schema != kRunSchema || !run.record.contains("command")) {
    const std::string found = schema == run.record.end() ? "absent" : schema->dump();
    throw InputError({Printable(marker.string(), 200) + ": schema", Printable(found),
                      std::string("must be ") + kRunSchema, "Another program wrote this file."});
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv" && entry.is_regular_file())
      run.files[entry.path().filename().string()] = ReadFileBytes(entry.path(), kMaxFileBytes);
  }
  return run;
}

fs::path WriteReport(const fs::path& folder, const StoredRun& run) {
  fs::path file = folder / kReport;
  WriteFileAtomically(file, ReportPage(run.record, run.files), {.force = true});
  return file;
}

}  // namespace hoplab
