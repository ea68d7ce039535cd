#include "app/records/run_record.h"

#include <cmath>

#include "app/version.h"

namespace hoplab {
namespace {

template <class T>
Json OrNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

}  // namespace

Json NewRecord(const RecordHeader& header) {
  return {{"schema", kRunSchema},
          {"command", header.command},
          {"version", ProjectVersion()},
          {"status", "ok"},
          {"message", ""},
          {"dataset", OrNull(header.dataset)},
          {"law", OrNull(header.law)},
          {"law_variant",
           header.reading == ThesisReading() ? Json(nullptr) : ThesisReadingRecord(header.reading)},
          {"seed", OrNull(header.seed)},
          {"options", header.options},
          {"seconds", nullptr}};
}

Json ThesisReadingRecord(const ThesisReading& reading) {
  Json record = Json::object();
  for (const ReadingKey& key : ReadingKeys())
    record[std::string(key.key)] = key.words[key.get(reading)];
  return record;
}

void SetFailed(Json& record, const std::string& message) {
  record["status"] = "failed";
  record["message"] = message;
}

Json NumberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json NumberOrNull(const std::optional<double>& value) {
  return value ? NumberOrNull(*value) : Json(nullptr);
}

std::string TextOf(const Json& record) {
  // Messages may quote a file that is not UTF-8; its bytes are replaced, not thrown over.
  return record.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string FailureText(const std::string& command, const std::string& message) {
  return TextOf(
      {{"schema", kRunSchema}, {"command", command}, {"status", "failed"}, {"message", message}});
}

}  // namespace hoplab
