#include "app/runs/sweep_work.h"

#include <mutex>
#include <ostream>

#include "app/terminal/exit_code.h"
#include "base/check.h"
#include "base/input_error.h"
#include "base/parallel.h"

namespace hoplab {
namespace {

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

}  // namespace

std::string DoneText(const SweepJournal& journal, const SweepPlan& plan) {
  return std::to_string(journal.done()) + " of " + std::to_string(plan.size()) + " rows";
}

void ComputeRows(const SweepPlan& plan, SweepJournal& journal, const SweepPlace& place,
                 Progress& progress, Console& console) {
  progress.Stage("sweeping" + (journal.done() > 0 ? ", " + DoneText(journal, plan) + " stand in " +
                                                        journal.file().string()
                                                  : std::string()),
                 journal.done());
  if (place.job)
    ComputeOnRanks(plan, journal, *place.job, place.stop, progress, console);
  else
    ComputeOnThreads(plan, journal, place.jobs, place.stop, progress);
}

void FollowSweep(const SweepPlan& plan, MpiJob& job) {
  job.Work([&](int row) { return LineOfRow(row, plan.Compute(row)); });
}

}  // namespace hoplab
