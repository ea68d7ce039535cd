#include "app/reports/force_report.h"

#include <fmt/format.h>

#include <cmath>

#include "app/records/diagnosis_words.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"

namespace hoplab {
namespace {

constexpr std::size_t kMostForces = 3;  // told; the rest stands in the CSVs
// A term of a sparse regression worth a word: resampling keeps it this often.
constexpr double kOftenKept = 0.5;

// "-0.072 + 0.39 s, kept by 99 % of the resamples or more"; empty where no term is.
std::string ShapeText(const ReconstructedForce& f) {
  std::string text;
  double least = 1.0;
  for (const RegressionTerm& t : f.terms) {
    if (t.inclusion < kOftenKept || t.coefficient == 0.0) continue;
    const std::string size = Significant(std::abs(t.coefficient), 2);
    const bool negative = t.coefficient < 0.0;
    text += text.empty() ? (negative ? "-" : "") : (negative ? " - " : " + ");
    text += t.term == "1" ? size : size + " " + t.term;
    least = std::min(least, t.inclusion);
  }
  if (text.empty()) return "";
  return fmt::format("{}, kept by {} of the resamples", text, WholeShareText(least));
}

std::string ForceLine(const ReconstructedForce& f) {
  const ForcePoint* largest = nullptr;
  for (const ForcePoint& p : f.points) {
    if (std::isnan(p.band95)) continue;
    if (!largest || std::abs(p.value) / p.band95 > std::abs(largest->value) / largest->band95)
      largest = &p;
  }
  const std::string against = f.group.against.substr(0, f.group.against.find(" [-]"));
  std::string text = f.group.name;
  if (largest) {
    const ReadableUnit unit = ReadableUnitOf(largest->value, f.group.unit);
    const double band = largest->band95 * unit.factor;
    const int decimals = DecimalsFor(band);
    text += fmt::format(" {} +- {} {}", FixedOrMore(largest->value * unit.factor, decimals),
                        Fixed(band, decimals), unit.unit);
    if (!against.empty()) text += fmt::format(" at {} {}", against, Significant(largest->at, 2));
  }
  if (const std::string shape = ShapeText(f); !shape.empty())
    text += fmt::format("; over s = {}: {}", against, shape);
  return text;
}

}  // namespace

std::string ForceLines(const FreeForces& free_forces, bool colours) {
  std::string text;
  std::size_t shown = 0;
  for (const ReconstructedForce& f : free_forces.forces) {
    if (shown == kMostForces || f.p_value > kDetectionLevel) break;
    text += Labelled(shown++ == 0 ? "free forces" : "", ForceLine(f), colours);
  }
  if (shown > 0)
    text += Labelled("", "(what is missing as a force, a description and no mechanism)", colours);
  return text;
}

}  // namespace hoplab
