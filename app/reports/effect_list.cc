#include "app/reports/effect_list.h"

#include "app/records/formula_words.h"
#include "app/reports/effect_words.h"
#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/report_text.h"
#include "app/terminal/text_table.h"
#include "base/text.h"

namespace hoplab {
namespace {

std::string Quantity(double value, const EffectParameter& p) {
  const ReadableUnit unit = ReadableUnitOf(value, std::string(p.unit));
  return FormatDouble(value * unit.factor) + (unit.unit.empty() ? "" : " " + unit.unit);
}

}  // namespace

std::string EffectListText(const std::vector<const Effect*>& effects, bool colours) {
  using enum TextTable::Align;
  std::string text;
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
    text += Styled(TitleOf(kind), Emphasis::kBold, colours) + '\n';
    for (std::size_t i = 0; i < rows.size(); ++i) {
      text += lines[i + 1] + "\n      " +
              Styled(Wrapped(std::string(rows[i]->info.sentence), 6), Emphasis::kFaint, colours) +
              '\n';
    }
    text += '\n';
  }
  return text + Plural(static_cast<long>(effects.size()), "effect") +
         "; hoplab effects EFFECT says more of one\n";
}

std::string EffectText(const Effect& effect, const std::string& given, bool colours) {
  const EffectInfo& info = effect.info;
  std::string text = Styled(info.name, Emphasis::kBold, colours) + "  " +
                     std::string(NameOf(info.kind)) + "\n\n  " +
                     Wrapped(std::string(info.sentence), 2) + "\n\n" +
                     (effect.formula ? FormulaExplained(effect, colours)
                                     : Labelled("equation", std::string(info.equation), colours));
  for (const EffectParameter& p : info.parameters) {
    text += Labelled(
        std::string(p.name),
        (p.unit == "-" ? "" : "[" + std::string(p.unit) + "] ") +
            (p.is_shape ? "held at " : "no effect at ") + FormatDouble(p.null) +
            (p.is_shape ? " unless freed by name" : ", typical " + FormatDouble(p.typical)) +
            ", from " + FormatDouble(p.lower) + " to " + FormatDouble(p.upper),
        colours);
  }
  std::vector<std::string> laws;
  for (const Law law : LawsWith(effect)) laws.emplace_back(NameOf(law));
  return text +
         Labelled("laws",
                  Join(laws) + (info.massless_leg_only ? "; not with a toe mass" : "") +
                      PartOfText(effect),
                  colours) +
         Labelled("energy",
                  info.dissipative ? "only ever taken away" : "may be put in or taken away",
                  colours) +
         Labelled("fit it", "hoplab fit DATASET --with " + given, colours);
}

}  // namespace hoplab
