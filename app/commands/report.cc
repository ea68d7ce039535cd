#include "app/commands/report.h"

#include <ostream>

#include "app/report_page.h"
#include "app/run_folder.h"

namespace hoplab {
namespace {

struct ReportSettings {
  std::string folder;
  bool json = false;
};

ExitCode RunReport(const ReportSettings& settings, Console& console) {
  const StoredRun run = ReadRunFolder(settings.folder);
  const std::filesystem::path written = WriteReport(settings.folder, run);
  if (settings.json)
    console.out << TextOf(run.record);
  else
    console.out << written.string() << '\n';
  return ExitCode::kDone;
}

}  // namespace

void AddReportCommand(CLI::App& app, Invocation& invocation) {
  auto settings = std::make_shared<ReportSettings>();
  CLI::App& sub =
      *app.add_subcommand("report", "Write report.html of a run folder anew, from what is in it");
  sub.add_option("RUN_DIR", settings->folder, "A folder with run.json and the tables beside it")
      ->required();
  sub.footer(
      "Every command that writes a run folder writes report.html into it: one file that\n"
      "opens without a network. This one writes it again, as after an update of hoplab.\n"
      "Example:\n"
      "  hoplab report runs/rig-drops-fit-001");
  OnParsed(sub, invocation, settings, RunReport);
}

}  // namespace hoplab
