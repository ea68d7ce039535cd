#include <fmt/format.h>

#include <cmath>

#include "app/reports/headline_parts.h"
#include "app/terminal/quantity.h"
#include "base/text.h"

namespace hoplab {
namespace {

// How many of a list have the verdict "reproduced", of how many.
HeadlineFigure ReproducedFigure(const Json& record, const std::string& label,
                                const std::string& pointer) {
  std::size_t reproduced = 0;
  for (const Json& part : JsonAt(record, pointer))
    reproduced += TextAt(part, "/verdict") == "reproduced" ? 1 : 0;
  return {label, std::to_string(reproduced), "", "of " + std::to_string(SizeAt(record, pointer)),
          pointer};
}

}  // namespace

void ReproductionHeadline(const Json& record, Headline& out) {
  const HeadlineFigure claims = ReproducedFigure(record, "claims reproduced", "/claims");
  const HeadlineFigure tables = ReproducedFigure(record, "tables reproduced", "/tables");
  out.sentence = TextAt(record, "/sentence");
  if (out.sentence.empty()) {
    std::vector<std::string> parts;
    if (SizeAt(record, "/claims") > 0)
      parts.push_back(claims.value + " " + claims.note + " claims of the study");
    if (SizeAt(record, "/tables") > 0)
      parts.push_back(tables.value + " " + tables.note + " of its tables");
    out.sentence = parts.empty() ? "The study was run anew."
                                 : Listed(parts) + " are reproduced with its own settings.";
  }
  out.figures = {
      claims, tables,
      CountFigure("figures drawn anew", std::to_string(SizeAt(record, "/figures")), "/figures")};
}

void ComparisonHeadline(const Json& record, Headline& out) {
  std::vector<std::string> names;
  for (const Json& run : JsonAt(record, "/runs")) names.push_back(TextAt(run, "/name"));
  out.title = "Comparison of " + Listed(names);
  out.sentence = TextAt(record, "/sentence");
  if (names.empty()) return;
  const std::size_t last = names.size() - 1;
  // The value that changed most for its interval; where none has one, the first.
  std::size_t most = 0;
  double size = -1.0;
  for (std::size_t i = 0; i < SizeAt(record, "/values"); ++i) {
    const double z = std::abs(NumberAt(record, fmt::format("/values/{}/runs/{}/z", i, last)));
    if (z > size) {
      size = z;
      most = i;
    }
  }
  const std::string value = fmt::format("/values/{}", most);
  const std::string own = fmt::format("{}/runs/{}", value, last);
  out.figures.push_back(Figure(record, "change of " + TextAt(record, value + "/name"),
                               own + "/difference", TextAt(record, value + "/unit"), 3));
  out.figures.back().note =
      size < 0.0 ? "no interval"
                 : fmt::format("z = {}", Significant(NumberAt(record, own + "/z"), 2));
  out.figures.push_back(Figure(record, "clear changes", "/clear_changes", ""));
  out.figures.back().note = fmt::format("of {} values", SizeAt(record, "/values"));
  const std::string errors = fmt::format("/errors/0/values/{}", last);
  const std::string channel = TextAt(record, "/errors/0/channel");
  const std::string what = TextAt(record, "/errors/0/what"),
                    unit = TextAt(record, "/errors/0/unit");
  HeadlineFigure error =
      Figure(record, what + (channel.empty() ? "" : ", ") + WithoutUnit(channel), errors, unit, 3);
  if (unit == "m") {  // as the tables say it
    const std::string text = ErrorText(NumberAt(record, errors), unit);
    error.value = text.substr(0, text.find(' '));
    error.unit = "mm";
  }
  error.note = "was " + ErrorText(NumberAt(record, "/errors/0/values/0"), unit);
  out.figures.push_back(error);
}

}  // namespace hoplab
