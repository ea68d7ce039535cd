#include "app/records/json_at.h"

#include <limits>

namespace hoplab {

const Json& JsonAt(const Json& record, const std::string& pointer) {
  static const Json kNull = nullptr;
  const Json::json_pointer path(pointer);
  return record.contains(path) ? record.at(path) : kNull;
}

std::string TextAt(const Json& record, const std::string& pointer) {
  const Json& value = JsonAt(record, pointer);
  return value.is_string() ? value.get<std::string>() : "";
}

double NumberAt(const Json& record, const std::string& pointer) {
  const Json& value = JsonAt(record, pointer);
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::size_t SizeAt(const Json& record, const std::string& pointer) {
  const Json& value = JsonAt(record, pointer);
  return value.is_structured() ? value.size() : 0;
}

}  // namespace hoplab
