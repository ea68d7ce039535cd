#include "app/reports/effect_words.h"

#include <cctype>

#include "base/text.h"

namespace hoplab {

std::string_view TitleOf(EffectKind kind) {
  switch (kind) {
    case EffectKind::kForce:
      return "Forces, torques and impacts";
    case EffectKind::kParameter:
      return "The mechanism and what it stands on";
    case EffectKind::kGuard:
      return "When contact begins";
    case EffectKind::kObservation:
      return "What the sensors report";
  }
  return "";
}

std::string SentenceOf(const Effect& effect) {
  std::string text(effect.info.sentence);
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ".";
}

std::string RestrictionOf(const Effect& effect) {
  const EffectInfo& info = effect.info;
  if (!info.only_laws.empty()) {
    std::vector<std::string> names;
    for (const Law law : info.only_laws) names.emplace_back(NameOf(law));
    return (names.size() == 1 ? "law " : "laws ") + Join(names) +
           (info.massless_leg_only ? ", massless" : "");
  }
  if (info.needs_inputs != 0) return "what a log drives";
  if (info.for_legs && info.for_ball) return "";
  if (info.massless_leg_only) return "massless legs only";
  if (info.for_robot && !info.for_legs && !info.for_ball) return "robot only";
  return info.for_legs ? "legs only" : "ball only";
}

std::string PartOfText(const Effect& effect) {
  std::vector<std::string> names;
  for (const Law law : effect.info.part_of) names.emplace_back(NameOf(law));
  return names.empty() ? ""
                       : "; part of " + Join(names) + ", where it is not tried and 0 takes it away";
}

}  // namespace hoplab
