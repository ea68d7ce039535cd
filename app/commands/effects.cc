#include <algorithm>
#include <ostream>

#include "app/export/effect_code.h"
#include "app/records/formula_words.h"
#include "app/records/record_parts.h"
#include "app/records/run_record.h"
#include "app/reports/effect_catalogue.h"
#include "app/reports/effect_words.h"
#include "app/terminal/command.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "app/terminal/text_table.h"
#include "base/input_error.h"
#include "base/text.h"
#include "fitting/model_of_spec.h"
#include "model/effects/effect.h"

namespace hoplab {
namespace {

struct EffectsSettings {
  std::string name;  // empty: all
  std::string law;   // likewise
  bool markdown = false, code = false, json = false;
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

std::string Quantity(double value, const EffectParameter& p) {
  const ReadableUnit unit = ReadableUnitOf(value, std::string(p.unit));
  return FormatDouble(value * unit.factor) + (unit.unit.empty() ? "" : " " + unit.unit);
}

// Two lines an effect: name, parameters with their typical sizes, restriction; what it is.
void PrintList(const std::vector<const Effect*>& effects, Console& console) {
  using enum TextTable::Align;
  for (const EffectKind kind : kEffectKinds) {
    TextTable table({kLeft, kLeft, kLeft});
    table.AddRow({"effect", "parameter, typical size", "goes with"});
    std::vector<const Effect*> rows;
    for (const Effect* e : effects) {
      if (e->info.kind != kind) continue;
      std::vector<std::string> parameters;
      for (const EffectParameter& p : e->info.parameters)
        parameters.push_back(std::string(p.name) + " " + Quantity(p.typical, p));
      table.AddRow({std::string(e->info.name), Join(parameters), RestrictionOf(*e)});
      rows.push_back(e);
    }
    if (rows.empty()) continue;
    const std::vector<std::string> lines = table.Lines();
    console.out << Styled(TitleOf(kind), Emphasis::kBold, console.out_colours) << '\n';
    for (std::size_t i = 0; i < rows.size(); ++i) {
      console.out << lines[i + 1] << "\n      "
                  << Styled(Wrapped(std::string(rows[i]->info.sentence), 6), Emphasis::kFaint,
                            console.out_colours)
                  << '\n';
    }
    console.out << '\n';
  }
  console.out << Plural(static_cast<long>(effects.size()), "effect")
              << "; hoplab effects EFFECT says more of one\n";
}

// `given`: the effect as it was asked for, by name or file.
void PrintOne(const Effect& effect, const std::string& given, Console& console) {
  const EffectInfo& info = effect.info;
  const bool colours = console.out_colours;
  console.out << Styled(info.name, Emphasis::kBold, colours) << "  " << NameOf(info.kind)
              << "\n\n  " << Wrapped(std::string(info.sentence), 2) << "\n\n"
              << (effect.formula ? FormulaExplained(effect, colours)
                                 : Labelled("equation", std::string(info.equation), colours));
  for (const EffectParameter& p : info.parameters) {
    console.out << Labelled(
        std::string(p.name),
        (p.unit == "-" ? "" : "[" + std::string(p.unit) + "] ") +
            (p.is_shape ? "held at " : "no effect at ") + FormatDouble(p.null) +
            (p.is_shape ? " unless freed by name" : ", typical " + FormatDouble(p.typical)) +
            ", from " + FormatDouble(p.lower) + " to " + FormatDouble(p.upper),
        colours);
  }
  std::vector<std::string> laws;
  for (const Law law : LawsWith(effect)) laws.emplace_back(NameOf(law));
  console.out << Labelled("laws",
                          Join(laws) + (info.massless_leg_only ? "; not with a toe mass" : ""),
                          colours)
              << Labelled("energy",
                          info.dissipative ? "only ever taken away" : "may be put in or taken away",
                          colours)
              << Labelled("fit it", "hoplab fit DATASET --with " + given, colours);
}

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
      record["effects"].push_back(RecordOf(*effect));
      if (effect->formula) record["effects"].back().update(FormulaRecord(*effect));
    }
    console.out << TextOf(record);
  } else if (settings.code) {
    console.out << CodeOfFile(*effects.front(), settings.name);
  } else if (settings.markdown) {
    console.out << EffectCatalogue(effects);
  } else if (settings.name.empty()) {
    PrintList(effects, console);
  } else {
    PrintOne(*effects.front(), settings.name, console);
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
