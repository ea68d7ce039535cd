#pragma once

#include <optional>

#include "app/records/run_record.h"
#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

// Parts that the records of a diagnosis and of a discovery have in common.

Json HeldOutRecord(const FitProblem& problem, const HeldOutErrors& errors);
Json ForceRecord(const ReconstructedForce& force);
Json ForcesRecord(const std::optional<FreeForces>& free_forces);

}  // namespace hoplab
