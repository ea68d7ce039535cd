#pragma once

#include <string>
#include <string_view>

#include "model/formula/formula.h"

namespace hoplab {

/// The function of a compiled effect in which a formula acts.
struct EffectHook {
  std::string_view signature;
  std::string before;      // lines ahead of the formula's value
  std::string_view after;  // lines with the value in place of `$`
};
EffectHook HookFor(const Formula& formula);

/// What the hook of a place calls a variable; empty if it does not know it.
std::string CodeOf(FormulaVariable variable, FormulaPlace place);

}  // namespace hoplab
