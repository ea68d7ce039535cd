#include <algorithm>
#include <ostream>

#include "app/export/effect_code.h"
#include "app/records/effect_record.h"
#include "app/records/record_parts.h"
#include "app/reports/effect_catalogue.h"
#include "app/reports/effect_list.h"
#include "app/terminal/command.h"
#include "base/input_error.h"
#include "base/text.h"
#include "fitting/model_of_spec.h"

namespace hoplab {
namespace {

struct EffectsSettings {
  std::string name;  // empty: all
  std::string law;   // likewise
  bool markdown = false, code = false, json = false;
};

std::vector<const Effect*> Chosen(const EffectsSettings& settings) {
  if (!settings.name.empty()) return {&ResolveEffect(settings.name, "effects")};
  std::vector<const Effect*> chosen;
  for (const Effect* effect : AllEffects()) {
    const std::vector<Law> laws = LawsWith(*effect);
    const bool applies =
        std::any_of(laws.begin(), laws.end(), [&](Law law) { return NameOf(law) == settings.law; });
    if (settings.law.empty() || applies) chosen.push_back(effect);
  }
  return chosen;
}

// The formula of a file in C++.
std::string CodeOfFile(const Effect& effect, const std::string& given) {
  if (const FormulaSource* source = SourceOf(effect)) return EffectCodeOf(*source, given);
  throw InputError({"--code", given.empty() ? "" : Printable(given), "needs a file with a formula",
                    given.empty() ? "Name one: hoplab effects FILE --code."
                                  : "An effect of the catalogue is code: model/effects/" +
                                        std::string(effect.info.name) + ".cc."});
}

void CheckLaw(const std::string& name) {
  std::vector<std::string> known;
  for (const Law law : AllLaws()) known.emplace_back(NameOf(law));
  if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
  throw InputError({"--law", Printable(name), "is not a law", DidYouMean(name, known)});
}

ExitCode RunEffects(const EffectsSettings& settings, Console& console) {
  CheckLaw(settings.law);
  const std::vector<const Effect*> effects = Chosen(settings);
  if (settings.json) {
    RecordHeader header;
    header.command = "effects";
    if (!settings.law.empty()) header.law = settings.law;
    Json record = NewRecord(header);
    record["effects"] = Json::array();
    for (const Effect* effect : effects) {
      record["effects"].push_back(EffectRecord(*effect));
      if (effect->formula) record["effects"].back().update(FormulaRecord(*effect));
    }
    console.out << TextOf(record);
  } else if (settings.code) {
    console.out << CodeOfFile(*effects.front(), settings.name);
  } else if (settings.markdown) {
    console.out << EffectCatalogue(effects);
  } else if (settings.name.empty()) {
    console.out << EffectListText(effects, console.out_colours);
  } else {
    console.out << EffectText(*effects.front(), settings.name, console.out_colours);
  }
  return ExitCode::kDone;
}

void AddEffects(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<EffectsSettings>();
  sub.add_option("EFFECT", settings->name, "One effect in full, or a file with a formula: checked");
  sub.add_option("--law", settings->law, "Only those that go with this law")->option_text("LAW");
  sub.add_flag("--markdown", settings->markdown, "As a page of documentation (docs/effects.md)");
  sub.add_flag("--code", settings->code, "The formula of a file as a C++ effect");
  OnParsed(sub, invocation, settings, RunEffects);
}

}  // namespace

namespace commands {
extern constexpr Command effects = {
    .place = 180,
    .name = "effects",
    .what = "Physical effects that can be added to a model",
    .footer =
        "Examples:\n"
        "  hoplab effects --law consistent\n"
        "  hoplab effects air_drag\n"
        "  hoplab effects umbilical.yaml\n"
        "  hoplab effects umbilical.yaml --code > model/effects/umbilical.cc\n"
        "  hoplab effects --json",
    .add = AddEffects};
}  // namespace commands
}  // namespace hoplab
