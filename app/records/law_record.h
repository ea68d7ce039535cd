#pragma once

#include "app/records/run_record.h"
#include "model/simulate.h"

namespace hoplab {

/// What `hoplab laws --json` prints.
Json LawsRecord();

}  // namespace hoplab
