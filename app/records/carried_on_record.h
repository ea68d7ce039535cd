#pragma once

#include <string>

#include "app/records/run_record.h"
#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// What the causes named by the first parts of the trials make of the whole trials, one sentence.
std::string WholeTrialsSentence(const CarriedOn& carried);

/// {"followed", "faults", "parameters", "test", "chi2_per_sample", "sentence"}; null where whole
/// trials were diagnosed.
Json WholeTrialsRecord(const Diagnosis& diagnosis);

}  // namespace hoplab
