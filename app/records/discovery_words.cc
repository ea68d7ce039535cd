#include "app/records/discovery_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/terminal/quantity.h"
#include "base/text.h"

namespace hoplab {
namespace {

bool Mentions(const FoundTerm& found, std::string_view variable) {
  return std::find(found.term.variables.begin(), found.term.variables.end(), variable) !=
         found.term.variables.end();
}

// Whether the term follows the sign of what it is made of: odd in it.
bool AsksForDirection(const FoundTerm& found) {
  const std::string& f = found.source.formula;
  if (f.find("sign(") != std::string::npos) return true;
  if (found.term.power) return !found.term.power->rest.empty();
  return false;
}

std::string Direction(const FoundTerm& found) {
  const double c = found.values.empty() ? 0.0 : found.values.front().value;
  const bool along = found.source.acts_as == "body_force_along";
  const bool damper = (found.source.acts_as == "body_force_x" && Mentions(found, "vx")) ||
                      (found.source.acts_as == "body_force_y" && Mentions(found, "vy")) ||
                      (found.source.acts_as == "chord_force" && Mentions(found, "rate"));
  if (along || (damper && AsksForDirection(found)))
    return c < 0.0 ? ", against the motion" : ", with the motion";
  return "";
}

}  // namespace

std::string WordsOf(const FoundTerm& found) {
  std::string meaning(FindPlace(found.source.acts_as)->meaning);
  std::string text =
      (found.source.acts_as.starts_with("reading") ? "an error of " : "a change of the ") + meaning;
  if (meaning.starts_with("force") || meaning.starts_with("torque")) text = "a " + meaning;
  text += Direction(found);
  if (found.term.words.empty())
    text += ", the same all the time";
  else
    text += ", that goes with " + found.term.words;
  if (!found.term.phase.empty()) text += ", " + found.term.phase;
  return text;
}

std::string SizesOf(const FoundTerm& found) {
  std::vector<std::string> parts;
  for (const FoundValue& v : found.values) {
    const std::string unit = v.unit == "-" || v.unit == "1" ? "" : " " + v.unit;
    if (!v.ci95) {
      parts.push_back(v.name + " = " + Significant(v.value, 3) + unit + " (no interval)");
      continue;
    }
    const double half = 0.5 * (v.ci95->second - v.ci95->first);
    const int decimals = std::clamp(DecimalsFor(half), 0, 12);
    parts.push_back(fmt::format("{} = {} +- {}{}", v.name, Fixed(v.value, decimals),
                                Fixed(half, decimals), unit));
  }
  return Join(parts);
}

std::string PhysicsOf(const FoundTerm& found) {
  std::vector<std::string> parts;
  const double c = found.values.empty() ? 0.0 : found.values.front().value;
  const std::string& place = found.source.acts_as;
  const std::string direction = Direction(found);
  if (place.starts_with("reading")) {
    parts.push_back("it changes what is read, not the motion");
  } else if (!direction.empty()) {
    parts.push_back(c < 0.0 ? "it only ever takes energy" : "it puts energy in");
  } else {
    parts.push_back("it may put energy in or take it away");
  }
  if (place.starts_with("body_force") && found.term.phase.empty())
    parts.push_back("it acts in flight, too");
  if (AsksForDirection(found)) parts.push_back("it turns over with the motion");
  return Join(parts, "; ");
}

std::string DiscoveredFile(std::size_t place) {
  return place == 0 ? "discovered.yaml" : "discovered-" + std::to_string(place + 1) + ".yaml";
}

FormulaSource WrittenSource(const FoundTerm& found, std::size_t place) {
  FormulaSource source = found.source;
  source.name = place == 0 ? "discovered" : "discovered_" + std::to_string(place + 1);
  source.sentence = WordsOf(found);
  return source;
}

std::string EffectFileText(const FormulaSource& source, const std::string& remark) {
  std::string text = "# " + remark + "\nformat: hoplab-effect/1\nname: " + source.name +
                     "\nacts_as: " + source.acts_as + "\nformula: \"" + source.formula +
                     "\"\nparameters:\n";
  for (const FormulaParameter& p : source.parameters) {
    text += "  " + p.name + ": {unit: \"" + p.unit + "\", " +
            (p.null ? "null: " + FormatDouble(*p.null) : "value: " + FormatDouble(*p.value)) +
            ", lower: " + FormatDouble(p.lower) + ", upper: " + FormatDouble(p.upper) +
            (p.typical ? ", typical: " + FormatDouble(*p.typical) : "") + "}\n";
  }
  return text + "sentence: \"" + source.sentence + "\"\n";
}

}  // namespace hoplab
