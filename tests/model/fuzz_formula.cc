#include <cstddef>
#include <cstdint>

#include "tests/support/formulas.h"

// libFuzzer's entry: any text is a formula that evaluates, or a FormulaError.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hoplab;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const Formula formula(
        testing::Source("body_force_x", text, {testing::Factor("c", "N s/m", 0.0, 10.0, 0.1)}));
    std::array<double, kFormulaVariables> values;
    values.fill(0.7);
    FormulaView<double> view{};
    for (std::size_t i = 0; i < values.size(); ++i) view[i] = &values[i];
    const std::array<double, kMaxEffectParameters> p = {0.3};
    CornerSides sides;
    sides.fill(kFreeSide);
    formula.Evaluate(p.data(), view, sides);
  } catch (const FormulaError&) {
  }
  return 0;
}
