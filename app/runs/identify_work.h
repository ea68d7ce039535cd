#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "app/runs/mpi_job.h"
#include "app/terminal/console.h"
#include "app/terminal/progress.h"
#include "experiments/identification/fit_journal.h"
#include "experiments/identification/identification.h"

namespace hoplab {

/// Makes the fits of an identification: those that stand in the journal are taken from there, the
/// others are computed on threads, or on the ranks of a job, and written down as they come.
class IdentifyWork {
 public:
  struct Means {
    int jobs = 1;
    MpiJob* job = nullptr;  // rank 0 of it; null: threads
    const std::atomic<bool>* stop = nullptr;
  };
  IdentifyWork(const UnitContext& context, FitJournal& journal, const Means& means,
               Progress& progress, Console& console);
  IdentifyWork(const IdentifyWork&) = delete;
  IdentifyWork& operator=(const IdentifyWork&) = delete;
  /// Tells the other ranks that there is no more to do.
  ~IdentifyWork();

  FitUnits Fits();

 private:
  std::vector<StudyFit> Fit(const std::string& stage, const std::vector<StudyUnit>& units);
  void OnThreads(const std::vector<StudyUnit>& units, const std::vector<int>& missing,
                 std::vector<StudyFit>& fits);
  void OnRanks(const std::vector<StudyUnit>& units, const std::vector<int>& missing,
               std::vector<StudyFit>& fits);
  void Accept(const StudyUnit& unit, const StudyFit& fit);
  bool Stopped() const { return means_.stop && *means_.stop; }

  const UnitContext& context_;
  FitJournal& journal_;
  Means means_;
  Progress& progress_;
  Console& console_;
  std::string stage_;
  int done_ = 0, of_ = 0;  // units of the stage
};

/// What the other ranks do: fits that rank 0 asks for, until it has no more.
void FollowIdentification(const UnitContext& context, MpiJob& job);

}  // namespace hoplab
