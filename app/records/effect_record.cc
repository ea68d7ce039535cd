#include "app/records/effect_record.h"

#include <algorithm>

namespace hoplab {

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
  std::erase_if(laws,
                [&](Law law) { return !AppliesTo(effect, law, LegMass::kNone, kEveryInput); });
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
  return {{"name", effect.info.name},
          {"kind", NameOf(effect.info.kind)},
          {"equation", effect.info.equation},
          {"sentence", effect.info.sentence},
          {"mechanisms", mechanisms},
          {"laws", laws},
          {"massless_leg_only", effect.info.massless_leg_only},
          {"dissipative", effect.info.dissipative},
          {"parameters", parameters}};
}

}  // namespace hoplab
