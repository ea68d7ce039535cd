#pragma once

#include "app/records/run_record.h"
#include "app/runs/import_settings.h"

namespace hoplab {

/// What `hoplab import --json` prints, `seconds` excepted.
Json ImportRecord(const ImportRequest& request, const ImportSettings& settings,
                  const ImportResult& made);

}  // namespace hoplab
