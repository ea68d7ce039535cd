#pragma once

#include "app/records/run_record.h"
#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// Every cause that was tried: its score, its refit, how it was judged.
Json CandidatesRecord(const Diagnosis& d);

}  // namespace hoplab
