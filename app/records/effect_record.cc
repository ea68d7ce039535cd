#include "app/records/effect_record.h"

#include <algorithm>

#include "app/records/record_parts.h"
#include "base/input_error.h"
#include "base/text.h"
#include "fitting/model_of_spec.h"

namespace hoplab {
namespace {

void CheckLaw(const std::string& name) {
  std::vector<std::string> known;
  for (const Law law : AllLaws()) known.emplace_back(NameOf(law));
  if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
  throw InputError({"--law", Printable(name), "is not a law", DidYouMean(name, known)});
}

}  // namespace

std::vector<Law> AllLaws() {
  std::vector<Law> laws;
  for (const MechanismKind mechanism : kMechanisms) {
    const std::span<const Law> of = LawsOf(mechanism);
    laws.insert(laws.end(), of.begin(), of.end());
  }
  return laws;
}

std::vector<Law> LawsWith(const Effect& effect) {
  std::vector<Law> laws = AllLaws();
  std::erase_if(laws, [&](Law law) {
    const auto applies = [&](RobotLegs legs) {
      return AppliesTo(effect, law, LegMass::kNone, kEveryInput, legs);
    };
    return !applies({}) && !applies({kMaxLegs, /*are_straight=*/true});
  });
  return laws;
}

Json EffectRecord(const Effect& effect) {
  Json parameters = Json::array();
  for (const EffectParameter& p : effect.info.parameters) {
    parameters.push_back({{"name", p.name},
                          {"unit", p.unit},
                          {"null", p.null},
                          {"bounds", Json::array({NumberOrNull(p.lower), NumberOrNull(p.upper)})},
                          {"typical", p.typical}});
  }
  Json mechanisms = Json::array(), laws = Json::array();
  for (const Law law : LawsWith(effect)) {
    laws.push_back(NameOf(law));
    const Json mechanism = NameOf(MechanismOf(law));
    if (std::find(mechanisms.begin(), mechanisms.end(), mechanism) == mechanisms.end())
      mechanisms.push_back(mechanism);
  }
  Json part_of = Json::array();
  for (const Law law : effect.info.part_of) part_of.push_back(NameOf(law));
  return {{"name", effect.info.name},
          {"kind", NameOf(effect.info.kind)},
          {"equation", effect.info.equation},
          {"sentence", effect.info.sentence},
          {"mechanisms", mechanisms},
          {"laws", laws},
          {"part_of", part_of},
          {"massless_leg_only", effect.info.massless_leg_only},
          {"dissipative", effect.info.dissipative},
          {"parameters", parameters}};
}

std::vector<const Effect*> ChosenEffects(const std::string& name, const std::string& law) {
  CheckLaw(law);
  if (!name.empty()) return {&ResolveEffect(name, "effects")};
  std::vector<const Effect*> chosen;
  for (const Effect* effect : AllEffects()) {
    const std::vector<Law> laws = LawsWith(*effect);
    const bool applies =
        std::any_of(laws.begin(), laws.end(), [&](Law of) { return NameOf(of) == law; });
    if (law.empty() || applies) chosen.push_back(effect);
  }
  return chosen;
}

Json EffectsRecord(const std::vector<const Effect*>& effects, const std::string& law) {
  RecordHeader header;
  header.command = "effects";
  if (!law.empty()) header.law = law;
  Json record = NewRecord(header);
  record["effects"] = Json::array();
  for (const Effect* effect : effects) {
    record["effects"].push_back(EffectRecord(*effect));
    if (effect->formula) record["effects"].back().update(FormulaRecord(*effect));
  }
  return record;
}

}  // namespace hoplab
