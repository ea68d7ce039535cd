#include "app/reports/headline_parts.h"

#include <cmath>

#include "app/terminal/quantity.h"
#include "base/text.h"

namespace hoplab {

std::string PointerKey(const std::string& key) {
  std::string out;
  for (const char c : key) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return out;
}

HeadlineFigure Figure(const Json& record, const std::string& label, const std::string& pointer,
                      const std::string& unit, int digits) {
  HeadlineFigure figure{label, kNotComputed, "", "", pointer};
  const double value = NumberAt(record, pointer);
  if (std::isnan(value)) return figure;
  const ReadableUnit readable = ReadableUnitOf(value, unit);
  const bool whole = JsonAt(record, pointer).is_number_integer();
  figure.value = whole ? std::to_string(JsonAt(record, pointer).get<long>())
                       : Significant(value * readable.factor, digits);
  figure.unit = readable.unit;
  return figure;
}

HeadlineFigure CountFigure(const std::string& label, const std::string& value,
                           const std::string& pointer) {
  return {label, value, "", "", pointer};
}

std::string WorstChannel(const Json& record, const std::string& errors) {
  std::string worst;
  double most = -1.0;
  for (const auto& [name, value] : JsonAt(record, errors).items()) {
    if (!value.is_number()) continue;
    double sigma = 1.0;
    for (const Json& channel : JsonAt(record, "/channels")) {
      const double stated = NumberAt(channel, "/sigma");
      if (TextAt(channel, "/name") == name && stated > 0.0) sigma = stated;
    }
    if (value.get<double>() / sigma > most) {
      most = value.get<double>() / sigma;
      worst = name;
    }
  }
  return worst;
}

HeadlineFigure ErrorFigure(const Json& record, const std::string& what, const std::string& errors,
                           const std::string& worst_in) {
  const std::string channel = WorstChannel(record, worst_in.empty() ? errors : worst_in);
  if (channel.empty()) return {what, kNotComputed, "", "", errors};
  HeadlineFigure figure = Figure(record, what + ", " + WithoutUnit(channel),
                                 errors + "/" + PointerKey(channel), UnitOfChannel(channel), 3);
  if (UnitOfChannel(channel) == "m") {  // as the tables say it
    const std::string text = ErrorText(NumberAt(record, figure.pointer), "m");
    figure.value = text.substr(0, text.find(' '));
    figure.unit = "mm";
  }
  return figure;
}

}  // namespace hoplab
