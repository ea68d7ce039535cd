#include "model/formula/formula.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "model/formula/formula_limits.h"

namespace hoplab {
namespace {

using Op = FormulaStep::Op;

// What a side of a corner is where no event watches it.
template <class T>
int Side(signed char side, const T& argument) {
  if (side != kFreeSide) return side;
  const double value = Value(argument);
  return value > 0.0 ? 1 : value < 0.0 ? -1 : 0;
}

// x^c, and where a step reaches beyond a corner its odd continuation; at zero with the slopes it
// has from above, infinite ones left out.
template <class T>
T PowerOf(const T& x, double c) {
  using std::pow;
  const double value = Value(x);
  if (value > 0.0) return pow(x, c);
  if (value < 0.0) return -pow(-x, c);
  return T(c > 0.0 ? 0.0 : c == 0.0 ? 1.0 : std::numeric_limits<double>::infinity());
}
template <class T>
T PowerBy(const T& x, const T& c) {
  using std::pow;
  const double value = Value(x);
  if (value > 0.0) return pow(x, c);
  if (value < 0.0) return -pow(-x, c);
  return PowerOf(T(0.0), Value(c));
}
template <class T>
T IntegerPower(const T& x, int n) {
  if (n < 0) return 1.0 / IntegerPower(x, -n);
  if (n == 0) return T(1.0);
  const T half = IntegerPower(x, n / 2);
  if (n == 1) return x;
  return n % 2 == 0 ? T(half * half) : T(half * half * x);
}
template <class T>
T RootOf(const T& x) {
  using std::sqrt;
  return Value(x) == 0.0 ? T(0.0) : sqrt(x);
}

// A sum, product or power, put to `to`; `b` where the step has a second argument.
template <class T>
void Calculate(const FormulaStep& s, const T& a, const T* b, T* to) {
  switch (s.op) {
    case Op::kAdd:
      new (to) T(a + *b);
      break;
    case Op::kSubtract:
      new (to) T(a - *b);
      break;
    case Op::kMultiply:
      new (to) T(a * *b);
      break;
    case Op::kDivide:
      new (to) T(a / *b);
      break;
    case Op::kNegate:
      new (to) T(-a);
      break;
    case Op::kAddConstant:
      new (to) T(a + s.constant);
      break;
    case Op::kScale:
      new (to) T(a * s.constant);
      break;
    case Op::kIntegerPower:
      new (to) T(IntegerPower(a, s.b));
      break;
    case Op::kConstantPower:
      new (to) T(PowerOf(a, s.constant));
      break;
    default:
      new (to) T(PowerBy(a, *b));
  }
}

// A function of one argument that is smooth.
template <class T>
void Apply(Op op, const T& a, T* to) {
  using std::cos;
  using std::exp;
  using std::log;
  using std::sin;
  using std::tan;
  using std::tanh;
  switch (op) {
    case Op::kSin:
      new (to) T(sin(a));
      break;
    case Op::kCos:
      new (to) T(cos(a));
      break;
    case Op::kTan:
      new (to) T(tan(a));
      break;
    case Op::kExp:
      new (to) T(exp(a));
      break;
    case Op::kLog:
      new (to) T(log(a));
      break;
    case Op::kSqrt:
      new (to) T(RootOf(a));
      break;
    default:
      new (to) T(tanh(a));
  }
}

// A function with a corner; `known` is the side of it where an event watches it.
template <class T>
void Turn(const FormulaStep& s, signed char known, const T& a, const T* b, T* to) {
  switch (s.op) {
    case Op::kAbs: {
      const int side = Side(known, a);
      new (to) T(side < 0 ? T(-a) : side > 0 ? a : T(0.0));
      break;
    }
    case Op::kSign:
      new (to) T(static_cast<double>(Side(known, a)));
      break;
    case Op::kStep:
      new (to) T(0.5 + 0.5 * Side(known, a));
      break;
    default: {
      const bool first = (Side(known, T(a - *b)) >= 0) == (s.op == Op::kMax);
      new (to) T(first ? a : *b);
    }
  }
}

}  // namespace

template <class T>
T Formula::Run(int last, const T* p, const FormulaView<T>& at, const CornerSides& sides) const {
  // Results of the steps; none has a destructor to call.
  alignas(T) std::byte room[kMostFormulaSteps * sizeof(T)];
  T* const r = reinterpret_cast<T*>(room);
  for (int i = 0; i <= last; ++i) {
    const FormulaStep& s = steps_[static_cast<std::size_t>(i)];
    if (s.op == Op::kConstant)
      new (r + i) T(s.constant);
    else if (s.op == Op::kParameter)
      new (r + i) T(p[s.a]);
    else if (s.op == Op::kVariable)
      new (r + i) T(*at[static_cast<std::size_t>(s.a)]);
    else if (s.op <= Op::kPower)
      Calculate(s, r[s.a], r + std::max<int>(s.b, 0), r + i);
    else if (s.op <= Op::kTanh)
      Apply(s.op, r[s.a], r + i);
    else
      Turn(s, sides[static_cast<std::size_t>(s.corner)], r[s.a], r + std::max<int>(s.b, 0), r + i);
  }
  return r[last];
}

template <class T>
T Formula::Evaluate(const T* p, const FormulaView<T>& at, const CornerSides& sides) const {
  return Run(result_, p, at, sides);
}
template <class T>
T Formula::CornerArgument(int corner, const T* p, const FormulaView<T>& at,
                          const CornerSides& sides) const {
  return Run(corners_[static_cast<std::size_t>(corner)].argument, p, at, sides);
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type.
#define HOPLAB_FORMULA_IN(T)                                                                   \
  template T Formula::Evaluate(const T*, const FormulaView<T>&, const CornerSides&) const;     \
  template T Formula::CornerArgument(int, const T*, const FormulaView<T>&, const CornerSides&) \
      const;
HOPLAB_FORMULA_IN(double)
HOPLAB_FORMULA_IN(Jet<1>)
HOPLAB_FORMULA_IN(Jet<kNarrowJet>)
HOPLAB_FORMULA_IN(Jet<kWideJet>)
HOPLAB_FORMULA_IN(Jet<kWidestJet>)
#undef HOPLAB_FORMULA_IN
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace hoplab
