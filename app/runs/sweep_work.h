#pragma once

#include <atomic>
#include <string>

#include "app/runs/mpi_job.h"
#include "app/terminal/progress.h"
#include "experiments/sweep_journal.h"

namespace hoplab {

/// "12 of 40 rows".
std::string DoneText(const SweepJournal& journal, const SweepPlan& plan);

/// Computes the rows that the journal lacks and writes them down as they come; `stop` ends it
/// early.
void ComputeOnThreads(const SweepPlan& plan, SweepJournal& journal, int jobs,
                      const std::atomic<bool>* stop, Progress& progress);
/// The same on the ranks of a job, of which this is rank 0. Ends them all, with what is missing on
/// `console`, when it is stopped or a rank is lost.
void ComputeOnRanks(const SweepPlan& plan, SweepJournal& journal, MpiJob& job,
                    const std::atomic<bool>* stop, Progress& progress, Console& console);

}  // namespace hoplab
