#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/thesis_reading.h"

namespace hoplab {

/// Keeps keys in the order in which they were put.
using Json = nlohmann::ordered_json;

inline constexpr const char* kRunSchema = "hoplab-run/1";

/// The keys every run.json has.
struct RecordHeader {
  std::string command;
  std::optional<std::string> dataset;  // its name, or the scenario's
  std::optional<std::string> law;
  ThesisReading reading;  // `law_variant` of the record; null there where it is the default
  std::optional<std::uint64_t> seed;
  Json options = Json::object();  // the whole resolved configuration, `jobs` and places left out
};

/// A record of status "ok" with the common keys; what is absent is null. `seconds` is null.
Json NewRecord(const RecordHeader& header);

/// The words of a reading by its keys.
Json ThesisReadingRecord(const ThesisReading& reading);

/// What a command prints with --json when it ended before it had anything to record.
std::string FailureText(const std::string& command, const std::string& message);

/// Turns the record's status to "failed".
void SetFailed(Json& record, const std::string& message);

/// Null for NaN and infinities, which JSON does not have; the number, read back exactly, else.
Json NumberOrNull(double value);
Json NumberOrNull(const std::optional<double>& value);

/// The record as text: indented, newline at the end.
std::string TextOf(const Json& record);

}  // namespace hoplab
