#include "app/export/effect_code.h"

#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include "app/export/effect_hooks.h"
#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

using Kind = FormulaTree::Kind;

std::string CodeNumber(double value) {
  const std::string text = FormatDouble(value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string Quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

// A function of a formula that C++ has no like of for dual numbers.
struct Helper {
  std::string_view name, code;
};
constexpr std::array kHelpers = {
    Helper{"Root",
           "template <class T>\nT Root(const T& x) {\n  using std::sqrt;\n"
           "  return Value(x) == 0.0 ? T(0.0) : sqrt(x);\n}\n"},
    Helper{"Raised",
           "template <class T>\nT Raised(const T& x, int n) {\n"
           "  T product(1.0);\n  for (int i = 0; i < (n < 0 ? -n : n); ++i) product *= x;\n"
           "  return n < 0 ? 1.0 / product : product;\n}\n"},
    Helper{"Power",
           "// Below zero, where a step may reach, its odd continuation.\n"
           "template <class T>\nT Power(const T& x, const T& c) {\n  using std::pow;\n"
           "  if (Value(x) > 0.0) return pow(x, c);\n"
           "  return Value(x) < 0.0 ? -pow(-x, c) : T(Value(c) > 0.0 ? 0.0 : 1.0);\n}\n"},
    Helper{"Abs",
           "template <class T>\nT Abs(const T& x) {\n"
           "  return Value(x) < 0.0 ? -x : Value(x) > 0.0 ? x : T(0.0);\n}\n"},
    Helper{"Sign",
           "template <class T>\nT Sign(const T& x) {\n"
           "  return T(Value(x) > 0.0 ? 1.0 : Value(x) < 0.0 ? -1.0 : 0.0);\n}\n"},
    Helper{"Step",
           "template <class T>\nT Step(const T& x) {\n"
           "  return T(Value(x) > 0.0 ? 1.0 : Value(x) < 0.0 ? 0.0 : 0.5);\n}\n"},
    Helper{"Max",
           "template <class T>\nT Max(const T& a, const T& b) {\n"
           "  return Value(a) >= Value(b) ? a : b;\n}\n"},
    Helper{"Min",
           "template <class T>\nT Min(const T& a, const T& b) {\n"
           "  return Value(a) < Value(b) ? a : b;\n}\n"}};

// The formula's text in C++.
class Writer {
 public:
  explicit Writer(const Formula& formula) : formula_(formula) {}

  std::string Text(const FormulaTree& t) const {
    switch (t.kind) {
      case Kind::kNumber:
        return CodeNumber(t.number);
      case Kind::kName:
        return Name(t.name);
      case Kind::kCall:
        return Call(t);
      case Kind::kSum:
        return Pair(t, " + ");
      case Kind::kDifference:
        return Pair(t, " - ");
      case Kind::kProduct:
        return Part(t, 0) + " * " + Part(t, 1);
      case Kind::kQuotient:
        return Part(t, 0) + " / " + Part(t, 1);
      case Kind::kPower:
        return Power(t);
      case Kind::kMinus:
        return "-" + Part(t, 0);
    }
    return "";
  }

 private:
  // In parentheses where it is made of several.
  std::string Part(const FormulaTree& t, std::size_t i) const {
    const FormulaTree& part = t.arguments[i];
    const bool whole = part.kind == Kind::kNumber || part.kind == Kind::kName ||
                       part.kind == Kind::kCall || part.kind == Kind::kPower ||
                       (part.kind == Kind::kProduct && i == 0);
    return whole ? Text(part) : "(" + Text(part) + ")";
  }
  std::string Pair(const FormulaTree& t, const char* sign) const {
    const FormulaTree& right = t.arguments[1];
    const bool sum =
        right.kind == Kind::kSum || right.kind == Kind::kDifference || right.kind == Kind::kMinus;
    return Text(t.arguments[0]) + sign + (sum ? "(" + Text(right) + ")" : Text(right));
  }
  std::string Name(const std::string& name) const {
    const std::vector<FormulaParameter>& parameters = formula_.source().parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (parameters[i].name == name) return "p[" + std::to_string(i) + "]";
    for (const VariableInfo& v : InfoOf(formula_.place()).variables)
      if (v.name == name) return CodeOf(v.variable, formula_.place());
    return CodeNumber(3.14159265358979323846);  // pi
  }
  std::string Call(const FormulaTree& t) const {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kOwn = {
        {{"abs", "Abs"},
         {"sign", "Sign"},
         {"step", "Step"},
         {"max", "Max"},
         {"min", "Min"},
         {"sqrt", "Root"}}};
    std::string name = t.name;
    for (const auto& [formula, code] : kOwn)
      if (t.name == formula) name = code;
    std::vector<std::string> arguments;
    for (const FormulaTree& a : t.arguments) arguments.push_back("T(" + Text(a) + ")");
    return name + "(" + Join(arguments) + ")";
  }
  std::string Power(const FormulaTree& t) const {
    const std::string base = "T(" + Text(t.arguments[0]) + ")";
    const std::optional<int> whole = WholeNumber(t.arguments[1]);
    if (whole) return "Raised(" + base + ", " + std::to_string(*whole) + ")";
    return "Power(" + base + ", T(" + Text(t.arguments[1]) + "))";
  }
  static std::optional<int> WholeNumber(const FormulaTree& t) {
    constexpr double kMost = 16.0;
    const bool minus = t.kind == Kind::kMinus && t.arguments[0].kind == Kind::kNumber;
    if (t.kind != Kind::kNumber && !minus) return std::nullopt;
    const double n = minus ? -t.arguments[0].number : t.number;
    if (n != std::round(n) || std::abs(n) > kMost) return std::nullopt;
    return static_cast<int>(n);
  }

  const Formula& formula_;
};

// "wind_gust" as "WindGust".
std::string TypeName(const std::string& name) {
  std::string out;
  bool up = true;
  for (const char c : name) {
    if (c != '_') out += up ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    up = c == '_';
  }
  return out;
}

std::string ParameterRows(const EffectInfo& info) {
  std::vector<std::string> rows;
  for (const EffectParameter& p : info.parameters)
    rows.push_back("      EffectParameter{" + Quoted(std::string(p.name)) + ", " +
                   Quoted(std::string(p.unit)) + ", " + CodeNumber(p.null) + ", " +
                   CodeNumber(p.lower) + ", " + CodeNumber(p.upper) + ", " + CodeNumber(p.typical) +
                   (p.is_shape ? ", true}" : "}"));
  return Join(rows, ",\n");
}

std::string Info(const EffectInfo& info) {
  const auto flag = [](bool is) { return is ? "true" : "false"; };
  static constexpr std::array<std::string_view, 4> kKinds = {"kForce", "kParameter", "kGuard",
                                                             "kObservation"};
  return "      .name = " + Quoted(std::string(info.name)) + ",\n      .kind = EffectKind::" +
         std::string(kKinds[static_cast<std::size_t>(info.kind)]) +
         ",\n      .equation = " + Quoted(std::string(info.equation)) +
         ",\n      .sentence = " + Quoted(std::string(info.sentence)) +
         ",\n      .for_legs = " + flag(info.for_legs) +
         ",\n      .for_ball = " + flag(info.for_ball) + ",\n      .dissipative = false,\n" +
         (info.order != 0 ? "      .order = " + std::to_string(info.order) + ",\n" : "") +
         (info.sharp ? "      .sharp = true,\n" : "") + "      .parameters = kParameters};\n";
}

std::string HelpersIn(const std::string& body) {
  std::string out;
  for (const Helper& h : kHelpers)
    if (body.find(std::string(h.name) + "(") != std::string::npos)
      out += std::string(h.code) + "\n";
  return out;
}

std::string FunctionsIn(const std::string& body) {
  std::string out;
  for (const char* name : {"sin", "cos", "tan", "exp", "log", "tanh"})
    if (body.find(std::string(name) + "(T(") != std::string::npos)
      out += "    using std::" + std::string(name) + ";\n";
  return out;
}

std::string Filled(std::string_view with, const std::string& value) {
  const std::size_t at = with.find('$');
  return std::string(with.substr(0, at)) + value + std::string(with.substr(at + 1));
}

std::string HookCode(const Formula& formula) {
  const EffectHook hook = HookFor(formula);
  const std::string body = hook.before + Filled(hook.after, Writer(formula).Text(formula.tree()));
  return "  template <class T>\n  static void " + std::string(hook.signature) + " {\n" +
         FunctionsIn(body) + body + "  }\n";
}

}  // namespace

std::vector<std::string> UnknownToCode(const FormulaSource& source) {
  const Formula& formula = *FormulaEffect(source).formula;
  std::vector<std::string> unknown;
  for (const VariableInfo& v : InfoOf(formula.place()).variables)
    if (formula.Uses(v.variable) && CodeOf(v.variable, formula.place()).empty())
      unknown.emplace_back(v.name);
  return unknown;
}

std::string EffectCodeOf(const FormulaSource& source, const std::string& place) {
  if (const std::vector<std::string> unknown = UnknownToCode(source); !unknown.empty())
    throw InputError({place, "acts_as = " + source.acts_as + " with " + Join(unknown),
                      "a compiled effect does not know them there",
                      "Keep the file: every command takes it with --with."});
  const Effect& effect = FormulaEffect(source);
  const std::string hook = HookCode(*effect.formula), type = TypeName(source.name);
  const std::string corners =
      effect.formula->corners().empty()
          ? ""
          : "// It has corners, and no event stops the solver there as it does for the formula: "
            "derivatives\n// are less exact. tanh(v/v0) in place of sign(v) has none.\n";
  return "// The formula " + Quoted(source.formula) + " as an effect (docs/adding/effect.md).\n" +
         corners +
         "#include <array>\n#include <cmath>\n\n#include \"model/effects/effect.h\"\n\n"
         "namespace hoplab {\nnamespace {\n\n" +
         HelpersIn(hook) + "struct " + type +
         " {\n  static constexpr std::array kParameters = {\n" + ParameterRows(effect.info) +
         "};\n  static constexpr EffectInfo kInfo = {\n" + Info(effect.info) + "\n" + hook +
         "};\n\n}  // namespace\n\nnamespace effects {\n" + "extern constexpr Effect " +
         source.name + " = MakeEffect<" + type + ">();\n}\n}  // namespace hoplab\n";
}

}  // namespace hoplab
