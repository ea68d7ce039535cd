#include <ostream>

#include "app/records/comparison_record.h"
#include "app/reports/comparison_report.h"
#include "app/reports/report_page.h"
#include "app/reports/run_folder.h"
#include "app/runs/report_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/stopwatch.h"
#include "app/terminal/usage_error.h"

namespace hoplab {
namespace {

ExitCode WriteAnew(const ReportSettings& settings, Console& console) {
  const std::string& folder = settings.folders.front();
  if (!settings.out.empty() || settings.force)
    throw UsageError("--out and --force are for two or more runs, laid side by side");
  const StoredRun run = ReadRunFolder(folder);
  const std::filesystem::path written = WriteReport(folder, run);
  if (settings.json)
    console.out << TextOf(run.record);
  else
    console.out << written.string() << '\n';
  return ExitCode::kDone;
}

ExitCode Compare(const ReportSettings& settings, Console& console) {
  const Stopwatch watch;
  std::vector<ComparedRun> runs;
  for (const std::string& folder : settings.folders)
    runs.push_back({folder, ReadRunFolder(folder)});
  Json record = ComparisonRecord(runs);
  record["seconds"] = watch.Seconds();
  const std::string name = record["runs"][0]["name"].get<std::string>();
  const RunFolder folder(RunFolderOptionsOf(settings), name, "comparison");
  const std::filesystem::path written =
      folder.Write({{"run.json", TextOf(record)}, {"values.csv", ComparisonTable(record)}});
  if (settings.json) {
    console.out << TextOf(record);
    return ExitCode::kDone;
  }
  console.out << ComparisonReport(record, console.out_colours)
              << Styled("  run folder   ", Emphasis::kFaint, console.out_colours)
              << written.string() << '\n';
  return ExitCode::kDone;
}

ExitCode RunReport(const ReportSettings& settings, Console& console) {
  return settings.folders.size() == 1 ? WriteAnew(settings, console) : Compare(settings, console);
}

void AddReport(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<ReportSettings>();
  AddReportOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunReport);
}

}  // namespace

namespace commands {
extern constexpr Command report = {
    .place = 150,
    .name = "report",
    .what = "Write report.html of a run anew, or lay several runs side by side",
    .footer =
        "Every command that writes a run folder writes report.html into it: one file\n"
        "that opens without a network. With one run this one writes it again, as after\n"
        "an update of hoplab. With several it tells what changed: values with the\n"
        "intervals of their differences, errors, causes, settings.\n"
        "Examples:\n"
        "  hoplab report runs/rig-drops-fit-001\n"
        "  hoplab report runs/old-bearing-fit-001 runs/new-bearing-fit-001",
    .add = AddReport};
}  // namespace commands
}  // namespace hoplab
