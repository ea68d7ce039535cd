#include <chrono>
#include <mutex>
#include <ostream>

#include "app/records/solver_record.h"
#include "app/records/sweep_record.h"
#include "app/reports/run_folder.h"
#include "app/reports/sweep_report.h"
#include "app/runs/mpi_job.h"
#include "app/runs/problem_settings.h"
#include "app/runs/run_settings.h"
#include "app/runs/scenario_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "app/version.h"
#include "base/check.h"
#include "base/input_error.h"
#include "base/parallel.h"
#include "experiments/sweep_journal.h"

namespace hoplab {
namespace {

struct SweepSettings : RunSettings {
  ScenarioSettings scenario;
  std::uint64_t seed = 1;
  int jobs = 0;
  SolverSettings solver;
};

SweepPlan PlanOf(const SweepSettings& settings) {
  return {ScenarioDocumentOf(settings.scenario), IntegratorOptionsOf(settings.solver),
          settings.seed};
}

Json NewSweepRecord(const SweepSettings& settings, const SweepPlan& plan) {
  RecordHeader header;
  header.command = "sweep";
  header.law = std::string(NameOf(plan.law()));
  header.variant = plan.variant();
  header.seed = settings.seed;
  header.options = {{"scenario", settings.scenario.scenario},
                    {"set", settings.scenario.set},
                    {"with", settings.scenario.with}};
  RecordSolver(settings.solver, header.options);
  Json record = NewRecord(header);
  record["scenario"] = plan.name();
  record["settings_hash"] = plan.fingerprint();
  return record;
}

std::string DoneText(const SweepJournal& journal, const SweepPlan& plan) {
  return std::to_string(journal.done()) + " of " + std::to_string(plan.size()) + " rows";
}

void ComputeOnThreads(const SweepPlan& plan, SweepJournal& journal, int jobs,
                      const std::atomic<bool>* stop, Progress& progress) {
  const std::vector<int> missing = journal.Missing();
  std::mutex mutex;
  ParallelFor(static_cast<int>(missing.size()), jobs, [&](int i) {
    if (*stop) return;
    const SweepRow row = plan.Compute(missing[i]);
    const std::lock_guard lock(mutex);
    journal.Add(missing[i], row);
    progress.Step("sweeping: " + DoneText(journal, plan), journal.done(), plan.size());
  });
}

// Which rows are missing because a rank had them when the job was ended.
std::string LostText(const MpiJob::Served& served) {
  std::string text;
  for (const auto& [rank, rows] : served.lost) {
    if (rows.empty()) continue;
    text += (text.empty() ? "" : "; ") + std::string("rank ") + std::to_string(rank) +
            " had rows " + RangesText({rows.begin(), rows.end()});
  }
  return text;
}

void ComputeOnRanks(const SweepPlan& plan, SweepJournal& journal, MpiJob& job,
                    const std::atomic<bool>* stop, Progress& progress, Console& console) {
  const auto compute = [&](int row) { return LineOfRow(row, plan.Compute(row)); };
  const auto accept = [&](int index, const std::string& line) {
    const auto row = RowOfLine(line, plan);
    HOPLAB_CHECK(row && row->first == index);
    journal.Add(index, row->second);
    progress.Step(
        "sweeping on " + std::to_string(job.size()) + " ranks: " + DoneText(journal, plan),
        journal.done(), plan.size());
  };
  try {
    const MpiJob::Served served = job.Serve(journal.Missing(), compute, accept, stop);
    if (!served.stopped) return;
    progress.Clear();
    std::string gap = "stopped, as when a rank is lost; " + DoneText(journal, plan) +
                      " are kept in " + journal.file().string() + ", missing are " +
                      RangesText(journal.Missing());
    if (const std::string lost = LostText(served); !lost.empty()) gap += "; of these " + lost;
    // The launcher may forward nothing any more: the journal says it, too.
    journal.Note(gap);
    console.err << "hoplab sweep: " << gap << "; the same command computes them" << std::endl;
    job.Abort(static_cast<int>(ExitCode::kInterrupted));
  } catch (const InputError& error) {
    progress.Clear();
    console.err << "hoplab sweep: " << error.what() << std::endl;
    job.Abort(static_cast<int>(ExitCode::kBadInput));
  }
}

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
  const SweepPlan plan = PlanOf(settings);
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
    const SweepPlan plan = PlanOf(settings);
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
  AddScenarioOptions(sub, settings->scenario);
  AddSeedOption(sub, settings->seed, "Of a Latin hypercube");
  AddJobsOption(sub, settings->jobs, "; one a rank under mpirun");
  AddSolverOptions(sub, settings->solver);
  AddRunFolderOptions(
      sub, *settings, "Run folder (default runs/<scenario>-sweep-NNN)",
      "Replace the run that stands in the run folder, begin an interrupted one anew");
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
