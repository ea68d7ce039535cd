#include "app/commands/effects.h"

#include <ostream>

#include "app/run_record.h"
#include "base/text.h"
#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct EffectsSettings {
  bool json = false;
};

Json RecordOf(const Effect& effect) {
  Json parameters = Json::array();
  for (const EffectParameter& p : effect.info.parameters) {
    parameters.push_back({{"name", p.name},
                          {"unit", p.unit},
                          {"null", p.null},
                          {"bounds", Json::array({NumberOrNull(p.lower), NumberOrNull(p.upper)})},
                          {"typical", p.typical}});
  }
  Json mechanisms = Json::array(), laws = Json::array();
  for (MechanismKind mechanism :
       {MechanismKind::kCLeg, MechanismKind::kStraightLeg, MechanismKind::kBall}) {
    const std::size_t before = laws.size();
    for (Law law : LawsOf(mechanism)) {
      if (AppliesTo(effect, law)) laws.push_back(NameOf(law));
    }
    if (laws.size() > before) mechanisms.push_back(NameOf(mechanism));
  }
  return {{"name", effect.info.name},
          {"kind", NameOf(effect.info.kind)},
          {"equation", effect.info.equation},
          {"sentence", effect.info.sentence},
          {"mechanisms", mechanisms},
          {"laws", laws},
          {"dissipative", effect.info.dissipative},
          {"parameters", parameters}};
}

void PrintEffect(const EffectInfo& info, Console& console) {
  std::string whom = info.for_legs && info.for_ball ? "legs and ball"
                     : info.for_legs                ? "legs"
                                                    : "ball";
  if (!info.only_laws.empty()) {
    whom = "law";
    const char* separator = " ";
    for (Law law : info.only_laws) {
      whom += separator + std::string(NameOf(law));
      separator = ", ";
    }
  }
  console.out << Styled(info.name, Emphasis::kBold, console.out_colours) << "  "
              << NameOf(info.kind) << ", " << whom << ": " << info.sentence << "\n  "
              << info.equation << '\n';
  for (const EffectParameter& p : info.parameters) {
    console.out << "  " << p.name;
    if (p.unit != "-") console.out << " [" << p.unit << ']';
    console.out << ": null " << FormatDouble(p.null) << ", typical " << FormatDouble(p.typical)
                << ", from " << FormatDouble(p.lower) << " to " << FormatDouble(p.upper) << '\n';
  }
}

ExitCode RunEffects(const EffectsSettings& settings, Console& console) {
  if (settings.json) {
    RecordHeader header;
    header.command = "effects";
    Json record = NewRecord(header);
    record["effects"] = Json::array();
    for (const Effect* effect : AllEffects()) record["effects"].push_back(RecordOf(*effect));
    console.out << TextOf(record);
    return ExitCode::kDone;
  }
  for (const Effect* effect : AllEffects()) PrintEffect(effect->info, console);
  return ExitCode::kDone;
}

}  // namespace

void AddEffectsCommand(CLI::App& app, Invocation& invocation) {
  CLI::App& sub = *app.add_subcommand("effects", "Physical effects that can be added to a model");
  sub.footer("Example:\n  hoplab effects --json");
  OnParsed(sub, invocation, std::make_shared<EffectsSettings>(), RunEffects);
}

}  // namespace hoplab
