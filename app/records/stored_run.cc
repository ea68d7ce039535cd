#include "app/records/stored_run.h"

#include "base/input_error.h"
#include "base/text.h"
#include "datasets/text_file.h"

namespace hoplab {
namespace {
namespace fs = std::filesystem;
constexpr std::uint64_t kMaxFileBytes = 2ULL << 30;
}  // namespace

StoredRun ReadRunFolder(const fs::path& folder) {
  const fs::path marker = folder / kRunFile;
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

}  // namespace hoplab
