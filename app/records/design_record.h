#pragma once

#include <map>
#include <string>

#include "app/records/run_record.h"
#include "app/runs/design_run.h"

namespace hoplab {

/// The run as run.json has it.
Json DesignRecord(const Dataset& dataset, const std::string& dataset_argument,
                  const DesignRunOptions& options, const DesignRun& run);

/// The tables that there are by file name: designs.csv, every design tried, by the linear forecast,
/// then the refitted ones; map.csv, worth over two settings, the others as in the best design.
std::map<std::string, std::string> DesignTables(const DesignRun& run);

/// What to record, and what it is expected to bring; empty if there is no design.
std::string DesignSentence(const DesignRun& run);

/// "0.12 bits", "below 0.001 bits": an entropy given by its logarithm in nats.
std::string BitsText(double log_nats);

}  // namespace hoplab
