#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "model/formula/formula_compiler.h"

namespace hoplab {
namespace {

using Op = FormulaStep::Op;

constexpr std::array kFunctions = {
    FormulaFunction{"sin", Op::kSin, 1, true},    FormulaFunction{"cos", Op::kCos, 1, true},
    FormulaFunction{"tan", Op::kTan, 1, true},    FormulaFunction{"exp", Op::kExp, 1, true},
    FormulaFunction{"log", Op::kLog, 1, true},    FormulaFunction{"tanh", Op::kTanh, 1, true},
    FormulaFunction{"sqrt", Op::kSqrt, 1, false}, FormulaFunction{"abs", Op::kAbs, 1, false},
    FormulaFunction{"sign", Op::kSign, 1, false}, FormulaFunction{"step", Op::kStep, 1, false},
    FormulaFunction{"max", Op::kMax, 2, false},   FormulaFunction{"min", Op::kMin, 2, false}};

}  // namespace

std::span<const FormulaFunction> AllFormulaFunctions() { return kFunctions; }
const FormulaFunction* FindFormulaFunction(std::string_view name) {
  for (const FormulaFunction& f : kFunctions)
    if (f.name == name) return &f;
  return nullptr;
}

FormulaCompiler::Known FormulaCompiler::Unary(const FormulaTree& t, Op op, const Known& a,
                                              const Unit& unit) {
  if (a.constant) return Folded(t, Op::kNegate == op ? -*a.constant : Apply(t, op, *a.constant), a);
  Known k = a;
  k.unit = unit;
  k.never_negative = false;
  k.key = std::string(NameOf(op)) + "(" + a.key + ")";
  k.step = Add(t, {op, Index(a)});
  return k;
}

FormulaCompiler::Known FormulaCompiler::Folded(const FormulaTree& t, double value,
                                               const Known& unit_of) {
  if (!std::isfinite(value)) Fail(t, "is no finite number", "Change the numbers it is made of.");
  Known k = Constant(t, value);
  k.unit = unit_of.unit;
  k.any_unit = value == 0.0;
  return k;
}

double FormulaCompiler::Apply(const FormulaTree&, Op op, double x) {
  switch (op) {
    case Op::kSin:
      return std::sin(x);
    case Op::kCos:
      return std::cos(x);
    case Op::kTan:
      return std::tan(x);
    case Op::kExp:
      return std::exp(x);
    case Op::kLog:
      return std::log(x);
    case Op::kSqrt:
      return std::sqrt(x);
    case Op::kTanh:
      return std::tanh(x);
    case Op::kAbs:
      return std::abs(x);
    case Op::kSign:
      return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
    case Op::kStep:
      return x > 0.0 ? 1.0 : x < 0.0 ? 0.0 : 0.5;
    default:
      return x;
  }
}

Unit FormulaCompiler::SameUnit(const FormulaTree& t, const Known& a, const Known& b,
                               const std::string& what) {
  if (a.any_unit) return b.unit;
  if (b.any_unit || a.unit == b.unit) return a.unit;
  throw FormulaError(
      t.at, t.at + 1,
      what + " " + TextOf(a.unit) + " on the left and " + TextOf(b.unit) + " on the right",
      "Both must have one unit: multiply one side by a parameter with the unit " +
          TextOf(a.unit / b.unit) + " or " + TextOf(b.unit / a.unit) + ".");
}

FormulaCompiler::Known FormulaCompiler::Sum(const FormulaTree& t) {
  const Known a = Compiled(t.arguments[0]), b = Compiled(t.arguments[1]);
  const bool plus = t.kind == Kind::kSum;
  Known k = Both(a, b);
  k.unit = SameUnit(t, a, b, plus ? "adds" : "subtracts");
  k.any_unit = a.any_unit && b.any_unit;
  k.never_negative = plus && a.never_negative && b.never_negative;
  k.usual = std::max(a.usual, b.usual);
  k.key = "(" + a.key + (plus ? "+" : "-") + b.key + ")";
  if (a.constant && b.constant)
    return Folded(t, plus ? *a.constant + *b.constant : *a.constant - *b.constant, k);
  if (b.constant)
    k.step = Add(t, {Op::kAddConstant, Index(a), -1, -1, plus ? *b.constant : -*b.constant});
  else
    k.step = Add(t, {plus ? Op::kAdd : Op::kSubtract, Index(a), Index(b)});
  return k;
}

FormulaCompiler::Known FormulaCompiler::Product(const FormulaTree& t) {
  const Known a = Compiled(t.arguments[0]), b = Compiled(t.arguments[1]);
  Known k = Both(a, b);
  k.unit = a.unit * b.unit;
  k.any_unit = a.any_unit || b.any_unit;
  k.never_negative = (a.never_negative && b.never_negative) || a.key == b.key;
  k.usual = a.usual * b.usual;
  k.key = a.key + "*" + b.key;
  if (a.constant && b.constant) return Folded(t, *a.constant * *b.constant, k);
  if (a.constant)
    k.step = Add(t, {Op::kScale, Index(b), -1, -1, *a.constant});
  else if (b.constant)
    k.step = Add(t, {Op::kScale, Index(a), -1, -1, *b.constant});
  else
    k.step = Add(t, {Op::kMultiply, Index(a), Index(b)});
  return k;
}

FormulaCompiler::Known FormulaCompiler::Quotient(const FormulaTree& t) {
  const Known a = Compiled(t.arguments[0]), b = Compiled(t.arguments[1]);
  if (b.constant && *b.constant == 0.0)
    Fail(t.arguments[1], "is zero, and stands below a division",
         "Divide by something else, or remove the division.");
  Known k = Both(a, b);
  k.unit = a.unit / b.unit;
  k.any_unit = a.any_unit;
  k.never_negative = a.never_negative && b.never_negative;
  k.usual = b.usual > 0.0 ? a.usual / b.usual : a.usual;
  k.key = a.key + "/(" + b.key + ")";
  if (a.constant && b.constant) return Folded(t, *a.constant / *b.constant, k);
  if (b.constant)
    k.step = Add(t, {Op::kScale, Index(a), -1, -1, 1.0 / *b.constant});
  else
    k.step = Add(t, {Op::kDivide, Index(a), Index(b)});
  return k;
}

FormulaCompiler::Known FormulaCompiler::Power(const FormulaTree& t) {
  const Known a = Compiled(t.arguments[0]), b = Compiled(t.arguments[1]);
  if (!b.unit.IsOne() && !b.any_unit)
    Fail(t.arguments[1], "is an exponent and has the unit " + TextOf(b.unit),
         "An exponent must be a plain number.");
  Known k = Both(a, b);
  k.key = "(" + a.key + ")^(" + b.key + ")";
  if (!b.constant) {
    if (!a.unit.IsOne())
      Fail(t.arguments[0], "has the unit " + TextOf(a.unit) + " and an exponent that may change",
           "Divide it by a parameter of that unit first, as (speed/v0)^p.");
    NeedsNeverNegative(t, a);
    k.unit = Unit::One();
    k.never_negative = a.never_negative;
    k.usual = 1.0;
    k.step = Add(t, {Op::kPower, Index(a), Index(b)});
    return k;
  }
  const double c = *b.constant;
  k.unit = a.unit.ToThe(c);
  k.usual = std::pow(a.usual, c);
  const bool whole = c == std::round(c) && std::abs(c) <= 12.0;
  const bool even = whole && std::fmod(c, 2.0) == 0.0;
  k.never_negative = a.never_negative || even;
  if (a.constant) return Folded(t, std::pow(*a.constant, c), k);
  if (whole) {
    k.step = Add(t, {Op::kIntegerPower, Index(a), static_cast<std::int16_t>(c)});
  } else {
    NeedsNeverNegative(t, a);
    k.step = Add(t, {Op::kConstantPower, Index(a), -1, -1, c});
  }
  return k;
}

void FormulaCompiler::NeedsNeverNegative(const FormulaTree& t, const Known& a) {
  if (a.never_negative) return;
  Fail(t.arguments[0], "may be negative, where a broken exponent means nothing",
       "Write abs(...)^p, with sign(...) in front of it if the direction matters.");
}

FormulaCompiler::Known FormulaCompiler::Call(const FormulaTree& t) {
  const FormulaFunction* f = FindFormulaFunction(t.name);
  if (f == nullptr) {
    const std::vector<std::string> own = Names();
    const bool is_name = std::find(own.begin(), own.end(), t.name) != own.end();
    std::vector<std::string> names;
    for (const FormulaFunction& known : AllFormulaFunctions()) names.emplace_back(known.name);
    throw FormulaError(
        t.begin, t.begin + t.name.size(),
        is_name ? t.name + " is no function" : "there is no function " + Printable(t.name),
        is_name ? "Write " + t.name + " * (...) if a product is meant."
                : DidYouMean(t.name, names));
  }
  if (static_cast<int>(t.arguments.size()) != f->arguments)
    Fail(t,
         t.name + " takes " + (f->arguments == 1 ? "one argument" : "two arguments") + " and has " +
             std::to_string(t.arguments.size()),
         f->arguments == 2 ? "Write " + t.name + "(a, b)." : "Write " + t.name + "(x).");
  const Known a = Compiled(t.arguments[0]);
  if (f->needs_number && !a.any_unit && !a.unit.IsOne())
    Fail(t.arguments[0],
         "has the unit " + TextOf(a.unit) + ", and " + t.name + " takes a plain number",
         "Divide it by a parameter of that unit, as tanh(vx/v0).");
  if (f->arguments == 2) return MaxOrMin(t, *f, a);
  switch (f->op) {
    case Op::kAbs:
    case Op::kSign:
    case Op::kStep: {
      if (a.constant) return Folded(t, Apply(t, f->op, *a.constant), NoUnitUnless(f->op, a));
      Known k = WithCorner(t, f->op, a, a.step, a.usual, f->op == Op::kAbs, a.key);
      k.unit = f->op == Op::kAbs ? a.unit : Unit::One();
      k.never_negative = f->op != Op::kSign;
      k.usual = f->op == Op::kAbs ? a.usual : 1.0;
      k.key = t.name + "(" + a.key + ")";
      return k;
    }
    case Op::kSqrt: {
      if (a.constant && *a.constant < 0.0)
        Fail(t.arguments[0], "is negative, and has no root", "Change its sign.");
      Known k = Unary(t, Op::kSqrt, a, a.unit.ToThe(0.5));
      k.usual = std::sqrt(a.usual);
      k.never_negative = true;
      return k;
    }
    default: {
      if (a.constant && f->op == Op::kLog && !(*a.constant > 0.0))
        Fail(t.arguments[0], "is not above zero, and has no logarithm", "Change the number.");
      if (!a.constant) to_.sharp_ = to_.sharp_ || f->op == Op::kTanh || f->op == Op::kExp;
      Known k = Unary(t, f->op, a, Unit::One());
      k.never_negative = f->op == Op::kExp;
      k.usual = 1.0;
      return k;
    }
  }
}

FormulaCompiler::Known FormulaCompiler::NoUnitUnless(Op op, const Known& a) {
  Known k = a;
  if (op != Op::kAbs) k.unit = Unit::One();
  return k;
}

FormulaCompiler::Known FormulaCompiler::MaxOrMin(const FormulaTree& t, const FormulaFunction& f,
                                                 const Known& a) {
  const Known b = Compiled(t.arguments[1]);
  Known k = Both(a, b);
  k.unit = SameUnit(t, a, b, t.name + " compares");
  k.any_unit = a.any_unit && b.any_unit;
  const bool max = f.op == Op::kMax;
  if (a.constant && b.constant)
    return Folded(t, max ? std::max(*a.constant, *b.constant) : std::min(*a.constant, *b.constant),
                  k);
  const double usual = std::max(a.usual, b.usual);
  // The difference is a step of its own, for its zero.
  const int difference = Add(t, {Op::kSubtract, Index(a), Index(b)});
  const std::string key = b.constant && *b.constant == 0.0 ? a.key : a.key + "-" + b.key;
  Known corner = WithCorner(t, f.op, k, difference, usual, true, key, Index(a), Index(b));
  corner.unit = k.unit;
  corner.any_unit = k.any_unit;
  corner.never_negative =
      max ? a.never_negative || b.never_negative : a.never_negative && b.never_negative;
  corner.usual = usual;
  corner.key = t.name + "(" + a.key + "," + b.key + ")";
  return corner;
}

}  // namespace hoplab
