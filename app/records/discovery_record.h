#pragma once

#include <map>
#include <string>

#include "app/records/run_record.h"
#include "fitting/discovery/discover.h"

namespace hoplab {

/// Why there is no verdict; empty if there is one.
std::string FailureOf(const Discovery& d);

/// The keys of a discovery: `discovered`, `alternatives`, `held_out`, `verdict`, `reason`,
/// `library`. SI units; what was not computed is null.
Json DiscoveryPart(const Discovery& d);

/// run.json of `hoplab discover`, `seconds` excepted.
Json DiscoveryRecord(const Dataset& dataset, const std::string& dataset_argument,
                     const DiagnosisOptions& options, const Discovery& d);

/// discovered.csv (the found terms over their variables), evidence.csv (where along the trials they
/// speak), residuals.csv and the effect files.
std::map<std::string, std::string> DiscoveryFiles(const Discovery& d);

}  // namespace hoplab
