#include <ostream>

#include "app/export/effect_code.h"
#include "app/records/effect_record.h"
#include "app/reports/effect_catalogue.h"
#include "app/reports/effect_list.h"
#include "app/terminal/command.h"
#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

struct EffectsSettings {
  std::string name;  // empty: all
  std::string law;   // likewise
  bool markdown = false, code = false, json = false;
};

// The formula of a file in C++.
std::string CodeOfFile(const Effect& effect, const std::string& given) {
  if (const FormulaSource* source = SourceOf(effect)) return EffectCodeOf(*source, given);
  throw InputError({"--code", given.empty() ? "" : Printable(given), "needs a file with a formula",
                    given.empty() ? "Name one: hoplab effects FILE --code."
                                  : "An effect of the catalogue is code: model/effects/" +
                                        std::string(effect.info.name) + ".cc."});
}

ExitCode RunEffects(const EffectsSettings& settings, Console& console) {
  const std::vector<const Effect*> effects = ChosenEffects(settings.name, settings.law);
  if (settings.json) {
    console.out << TextOf(EffectsRecord(effects, settings.law));
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
