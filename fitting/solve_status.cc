#include "fitting/solve.h"

namespace hoplab {

std::string_view NameOf(SolveStatus status) {
  switch (status) {
    case SolveStatus::kConverged:
      return "converged";
    case SolveStatus::kIterationLimit:
      return "iteration_limit";
    case SolveStatus::kGaveUp:
      return "gave_up";
    case SolveStatus::kNoStart:
      return "no_start";
    case SolveStatus::kFailed:
      return "failed";
    case SolveStatus::kInterrupted:
      return "interrupted";
  }
  return "";
}

bool IsUsable(SolveStatus status) {
  return status == SolveStatus::kConverged || status == SolveStatus::kIterationLimit ||
         status == SolveStatus::kGaveUp;
}

}  // namespace hoplab
