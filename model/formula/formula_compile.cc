#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "model/formula/formula_compiler.h"
#include "model/formula/formula_limits.h"

namespace hoplab {

void FormulaCompiler::Compile() {
  Known whole = Compiled(to_.tree_);
  const Unit wanted = *ParseUnit(place_.unit);
  if (!whole.any_unit && !(whole.unit == wanted))
    throw FormulaError(to_.tree_.begin, to_.tree_.end,
                       "has the unit " + TextOf(whole.unit) + "; " + std::string(place_.name) +
                           " must have " + std::string(place_.unit),
                       "Multiply by what is missing, or correct the unit of a parameter.");
  to_.result_ = whole.step;
  RemoveUnusedSteps();
  CheckEveryParameterIsUsed();
}

Unit FormulaCompiler::UnitOf(int parameter) const {
  const FormulaParameter& p = source_.parameters[static_cast<std::size_t>(parameter)];
  if (const std::optional<Unit> unit = ParseUnit(p.unit)) return *unit;
  throw FormulaError(parameter,
                     "has the unit " + (p.unit.empty() ? "(none)" : Printable(p.unit)) +
                         ", which is none of m, kg, s, N, Pa, J, W, Hz, rad, 1, - and their "
                         "products and powers",
                     "Write it as \"N s/m\" or \"1\"; there are no prefixes: 0.001 m, not mm.");
}

void FormulaCompiler::Fail(const FormulaTree& at, const std::string& rule,
                           const std::string& remedy) {
  throw FormulaError(at.begin, at.end, rule, remedy);
}

FormulaCompiler::Known FormulaCompiler::Compiled(const FormulaTree& t) {
  switch (t.kind) {
    case Kind::kNumber:
      return Number(t);
    case Kind::kName:
      return Name(t);
    case Kind::kCall:
      return Call(t);
    case Kind::kMinus: {
      const Known a = Compiled(t.arguments[0]);
      return Unary(t, Op::kNegate, a, a.unit);
    }
    case Kind::kSum:
    case Kind::kDifference:
      return Sum(t);
    case Kind::kProduct:
      return Product(t);
    case Kind::kQuotient:
      return Quotient(t);
    case Kind::kPower:
      return Power(t);
  }
  return {};
}

FormulaCompiler::Known FormulaCompiler::Number(const FormulaTree& t) {
  if (!std::isfinite(t.number)) Fail(t, "is no finite number", "Write one a double can hold.");
  return Constant(t, t.number);
}

FormulaCompiler::Known FormulaCompiler::Constant(const FormulaTree& t, double value) {
  Known k;
  k.constant = value;
  k.any_unit = value == 0.0;
  k.never_negative = value >= 0.0;
  k.usual = std::abs(value);
  k.key = FormatDouble(value);
  k.step = Add(t, {Op::kConstant, -1, -1, -1, value});
  return k;
}

FormulaCompiler::Known FormulaCompiler::Name(const FormulaTree& t) {
  for (std::size_t i = 0; i < source_.parameters.size(); ++i) {
    if (source_.parameters[i].name == t.name) return Parameter(t, static_cast<int>(i));
  }
  for (const VariableInfo& v : place_.variables)
    if (v.name == t.name) return Variable(t, v);
  if (t.name == "pi") {
    Known k = Constant(t, 3.14159265358979323846);
    return k;
  }
  if (FindFormulaFunction(t.name))
    Fail(t, t.name + " is a function and has no argument here",
         "Write " + t.name + "(" + (FindFormulaFunction(t.name)->arguments == 2 ? "a, b" : "x") +
             ").");
  for (const PlaceInfo& other : AllPlaces()) {
    for (const VariableInfo& v : other.variables)
      if (v.name == t.name)
        Fail(t, t.name + " is not known to a " + std::string(place_.name),
             "There are " + VariableNames() + ". A " + std::string(other.name) + " knows " +
                 t.name + ".");
  }
  Fail(t,
       Printable(t.name) + " is neither a parameter of the effect nor a variable of " +
           std::string(place_.name),
       DidYouMean(t.name, Names()));
}

FormulaCompiler::Known FormulaCompiler::Parameter(const FormulaTree& t, int i) {
  const FormulaParameter& p = source_.parameters[static_cast<std::size_t>(i)];
  Known k;
  k.unit = parameter_units_[static_cast<std::size_t>(i)];
  k.never_negative = p.lower >= 0.0;
  k.of_parameter = true;
  k.usual = std::abs(p.null ? p.typical.value_or(1.0) : p.value.value_or(1.0));
  k.key = "$" + std::to_string(i);
  used_.push_back(i);
  k.step = Add(t, {Op::kParameter, static_cast<std::int16_t>(i)});
  return k;
}

FormulaCompiler::Known FormulaCompiler::Variable(const FormulaTree& t, const VariableInfo& v) {
  if (v.variable == FormulaVariable::kLoading) return Loading(t);
  Known k;
  k.unit = *ParseUnit(v.unit);
  k.never_negative = v.never_negative;
  k.usual = v.usual;
  k.of_time = v.variable == FormulaVariable::kTime;
  k.key = std::string(v.name);
  to_.uses_[static_cast<std::size_t>(v.variable)] = true;
  k.step = Add(t, {Op::kVariable, static_cast<std::int16_t>(v.variable)});
  return k;
}

FormulaCompiler::Known FormulaCompiler::Loading(const FormulaTree& t) {
  for (const VariableInfo& v : place_.variables) {
    if (v.variable != FormulaVariable::kChordRate) continue;
    const Known rate = Variable(t, v);
    const Known minus = Unary(t, Op::kNegate, rate, rate.unit);
    Known k = WithCorner(t, Op::kStep, minus, minus.step, minus.usual, false, minus.key);
    k.unit = Unit::One();
    k.never_negative = true;
    k.usual = 1.0;
    k.key = "loading";
    return k;
  }
  return {};
}

std::vector<std::string> FormulaCompiler::Names() const {
  std::vector<std::string> names;
  for (const FormulaParameter& p : source_.parameters) names.push_back(p.name);
  for (const VariableInfo& v : place_.variables) names.emplace_back(v.name);
  for (const FormulaFunction& f : AllFormulaFunctions()) names.emplace_back(f.name);
  return names;
}

std::string FormulaCompiler::VariableNames() const {
  std::vector<std::string> names;
  for (const VariableInfo& v : place_.variables) names.emplace_back(v.name);
  return Join(names);
}

FormulaCompiler::Known FormulaCompiler::WithCorner(const FormulaTree& t, Op op, const Known& of,
                                                   int argument, double usual, bool smooth,
                                                   const std::string& key, int a, int b) {
  const bool reading =
      to_.place_ == FormulaPlace::kReadingX || to_.place_ == FormulaPlace::kReadingY;
  if (reading && of.of_time)
    Fail(t, "changes at an instant, and a reading is taken at the times of the rows only",
         "Let it change smoothly, as 0.5 * (1 + tanh((t - t0)/width)).");
  std::size_t corner = 0;
  while (corner < to_.corners_.size() && to_.corners_[corner].argument != argument) ++corner;
  if (corner == to_.corners_.size()) {
    if (corner == kMaxFormulaCorners)
      Fail(t, "is the fifth corner of the formula; there may be four",
           "Let one of abs, sign, step, max, min and loading be smooth, as tanh(v/v0).");
    to_.corners_.push_back(
        {argument, usual > 0.0 ? usual : 1.0, smooth, of.of_parameter ? "" : CornerFamily() + key});
  }
  to_.corners_[corner].is_smooth = to_.corners_[corner].is_smooth && smooth;
  Known k = of;
  k.constant.reset();
  k.step = Add(t, {op, static_cast<std::int16_t>(a < 0 ? argument : a),
                   static_cast<std::int16_t>(b), static_cast<std::int16_t>(corner)});
  return k;
}

std::string FormulaCompiler::CornerFamily() const {
  switch (to_.place_) {
    case FormulaPlace::kChordForce:
      return "chord:";
    case FormulaPlace::kHipTorque:
      return "hip:";
    case FormulaPlace::kTouchdownAngle:
      return "placement:";
    default:
      return "body:";
  }
}

FormulaCompiler::Known FormulaCompiler::Both(const Known& a, const Known& b) {
  Known k;
  k.of_time = a.of_time || b.of_time;
  k.of_parameter = a.of_parameter || b.of_parameter;
  return k;
}

std::int16_t FormulaCompiler::Index(const Known& k) { return static_cast<std::int16_t>(k.step); }

int FormulaCompiler::Add(const FormulaTree& t, const FormulaStep& step) {
  for (std::size_t i = 0; i < to_.steps_.size(); ++i)
    if (to_.steps_[i] == step) return static_cast<int>(i);
  if (to_.steps_.size() == kMostFormulaSteps)
    Fail(t,
         "is the formula's step " + std::to_string(kMostFormulaSteps + 1) + "; there may be " +
             std::to_string(kMostFormulaSteps),
         "Split it into several effects.");
  to_.steps_.push_back(step);
  return static_cast<int>(to_.steps_.size()) - 1;
}

std::string_view FormulaCompiler::NameOf(Op op) {
  for (const FormulaFunction& f : AllFormulaFunctions())
    if (f.op == op) return f.name;
  return "-";
}

bool FormulaCompiler::TakesSteps(Op op) {
  return op != Op::kConstant && op != Op::kParameter && op != Op::kVariable;
}

bool FormulaCompiler::TakesTwo(Op op) {
  return op == Op::kAdd || op == Op::kSubtract || op == Op::kMultiply || op == Op::kDivide ||
         op == Op::kPower || op == Op::kMax || op == Op::kMin;
}

void FormulaCompiler::RemoveUnusedSteps() {
  std::vector<FormulaStep>& steps = to_.steps_;
  std::vector<bool> needed(steps.size(), false);
  needed[static_cast<std::size_t>(to_.result_)] = true;
  for (const FormulaCorner& c : to_.corners_) needed[static_cast<std::size_t>(c.argument)] = true;
  for (std::size_t i = steps.size(); i-- > 0;) {
    if (!needed[i] || !TakesSteps(steps[i].op)) continue;
    needed[static_cast<std::size_t>(steps[i].a)] = true;
    if (TakesTwo(steps[i].op)) needed[static_cast<std::size_t>(steps[i].b)] = true;
  }
  std::vector<std::int16_t> moved(steps.size());
  std::vector<FormulaStep> kept;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    moved[i] = static_cast<std::int16_t>(kept.size());
    if (!needed[i]) continue;
    FormulaStep step = steps[i];
    if (TakesSteps(step.op)) step.a = moved[static_cast<std::size_t>(step.a)];
    if (TakesTwo(step.op)) step.b = moved[static_cast<std::size_t>(step.b)];
    kept.push_back(step);
  }
  to_.result_ = moved[static_cast<std::size_t>(to_.result_)];
  for (FormulaCorner& c : to_.corners_) c.argument = moved[static_cast<std::size_t>(c.argument)];
  steps = std::move(kept);
}

void FormulaCompiler::CheckEveryParameterIsUsed() const {
  for (int i = 0; i < static_cast<int>(source_.parameters.size()); ++i) {
    if (std::find(used_.begin(), used_.end(), i) != used_.end()) continue;
    throw FormulaError(i, "does not occur in the formula", "Use it there, or remove it.");
  }
}

namespace {

const PlaceInfo& PlaceOf(const FormulaSource& source) {
  if (const PlaceInfo* place = FindPlace(source.acts_as)) return *place;
  std::vector<std::string> known;
  for (const PlaceInfo& p : AllPlaces()) known.emplace_back(p.name);
  throw FormulaError(FormulaError::Of::kActsAs, "is no place where a formula can act",
                     DidYouMean(source.acts_as, known));
}

}  // namespace

Formula::Formula(const FormulaSource& source)
    : source_(source), place_(PlaceOf(source).place), tree_(ParseFormula(source.formula)) {
  FormulaCompiler(source, *this).Compile();
}

std::string FormulaError::Picture(const std::string& formula) const {
  if (of_ != Of::kFormula || end_ <= begin_ || formula.size() > kLongestFormula) return "";
  std::string line = formula;
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return "    " + line + "\n    " + std::string(begin_, ' ') + "^" +
         std::string(end_ - begin_ - 1, '~');
}

}  // namespace hoplab
