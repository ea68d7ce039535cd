#include "app/version.h"

#include <ostream>

#include "app/records/run_record.h"
#include "app/terminal/command.h"

namespace hoplab {
namespace {

struct VersionSettings {
  bool json = false;
};

ExitCode RunVersion(const VersionSettings& settings, Console& console) {
  if (settings.json) {
    RecordHeader header;
    header.command = "version";
    Json record = NewRecord(header);
    record["revision"] = SourceRevision().empty() ? Json(nullptr) : Json(SourceRevision());
    record["compiler"] = CompilerVersion();
    for (const auto& [name, version] : LibraryVersions()) record["tools"][name] = version;
    console.out << TextOf(record);
    return ExitCode::kDone;
  }
  console.out << "hoplab " << ProjectVersion();
  if (!SourceRevision().empty()) console.out << " (" << SourceRevision() << ')';
  console.out << "\ncompiled by " << CompilerVersion() << "\nwith";
  const char* separator = " ";
  for (const auto& [name, version] : LibraryVersions()) {
    console.out << separator << name << ' ' << version;
    separator = ", ";
  }
  console.out << '\n';
  return ExitCode::kDone;
}

void AddVersion(CLI::App& sub, Invocation& invocation) {
  OnParsed(sub, invocation, std::make_shared<VersionSettings>(), RunVersion);
}

}  // namespace

namespace commands {
extern constexpr Command version = {.place = 220,
                                    .name = "version",
                                    .what = "Versions of hoplab and of what it stands on",
                                    .footer = "Example:\n  hoplab version --json",
                                    .add = AddVersion};
}  // namespace commands
}  // namespace hoplab
