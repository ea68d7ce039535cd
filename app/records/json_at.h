#pragma once

#include <string>

#include "app/records/run_record.h"

namespace hoplab {

/// What stands at a pointer of a record; null where the record ends before.
const Json& JsonAt(const Json& record, const std::string& pointer);
/// The text there, or "".
std::string TextAt(const Json& record, const std::string& pointer);
/// The number there, or NaN.
double NumberAt(const Json& record, const std::string& pointer);
/// How many stand there; 0 for a number or a text.
std::size_t SizeAt(const Json& record, const std::string& pointer);

}  // namespace hoplab
