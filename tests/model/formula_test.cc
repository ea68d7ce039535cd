#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "tests/support/formulas.h"

namespace hoplab {
namespace {

using namespace testing;
using V = FormulaVariable;

// ---- values ------------------------------------------------------------------------------------

// A formula of plain numbers, of x and y in parts of a metre.
double At(const std::string& text, double x = 0.0, double y = 0.0) {
  const FormulaSource source =
      Source("body_force_x", "f * (" + text + ")",
             {Factor("f", "N", 0.0, 2.0, 1.0), Shape("m1", "m", 1.0, 0.5, 2.0)});
  const Formula formula([&] {
    FormulaSource s = source;
    s.formula += " + 0 * f * m1/m1";
    return s;
  }());
  const std::array<double, 6> p = {1.0, 1.0};
  FormulaView<double> view{};
  view[static_cast<std::size_t>(V::kX)] = &x;
  view[static_cast<std::size_t>(V::kY)] = &y;
  CornerSides sides;
  sides.fill(kFreeSide);
  return formula.Evaluate(p.data(), view, sides);
}

TEST(Formula, OperatorsBindAsInMathematics) {
  EXPECT_EQ(At("1 + 2 * 3"), 7.0);
  EXPECT_EQ(At("(1 + 2) * 3"), 9.0);
  EXPECT_EQ(At("-2^2"), -4.0);
  EXPECT_EQ(At("2^-1"), 0.5);
  EXPECT_EQ(At("2^3^2"), 512.0);
  EXPECT_EQ(At("8/4/2"), 1.0);
  EXPECT_EQ(At("1 - 2 - 3"), -4.0);
  EXPECT_EQ(At("2 * -3"), -6.0);
  EXPECT_EQ(At("+1.5e1 - .5"), 14.5);
}

TEST(Formula, FunctionsAreTheirOwn) {
  const double x = 0.37;
  EXPECT_DOUBLE_EQ(At("sin(x/m1)", x), std::sin(x));
  EXPECT_DOUBLE_EQ(At("cos(x/m1)", x), std::cos(x));
  EXPECT_DOUBLE_EQ(At("tan(x/m1)", x), std::tan(x));
  EXPECT_DOUBLE_EQ(At("exp(x/m1)", x), std::exp(x));
  EXPECT_DOUBLE_EQ(At("log(x/m1)", x), std::log(x));
  EXPECT_DOUBLE_EQ(At("sqrt(x/m1)", x), std::sqrt(x));
  EXPECT_DOUBLE_EQ(At("tanh(x/m1)", x), std::tanh(x));
  EXPECT_DOUBLE_EQ(At("abs(x/m1)", -x), x);
  EXPECT_DOUBLE_EQ(At("sign(x)", -x), -1.0);
  EXPECT_DOUBLE_EQ(At("step(x)", -x), 0.0);
  EXPECT_DOUBLE_EQ(At("step(x)", x), 1.0);
  EXPECT_DOUBLE_EQ(At("max(x, y)/m1", x, 0.1), x);
  EXPECT_DOUBLE_EQ(At("min(x, y)/m1", x, 0.1), 0.1);
  EXPECT_DOUBLE_EQ(At("max(x - m1, 0)/m1", x), 0.0);
  EXPECT_DOUBLE_EQ(At("(abs(x)/m1)^1.5", -x), std::pow(x, 1.5));
  EXPECT_DOUBLE_EQ(At("(x/m1)^3", -x), -x * x * x);
  EXPECT_DOUBLE_EQ(At("cos(pi)"), -1.0);
}

// ---- units -------------------------------------------------------------------------------------

TEST(Unit, ReadsWhatTheCatalogueWrites) {
  for (const char* text : {"N", "N/m", "N s/m", "N s^2/m^2", "m/(N s)", "rad s/m", "1/s", "N m",
                           "kg", "kg m/s^2", "N m s/rad", "-", "1", "Pa", "m/s"})
    EXPECT_TRUE(ParseUnit(text)) << text;
  for (const char* text : {"", "mm", "N s/", "furlong", "N^", "(N", "N)", "m**2", "deg", "ms"})
    EXPECT_FALSE(ParseUnit(text)) << text;
  EXPECT_EQ(*ParseUnit("N"), *ParseUnit("kg m/s^2"));
  EXPECT_EQ(*ParseUnit("Pa m^2"), *ParseUnit("N"));
  EXPECT_EQ(*ParseUnit("m/(N s)"), *ParseUnit("s/kg"));
  EXPECT_FALSE(*ParseUnit("N/m s") == *ParseUnit("N/(m s)"));
}

TEST(Unit, WritesWhatItReads) {
  for (const char* text : {"N", "N/m", "N s/m", "N s^2/m^2", "m/s", "1/s", "N m", "-", "m^0.5"}) {
    EXPECT_EQ(TextOf(*ParseUnit(text)), text);
    EXPECT_EQ(*ParseUnit(TextOf(*ParseUnit(text))), *ParseUnit(text)) << text;
  }
}

TEST(Formula, EveryPlaceAndVariableHasAUnit) {
  for (const PlaceInfo& place : AllPlaces()) {
    EXPECT_TRUE(ParseUnit(place.unit)) << place.name;
    for (const VariableInfo& v : place.variables) EXPECT_TRUE(ParseUnit(v.unit)) << v.name;
    EXPECT_EQ(FindPlace(place.name), &InfoOf(place.place));
  }
}

// ---- what is wrong, where, and what to do -------------------------------------------------------

struct Bad {
  std::string what;
  FormulaSource source;
  std::string marked;  // what the caret stands under; empty: not in the formula
  std::string rule, remedy;
};
void PrintTo(const Bad& c, std::ostream* out) { *out << c.what; }

std::vector<Bad> BadFormulas() {
  const auto c = Factor("c", "N s/m", 0.0, 10.0, 0.1);
  const auto formula = [&](const std::string& text) { return Source("body_force_x", text, {c}); };
  std::string deep = "c * vx";
  for (int i = 0; i < 60; ++i) deep = "(" + deep + ")";
  FormulaSource no_null = Source("body_force_x", "k * x", {Shape("k", "N/m", 1.0, 0.0, 2.0)});
  FormulaSource no_unit = Source("body_force_x", "c * vx", {Factor("c", "", 0.0, 1.0, 0.1)});
  FormulaSource prefix = Source("body_force_x", "c * vx", {Factor("c", "mN s", 0.0, 1.0, 0.1)});
  FormulaSource bounds = Source("body_force_x", "c * vx", {Factor("c", "N s/m", 1.0, 0.0, 0.1)});
  FormulaSource both = formula("c * vx");
  both.parameters[0].value = 1.0;
  FormulaSource many = formula("c * vx");
  for (int i = 0; i < 7; ++i)
    many.parameters.push_back(Factor("c" + std::to_string(i), "N", 0.0, 1.0, 0.1));
  return {
      {"empty", formula("  "), "", "is empty", "Write one"},
      {"unknown_name", formula("-c * vz"), "vz", "neither a parameter", "vx"},
      {"unknown_function", formula("c * sgn(vx) * vx"), "sgn", "no function", "Did you mean"},
      {"other_place", formula("-c * rate"), "rate", "not known to a body_force_x", "chord_force"},
      {"wrong_unit", formula("-c * x"), "-c * x", "N s", "Multiply"},
      {"sum_of_units", formula("-c * (vx + x)"), "+", "adds m/s on the left and m on the right",
       "multiply one side"},
      {"open_parenthesis", formula("-c * max(vx, 0"), " ", ")", "opened and not closed"},
      {"closed_too_often", formula("-c * vx)"), ")", "never opened", "Remove"},
      {"missing_operand", formula("-c * vx *"), " ", "a number, a name or (", "Complete"},
      {"two_operators", formula("-c * / vx"), "/", "a number, a name or (", "Write"},
      {"missing_operator", formula("-c vx"), "v", "an operator", "Write"},
      {"strange_character", formula("-c * vx $ 2"), "$", "no meaning", "Use numbers"},
      {"division_by_zero", formula("-c * vx / (1 - 1)"), "1 - 1", "is zero", "Divide"},
      {"exponent_with_unit", formula("-c * vx^(x)"), "x", "exponent", "plain number"},
      {"broken_exponent", formula("-c * vx * (vy/speed)^0.5"), "vy/speed", "may be negative",
       "abs"},
      {"sine_of_a_length", formula("-c * vx * sin(x)"), "x", "plain number", "Divide it"},
      {"arguments", formula("-c * max(vx)"), "max(vx)", "two arguments", "max(a, b)"},
      {"function_without", formula("-c * vx * abs"), "abs", "no argument", "abs(x)"},
      {"too_deep", formula(deep), "(", "nested deeper", "Remove parentheses"},
      {"a_megabyte", formula(std::string(1 << 20, '1')), "", "characters", "Split"},
      {"five_corners", formula("-c*(abs(vx)+abs(vy)+abs(vx-vy)+abs(vx+vy)+abs(2*vx+vy))"),
       "abs(2*vx+vy)", "fifth corner", "tanh"},
      {"corner_in_time",
       Source("reading_x", "o * step(t - t0)",
              {Factor("o", "m", -1., 1., 0.1), Shape("t0", "s", 0.5, 0., 1.)}),
       "step(t - t0)", "at an instant", "tanh"},
      {"there_without_asking",
       Source("body_force_x", "k * x + 0 * c * vx", {c, Shape("k", "N/m", 1.0, 0.0, 2.0)}), "",
       "where its parameters are at null", "multiply"},
      {"no_null", no_null, "", "no parameter with a null", "null: 0"},
      {"no_unit", no_unit, "", "has the unit (none)", "N s/m"},
      {"unit_with_prefix", prefix, "", "mN s", "no prefixes"},
      {"bounds", bounds, "", "leave nothing", "lower must be below"},
      {"null_and_value", both, "", "both a null and a value", "Give null"},
      {"too_many_parameters", many, "", "there may be 6", "Write numbers"},
      {"unused_parameter", Source("body_force_x", "c * vx", {c, Shape("k", "N/m", 1.0, 0.0, 2.0)}),
       "", "does not occur", "remove"},
      {"parameter_like_a_variable",
       Source("body_force_x", "vx", {Factor("vx", "N", 0.0, 1.0, 0.1)}), "", "variable",
       "otherwise"},
      {"no_such_place", Source("body_force_z", "c * vx", {c}), "", "no place", "body_force_x"},
      {"name_of_the_catalogue", Source("body_force_x", "c * vx", {c}, "air_drag"), "",
       "effect of the catalogue", "otherwise"},
      {"no_name", Source("body_force_x", "c * vx", {c}, "my effect"), "", "no name of an effect",
       "letters"},
      {"huge_number", formula("1e999 * c * vx"), "1e999", "finite", "double"},
      {"root_of_a_negative", formula("c * vx * sqrt(-2)"), "-2", "no root", "sign"},
      {"ball_place", Source("restitution", "c * vx", {c}), "vx", "not known", "speed"}};
}

class BadFormula : public ::testing::TestWithParam<Bad> {};

TEST_P(BadFormula, IsToldWithPlaceRuleAndRemedy) {
  const Bad& bad = GetParam();
  try {
    FormulaEffect(bad.source);
    FAIL() << "was taken";
  } catch (const FormulaError& e) {
    EXPECT_NE(e.rule().find(bad.rule), std::string::npos) << e.rule();
    EXPECT_NE(e.remedy().find(bad.remedy), std::string::npos) << e.remedy();
    if (bad.marked.empty()) return;
    const std::string text = bad.source.formula + " ";
    EXPECT_EQ(text.substr(e.begin(), e.end() - e.begin()), bad.marked);
    const std::string picture = e.Picture(bad.source.formula);
    EXPECT_EQ(picture.substr(picture.find('\n')).find('^'), e.begin() + 5) << picture;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, BadFormula, ::testing::ValuesIn(BadFormulas()),
                         [](const auto& info) { return info.param.what; });

// ---- anything at all ---------------------------------------------------------------------------

// Texts made of the grammar's own pieces and of noise are either taken, and then evaluate without
// reading what is not theirs, or refused with a place inside the text.
TEST(Formula, AnyTextIsTakenOrRefused) {
  const std::vector<std::string> pieces = {
      "c", "vx",    "vy", "x",     "speed", "t", "in_stance", "sin(", "abs(", "max(", "step(",
      ")", ",",     "+",  "-",     "*",     "/", "^",         "2",    "0.5",  "1e3",  "(",
      " ", "sqrt(", "pi", "tanh(", "..",    "e", "\xc3\xa9",  "@",    "\n",   "0",    "sign("};
  RandomStream random(7, 3);
  int taken = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const auto length = static_cast<int>(random.Uniform(1.0, 14.0));
    std::string text = trial % 3 == 0 ? "c * vx * (" : "";
    for (int i = 0; i < length; ++i)
      text += pieces[static_cast<std::size_t>(
          random.Uniform(0.0, static_cast<double>(pieces.size()) - 1e-9))];
    if (trial % 3 == 0) text += ")";
    try {
      const Formula formula(Source("body_force_x", text, {Factor("c", "N s/m", 0.0, 10.0, 0.1)}));
      ++taken;
      std::array<double, kFormulaVariables> values;
      values.fill(0.7);
      FormulaView<double> view{};
      for (std::size_t i = 0; i < values.size(); ++i) view[i] = &values[i];
      const std::array<double, kMaxEffectParameters> p = {0.3};
      CornerSides sides;
      sides.fill(kFreeSide);
      formula.Evaluate(p.data(), view, sides);
    } catch (const FormulaError& e) {
      EXPECT_LE(e.begin(), text.size()) << text;
      EXPECT_FALSE(e.rule().empty());
      EXPECT_FALSE(e.remedy().empty()) << text << ": " << e.rule();
    }
  }
  EXPECT_GT(taken, 20);
}

}  // namespace
}  // namespace hoplab
