#pragma once

#include "app/runs/mpi_job.h"
#include "app/terminal/exit_code.h"
#include "base/input_error.h"

namespace hoplab {

/// Calls `lead` with the job, or with null where no launcher started this process, and `follow` on
/// every rank but 0. Those say nothing: rank 0 reads the same settings and tells what is wrong with
/// them. They fail for nobody else: a launcher ends all ranks with the first that does, before rank
/// 0 may have spoken.
template <class Lead, class Follow>
ExitCode OnRanks(const Lead& lead, const Follow& follow) {
  if (!MpiJob::Launched()) return lead(nullptr);
  MpiJob job;
  if (job.rank() == 0) return lead(&job);
  try {
    follow(job);
  } catch (const InputError&) {
  }
  return ExitCode::kDone;
}

}  // namespace hoplab
