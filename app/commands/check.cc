#include <ostream>

#include "app/records/check_record.h"
#include "app/reports/check_report.h"
#include "app/reports/run_folder.h"
#include "app/terminal/command.h"
#include "app/terminal/stopwatch.h"
#include "datasets/read_dataset.h"

namespace hoplab {
namespace {

ExitCode RunCheckCommand(const CheckSettings& settings, Console& console) {
  const Stopwatch watch;
  const ProblemOptions options = ProblemOptionsOf(settings.problem);
  const Dataset dataset = ReadDataset(settings.problem.dataset);
  const RunFolder folder(RunFolderOptionsOf(settings), dataset.name, "check");
  const CheckRun run = RunCheck(dataset, options, JobsOf(settings.problem.jobs));

  Json record = CheckRecord(dataset, settings, run);
  record["seconds"] = watch.Seconds();
  if (!settings.out.empty()) folder.Write({{"run.json", TextOf(record)}});
  if (settings.json) {
    console.out << TextOf(record);
    return ExitCode::kDone;
  }
  console.out << CheckRunReport(dataset, run, console.out_colours);
  if (!settings.out.empty()) console.out << "  run folder  " << settings.out << '\n';
  return ExitCode::kDone;
}

void AddCheck(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<CheckSettings>();
  AddProblemOptions(sub, settings->problem);
  AddRunFolderOptions(sub, *settings, "Write a run folder here (default: nothing is written)");
  OnParsed(sub, invocation, settings, RunCheckCommand);
}

}  // namespace

namespace commands {
extern constexpr Command check = {
    .place = 20,
    .name = "check",
    .what = "Data quality, identifiability and gradients of a dataset, before any fit",
    .footer =
        "Examples:\n"
        "  hoplab check datasets/rig-drops\n"
        "  hoplab check my-hops --free E,d,m --law consistent --json",
    .add = AddCheck};
}  // namespace commands
}  // namespace hoplab
