#pragma once

#include "app/records/run_record.h"
#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// The best trial found to tell causes apart, whether or not it would settle anything.
Json SearchRecord(const Diagnosis& d);
/// The same if it would; null else.
Json ExperimentRecord(const Diagnosis& d);

}  // namespace hoplab
