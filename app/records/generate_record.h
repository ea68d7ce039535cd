#pragma once

#include "app/records/run_record.h"
#include "app/runs/generate_settings.h"
#include "fitting/generate.h"

namespace hoplab {

/// What `hoplab generate --json` prints, `seconds` excepted.
Json GenerateRecord(const GenerateSettings& settings, const Scenario& scenario,
                    const GeneratedDataset& made);

}  // namespace hoplab
