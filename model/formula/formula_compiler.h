#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/formula/formula.h"

namespace hoplab {

/// A function of a formula.
struct FormulaFunction {
  std::string_view name;
  FormulaStep::Op op;
  int arguments;
  bool needs_number;  // its argument has no unit
};
const FormulaFunction* FindFormulaFunction(std::string_view name);
std::span<const FormulaFunction> AllFormulaFunctions();

/// Turns a tree into steps; units are checked on the way. Throws FormulaError.
class FormulaCompiler {
 public:
  FormulaCompiler(const FormulaSource& source, Formula& to)
      : source_(source), to_(to), place_(InfoOf(to.place_)) {
    for (std::size_t i = 0; i < source.parameters.size(); ++i)
      parameter_units_.push_back(UnitOf(static_cast<int>(i)));
  }

  void Compile();

 private:
  using Op = FormulaStep::Op;
  using Kind = FormulaTree::Kind;

  // What is known of a step while the formula is put together.
  struct Known {
    int step = -1;
    Unit unit;
    bool any_unit = false;           // zero, of whatever it stands beside
    std::optional<double> constant;  // it is one
    bool never_negative = false;
    double usual = 1.0;  // its size in a hop
    bool of_time = false, of_parameter = false;
    std::string key;  // its text in one spelling
  };

  Unit UnitOf(int parameter) const;

  [[noreturn]] static void Fail(const FormulaTree& at, const std::string& rule,
                                const std::string& remedy);

  Known Compiled(const FormulaTree& t);

  // ---- leaves -------------------------------------------------------------------------------

  Known Number(const FormulaTree& t);
  Known Constant(const FormulaTree& t, double value);

  Known Name(const FormulaTree& t);
  Known Parameter(const FormulaTree& t, int i);
  Known Variable(const FormulaTree& t, const VariableInfo& v);
  // 1 while the chord shortens: step(-rate).
  Known Loading(const FormulaTree& t);

  std::vector<std::string> Names() const;
  std::string VariableNames() const;

  // ---- operations ---------------------------------------------------------------------------

  Known Unary(const FormulaTree& t, Op op, const Known& a, const Unit& unit);
  Known Folded(const FormulaTree& t, double value, const Known& unit_of);
  static double Apply(const FormulaTree&, Op op, double x);

  // Both sides of a sum, of the two of max and min: one unit.
  Unit SameUnit(const FormulaTree& t, const Known& a, const Known& b, const std::string& what);

  Known Sum(const FormulaTree& t);
  Known Product(const FormulaTree& t);
  Known Quotient(const FormulaTree& t);

  Known Power(const FormulaTree& t);
  void NeedsNeverNegative(const FormulaTree& t, const Known& a);

  Known Call(const FormulaTree& t);
  static Known NoUnitUnless(Op op, const Known& a);

  Known MaxOrMin(const FormulaTree& t, const FormulaFunction& f, const Known& a);

  // ---- steps --------------------------------------------------------------------------------

  Known WithCorner(const FormulaTree& t, Op op, const Known& of, int argument, double usual,
                   bool smooth, const std::string& key, int a = -1, int b = -1);
  // Names mean one thing among body forces, another along the chord.
  std::string CornerFamily() const;

  static Known Both(const Known& a, const Known& b);
  static std::int16_t Index(const Known& k);

  // The step, or an earlier one that does the same.
  int Add(const FormulaTree& t, const FormulaStep& step);
  static std::string_view NameOf(Op op);

  static bool TakesSteps(Op op);
  static bool TakesTwo(Op op);
  // What neither the result nor a corner is made of: numbers that went into other steps.
  void RemoveUnusedSteps();

  void CheckEveryParameterIsUsed() const;

  const FormulaSource& source_;
  Formula& to_;
  const PlaceInfo& place_;
  std::vector<Unit> parameter_units_;
  std::vector<int> used_;
};

}  // namespace hoplab
