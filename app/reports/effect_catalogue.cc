#include "app/reports/effect_catalogue.h"

#include <fmt/format.h>

#include "app/reports/effect_advice.h"
#include "app/reports/effect_words.h"
#include "base/text.h"

namespace hoplab {
namespace {

constexpr const char* kHead =
    "# Effects a simulation may lack\n\n"
    "Written by `hoplab effects --markdown` from the code (`model/effects`); a test holds the two "
    "together.\n"
    "Symbols and M-numbers are those of the [equation sheet](../model/README.md). At its null "
    "value "
    "an effect\n"
    "changes nothing, exactly. `hoplab explain EFFECT` says what to do about one, `--with EFFECT` "
    "fits it.\n"
    "A typical size is that on a body of 1 kg: forces, torques and masses grow with the body, "
    "compliances fall with it.\n";

std::string ParameterRows(const EffectInfo& info) {
  std::string text =
      "| parameter | unit | null | typical | from | to |\n|---|---|---|---|---|---|\n";
  for (const EffectParameter& p : info.parameters) {
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", p.name, p.unit, FormatDouble(p.null),
                        FormatDouble(p.typical), FormatDouble(p.lower), FormatDouble(p.upper));
  }
  return text;
}

std::string LawsText(const Effect& effect) {
  std::vector<std::string> names;
  for (const Law law : LawsWith(effect)) names.push_back("`" + std::string(NameOf(law)) + "`");
  return Join(names) + (effect.info.massless_leg_only ? "; not with a toe mass" : "") +
         (effect.info.needs_inputs != 0 ? "; where a logged column drives the run" : "") +
         PartOfText(effect);
}

std::string Section(const Effect& effect) {
  const EffectInfo& info = effect.info;
  std::string text =
      fmt::format("\n### {}\n\n{}\n\n    {}\n\n", info.name, SentenceOf(effect), info.equation) +
      ParameterRows(info) +
      fmt::format("\nLaws: {}. Energy: {}.\n", LawsText(effect),
                  info.dissipative ? "only ever taken away" : "may be put in or taken away");
  const EffectAdvice* advice = AdviceOn(info.name);
  if (!advice) return text;
  text += fmt::format("On the rig: {}\n", advice->check);
  if (!advice->look_alikes.empty())
    text += fmt::format("Moves four driven hops nearly as: {}.\n", advice->look_alikes);
  return text;
}

}  // namespace

std::string EffectCatalogue(const std::vector<const Effect*>& effects) {
  std::string text = kHead;
  for (const EffectKind kind : kEffectKinds) {
    std::string sections;
    for (const Effect* effect : effects) {
      if (effect->info.kind == kind) sections += Section(*effect);
    }
    if (!sections.empty()) text += fmt::format("\n## {}\n", TitleOf(kind)) + sections;
  }
  return text;
}

}  // namespace hoplab
