#include <chrono>
#include <ostream>

#include "app/records/sweep_record.h"
#include "app/reports/run_folder.h"
#include "app/reports/sweep_report.h"
#include "app/runs/sweep_work.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/version.h"
#include "base/input_error.h"

namespace hoplab {
namespace {

ExitCode TellInterrupted(const SweepSettings& settings, const SweepPlan& plan,
                         const SweepJournal& journal, Json record, Console& console) {
  const std::string message = "interrupted; " + DoneText(journal, plan) + " are kept in " +
                              journal.file().string() + ", the same command computes the others";
  SetFailed(record, message);
  AddSweep(plan, journal.rows(), record);
  if (settings.json) console.out << TextOf(record);
  console.err << "hoplab sweep: " << message << '\n';
  return ExitCode::kInterrupted;
}

ExitCode Lead(const SweepSettings& settings, Console& console, MpiJob* job) {
  const auto begin = std::chrono::steady_clock::now();
  const InterruptGuard interrupt;  // before there is anything to keep
  const SweepPlan plan = SweepPlanOf(settings);
  const RunFolder folder(RunFolderOptionsOf(settings), plan.name(), "sweep");
  SweepJournal journal(folder.Partial(), plan, ProjectVersion(), settings.force);

  Progress progress(console, settings.quiet);
  progress.Stage("sweeping" + (journal.done() > 0 ? ", " + DoneText(journal, plan) + " stand in " +
                                                        journal.file().string()
                                                  : std::string()),
                 journal.done());
  if (job)
    ComputeOnRanks(plan, journal, *job, interrupt.flag(), progress, console);
  else
    ComputeOnThreads(plan, journal, JobsOf(settings.jobs), interrupt.flag(), progress);
  progress.Clear();

  Json record = NewSweepRecord(settings, plan);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  record["seconds"] = took.count();
  if (!journal.Missing().empty())
    return TellInterrupted(settings, plan, journal, std::move(record), console);
  AddSweep(plan, journal.rows(), record);
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

// A rank other than 0: says nothing, rank 0 reads the same scenario and tells what is wrong with
// it. It fails for nobody else: a launcher ends all ranks with the first that does, before rank 0
// may have spoken.
ExitCode Follow(const SweepSettings& settings, MpiJob& job) {
  try {
    const SweepPlan plan = SweepPlanOf(settings);
    job.Work([&](int row) { return LineOfRow(row, plan.Compute(row)); });
    return ExitCode::kDone;
  } catch (const InputError&) {
    return ExitCode::kDone;
  }
}

ExitCode RunSweepCommand(const SweepSettings& settings, Console& console) {
  if (!MpiJob::Launched()) return Lead(settings, console, nullptr);
  MpiJob job;
  return job.rank() == 0 ? Lead(settings, console, &job) : Follow(settings, job);
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
