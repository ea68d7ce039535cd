#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/records/run_record.h"
#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// Whether something is missing.
Json DetectionRecord(const Detection& detection);
/// Where: by mode, phase and channel.
Json LocalisationRecord(const Diagnosis& d);
/// Shares of the misfit in parts of the data, each under `key` by its name.
Json PartsRecord(const std::vector<MisfitPart>& parts, const char* key,
                 const std::function<Json(int index)>& name);

}  // namespace hoplab
