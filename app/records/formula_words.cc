#include "app/records/formula_words.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "app/terminal/report_text.h"
#include "base/text.h"

namespace hoplab {
namespace {

using Kind = FormulaTree::Kind;

// How tightly a part binds: what stands inside a looser one needs parentheses.
int Binding(const FormulaTree& t) {
  switch (t.kind) {
    case Kind::kSum:
    case Kind::kDifference:
      return 1;
    case Kind::kMinus:
    case Kind::kProduct:
    case Kind::kQuotient:
      return 2;
    case Kind::kPower:
      return 3;
    default:
      return 4;
  }
}

std::string Raised(const FormulaTree& exponent) {
  static constexpr std::array<std::string_view, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                               "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (exponent.kind != Kind::kNumber) return "";
  const std::string digits = FormatDouble(exponent.number);
  std::string out;
  for (const char c : digits) {
    if (c < '0' || c > '9') return "";
    out += kDigits[static_cast<std::size_t>(c - '0')];
  }
  return out;
}

std::string Line(const FormulaTree& t, int least) {
  const auto part = [&](std::size_t i, int binding) { return Line(t.arguments[i], binding); };
  std::string text;
  switch (t.kind) {
    case Kind::kNumber:
      text = FormatDouble(t.number);
      break;
    case Kind::kName:
      text = t.name;
      break;
    case Kind::kCall: {
      std::vector<std::string> arguments;
      for (const FormulaTree& a : t.arguments) arguments.push_back(Line(a, 0));
      text = t.name + "(" + Join(arguments) + ")";
      break;
    }
    case Kind::kSum:
      text = part(0, 1) + " + " + part(1, 1);
      break;
    case Kind::kDifference:
      text = part(0, 1) + " - " + part(1, 2);
      break;
    case Kind::kProduct:
      text = part(0, 2) + " " + part(1, t.arguments[1].kind == Kind::kMinus ? 3 : 2);
      break;
    case Kind::kQuotient:
      text = part(0, 2) + "/" + part(1, 3);
      break;
    case Kind::kPower: {
      const std::string raised = Raised(t.arguments[1]);
      text = part(0, 4) + (raised.empty() ? "^" + part(1, 4) : raised);
      break;
    }
    case Kind::kMinus:
      text = "-" + part(0, 2);
      break;
  }
  return Binding(t) < least ? "(" + text + ")" : text;
}

std::string Tag(std::string_view tag, const std::string& text) {
  return "<" + std::string(tag) + ">" + text + "</" + std::string(tag) + ">";
}

// A name with what follows its first underscore lowered.
std::string MathName(const std::string& name) {
  const std::size_t at = name.find('_');
  if (at == std::string::npos || at == 0 || at + 1 == name.size()) return Tag("mi", name);
  return Tag("msub", Tag("mi", name.substr(0, at)) + Tag("mi", name.substr(at + 1)));
}

std::string Math(const FormulaTree& t, int least);

std::string MathCall(const FormulaTree& t) {
  const std::string inside = Math(t.arguments[0], 0);
  if (t.name == "abs") return Tag("mrow", "<mo>|</mo>" + inside + "<mo>|</mo>");
  if (t.name == "sqrt") return Tag("msqrt", inside);
  std::string arguments = inside;
  for (std::size_t i = 1; i < t.arguments.size(); ++i)
    arguments += "<mo>,</mo>" + Math(t.arguments[i], 0);
  return Tag("mrow", Tag("mi", t.name) + "<mo>(</mo>" + arguments + "<mo>)</mo>");
}

std::string Math(const FormulaTree& t, int least) {
  const auto part = [&](std::size_t i, int binding) { return Math(t.arguments[i], binding); };
  std::string text;
  switch (t.kind) {
    case Kind::kNumber:
      return Tag("mn", FormatDouble(t.number));
    case Kind::kName:
      return MathName(t.name);
    case Kind::kCall:
      return MathCall(t);
    case Kind::kSum:
      text = part(0, 1) + "<mo>+</mo>" + part(1, 1);
      break;
    case Kind::kDifference:
      text = part(0, 1) + "<mo>−</mo>" + part(1, 2);
      break;
    case Kind::kProduct:
      text = part(0, 2) + "<mspace width=\"0.2em\"/>" +
             part(1, t.arguments[1].kind == Kind::kMinus ? 3 : 2);
      break;
    case Kind::kQuotient:
      return Tag("mfrac", Tag("mrow", part(0, 0)) + Tag("mrow", part(1, 0)));
    case Kind::kPower:
      return Tag("msup", Tag("mrow", part(0, 4)) + Tag("mrow", part(1, 0)));
    case Kind::kMinus:
      text = "<mo>−</mo>" + part(0, 2);
      break;
  }
  return Tag("mrow", Binding(t) < least ? "<mo>(</mo>" + text + "<mo>)</mo>" : text);
}

// What a corner's argument is, in words of the formula: names in `key` are those of variables.
std::string CornersOf(const Formula& formula) {
  const std::size_t count = formula.corners().size();
  if (count == 0) return "none: the formula is smooth";
  const auto jumps =
      static_cast<std::size_t>(std::count_if(formula.corners().begin(), formula.corners().end(),
                                             [](const FormulaCorner& c) { return !c.is_smooth; }));
  const std::string text = std::to_string(count) + (count == 1 ? " corner" : " corners") +
                           (jumps == 0 ? "" : ", " + std::to_string(jumps) + " a jump");
  return InfoOf(formula.place()).in_flow ? text + "; the solver stops there" : text;
}

}  // namespace

std::string LineOf(const Formula& formula) { return Line(formula.tree(), 0); }

std::string MathMlOf(const Formula& formula) {
  return "<math display=\"block\"><mrow>" + MathName(std::string(InfoOf(formula.place()).symbol)) +
         "<mo>⟵</mo>" + MathName(std::string(InfoOf(formula.place()).symbol)) + "<mo>+</mo>" +
         Math(formula.tree(), 2) + "</mrow></math>";
}

std::string FormulaExplained(const Effect& effect, bool colours) {
  const Formula& formula = *effect.formula;
  const PlaceInfo& place = InfoOf(formula.place());
  std::string text =
      Labelled("adds", LineOf(formula) + "  [" + std::string(place.unit) + "]", colours);
  text +=
      Labelled("to", std::string(place.meaning) + " (" + std::string(place.name) + ")", colours);
  for (const VariableInfo& v : place.variables) {
    if (!formula.Uses(v.variable)) continue;
    text += Labelled(
        std::string(v.name),
        (v.unit == "-" ? "" : "[" + std::string(v.unit) + "] ") + std::string(v.meaning), colours);
  }
  return text + Labelled("corners", CornersOf(formula), colours);
}

}  // namespace hoplab
