#pragma once

#include <map>
#include <string>

#include "app/records/run_record.h"

namespace hoplab {

/// The report of a run as one HTML page that needs nothing else: the headline, then everything in
/// `record` (its run.json) and the CSVs among `files` (by name), drawn by the page itself. Throws
/// InputError for a CSV that is no table.
std::string ReportPage(const Json& record, const std::map<std::string, std::string>& files);

/// JSON fit to stand in a script element: no `<`, so that no `</script` or `<!--` can end or hide
/// it.
std::string ScriptJson(const Json& value);

/// `text` as the content of an element or a quoted attribute.
std::string HtmlText(const std::string& text);

}  // namespace hoplab
