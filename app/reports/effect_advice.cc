#include "app/reports/effect_advice.h"

#include <algorithm>

#include "app/reports/text_entries.h"

namespace hoplab {
namespace {

constexpr std::string_view kAdviceKeys[] = {"effect", "check", "look_alikes"};

std::vector<EffectAdvice> ReadAdvice() {
  std::vector<EffectAdvice> advice;
  for (const TextEntry& e : EntriesOf("effects.txt", kAdviceKeys))
    advice.push_back({e[0], e[1], e[2]});
  return advice;
}

}  // namespace

const std::vector<EffectAdvice>& AllAdvice() {
  static const std::vector<EffectAdvice> kAdvice = ReadAdvice();
  return kAdvice;
}

const EffectAdvice* AdviceOn(std::string_view effect) {
  const std::vector<EffectAdvice>& all = AllAdvice();
  const auto found = std::find_if(all.begin(), all.end(), [effect](const EffectAdvice& advice) {
    return advice.effect == effect;
  });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace hoplab
