#include <ostream>

#include "app/records/sweep_record.h"
#include "app/reports/kept_work.h"
#include "app/reports/run_folder.h"
#include "app/reports/sweep_report.h"
#include "app/runs/on_ranks.h"
#include "app/runs/sweep_work.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/stopwatch.h"
#include "app/version.h"

namespace hoplab {
namespace {

ExitCode Lead(const SweepSettings& settings, Console& console, MpiJob* job) {
  const Stopwatch watch;
  const InterruptGuard interrupt;  // before there is anything to keep
  const SweepPlan plan = SweepPlanOf(settings);
  const RunFolder folder(RunFolderOptionsOf(settings), plan.name(), "sweep");
  SweepJournal journal(folder.Partial(), plan, ProjectVersion(), settings.force);

  Progress progress(console, settings.quiet);
  ComputeRows(plan, journal, {JobsOf(settings.jobs), job, interrupt.flag()}, progress, console);
  progress.Clear();

  Json record = NewSweepRecord(settings, plan);
  record["seconds"] = watch.Seconds();
  AddSweep(plan, journal.rows(), record);
  if (!journal.Missing().empty())
    return TellKeptWork(DoneText(journal, plan), journal.file().string(), std::move(record),
                        settings.json, console);
  const std::string written =
      folder.Write({{"run.json", TextOf(record)}, {"rows.csv", SweepTable(plan, journal.rows())}})
          .string();
  journal.Remove();
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << SweepReport(plan, journal.rows(), console.out_colours) << "\n  run folder  "
                << written << '\n';
  }
  return ExitCode::kDone;
}

ExitCode RunSweepCommand(const SweepSettings& settings, Console& console) {
  return OnRanks([&](MpiJob* job) { return Lead(settings, console, job); },
                 [&](MpiJob& job) { FollowSweep(SweepPlanOf(settings), job); });
}

void AddSweep(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<SweepSettings>();
  AddSweepOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunSweepCommand);
}

}  // namespace

namespace commands {
extern constexpr Command sweep = {
    .place = 100,
    .name = "sweep",
    .what = "Run a scenario over grids, lists or hypercubes",
    .footer =
        "An interrupted sweep goes on where it was: start the same command again.\n"
        "Examples:\n"
        "  hoplab sweep experiments/modulus.yaml\n"
        "  hoplab sweep experiments/modulus.yaml --jobs 2 --out runs/modulus\n"
        "  mpirun -n 4 hoplab sweep experiments/modulus.yaml",
    .add = AddSweep};
}  // namespace commands
}  // namespace hoplab
