#include "app/commands/version.h"

#include <ostream>

#include "app/run_record.h"
#include "app/version.h"

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

}  // namespace

void AddVersionCommand(CLI::App& app, Invocation& invocation) {
  CLI::App& sub = *app.add_subcommand("version", "Versions of hoplab and of what it stands on");
  sub.footer("Example:\n  hoplab version --json");
  OnParsed(sub, invocation, std::make_shared<VersionSettings>(), RunVersion);
}

}  // namespace hoplab
