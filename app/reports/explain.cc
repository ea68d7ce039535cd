#include "app/reports/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>

#include "app/reports/effect_advice.h"
#include "app/reports/effect_words.h"
#include "app/reports/glossary.h"
#include "app/reports/text_entries.h"
#include "base/check.h"
#include "base/text.h"

namespace hoplab {
namespace {

// "spectral radius", "Spectral_Radius": as the glossary writes it.
std::string Key(const std::string& text) {
  std::string key(Trim(text));
  for (char& c : key) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (c == ' ' || c == '_') c = '-';
  }
  return key;
}

bool IsCalled(const GlossaryEntry& entry, const std::string& key) {
  std::istringstream also(entry.also);
  return std::find(std::istream_iterator<std::string>(also), {}, key) !=
         std::istream_iterator<std::string>();
}

std::string ParameterSentence(const EffectParameter& p) {
  const std::string unit = p.unit == "-" ? "" : " " + std::string(p.unit);
  return fmt::format(" {} [{}]: {} is no effect, {}{} a size to expect, {} to {} possible.", p.name,
                     p.unit, FormatDouble(p.null), FormatDouble(p.typical), unit,
                     FormatDouble(p.lower), FormatDouble(p.upper));
}

Explanation ExplanationOf(const GlossaryEntry& entry) {
  return {Explanation::Kind::kWord, entry.word, entry.what, entry.meaning};
}

std::vector<Explanation> All() {
  std::vector<Explanation> all;
  for (const Law law : AllLaws()) all.push_back(ExplanationOf(law));
  for (const Effect* effect : AllEffects()) all.push_back(ExplanationOf(*effect));
  for (const GlossaryEntry& entry : Glossary()) all.push_back(ExplanationOf(entry));
  return all;
}

// Texts anywhere in a list of texts or of lists.
bool Names(const Json& value, const std::string& name) {
  if (value.is_string()) return value == name;
  return (value.is_array() || value.is_object()) &&
         std::any_of(value.begin(), value.end(), [&](const Json& v) { return Names(v, name); });
}

}  // namespace

std::string_view NameOf(Explanation::Kind kind) {
  switch (kind) {
    case Explanation::Kind::kEffect:
      return "effect";
    case Explanation::Kind::kLaw:
      return "law";
    case Explanation::Kind::kWord:
      return "word";
  }
  return "";
}

Explanation ExplanationOf(const Effect& effect) {
  const EffectInfo& info = effect.info;
  Explanation e{Explanation::Kind::kEffect, std::string(info.name), "", ""};
  e.what = SentenceOf(effect) + " Its term: " + std::string(info.equation) + ".";
  for (const EffectParameter& p : info.parameters) e.what += ParameterSentence(p);
  const EffectAdvice* advice = AdviceOn(info.name);
  if (advice) e.meaning = advice->check + " ";
  e.meaning += info.dissipative ? "It only ever takes energy away. "
                                : "It may put energy in or take it away. ";
  if (advice && !advice->look_alikes.empty())
    e.meaning += "In four driven hops the data move nearly as under " + advice->look_alikes + ". ";
  if (info.massless_leg_only) e.meaning += "Not with a toe mass. ";
  e.meaning += fmt::format("Fit it: hoplab fit DATASET --with {}.", info.name);
  return e;
}

Explanation ExplanationOf(Law law) {
  // Its sentence begins with the mechanism.
  const std::string sentence(SentenceOf(law));
  return {Explanation::Kind::kLaw, std::string(NameOf(law)),
          fmt::format("A law of the mechanism {} {}", sentence, InfoOf(law).equation),
          std::string(InfoOf(law).meaning)};
}

std::optional<Explanation> FindExplanation(const std::string& text) {
  const std::string key = Key(text);
  if (key.empty()) return std::nullopt;
  for (Explanation& e : All()) {
    if (Key(e.name) == key) return std::move(e);
  }
  for (const GlossaryEntry& entry : Glossary()) {
    if (IsCalled(entry, key)) return ExplanationOf(entry);
  }
  return std::nullopt;
}

std::vector<std::string> ExplainedWords() {
  std::vector<std::string> words;
  for (const Explanation& e : All()) words.push_back(e.name);
  return words;
}

Json ExplanationsFor(const Json& record) {
  Json out = Json::object();
  for (const Explanation& e : All()) {
    const bool used = e.kind == Explanation::Kind::kWord || record.value("law", Json()) == e.name ||
                      Names(record.value("effects", Json()), e.name) ||
                      Names(record.value("group", Json()), e.name);
    if (used) out[e.name] = {{"kind", NameOf(e.kind)}, {"what", e.what}, {"meaning", e.meaning}};
  }
  return out;
}

}  // namespace hoplab
