#pragma once

#include <atomic>
#include <string>

#include "app/runs/mpi_job.h"
#include "app/terminal/progress.h"
#include "experiments/sweep_journal.h"

namespace hoplab {

/// "12 of 40 rows".
std::string DoneText(const SweepJournal& journal, const SweepPlan& plan);

/// Where the rows are computed.
struct SweepPlace {
  int jobs = 1;                             // threads
  MpiJob* job = nullptr;                    // of which this is rank 0; null: on threads
  const std::atomic<bool>* stop = nullptr;  // ends it early
};

/// Computes the rows that the journal lacks and writes them down as they come. Where a job is
/// stopped or loses a rank, it ends all ranks, with what is missing on `console`.
void ComputeRows(const SweepPlan& plan, SweepJournal& journal, const SweepPlace& place,
                 Progress& progress, Console& console);
/// A rank other than 0 computes what it is given.
void FollowSweep(const SweepPlan& plan, MpiJob& job);

}  // namespace hoplab
