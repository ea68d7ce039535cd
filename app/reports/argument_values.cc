#include "app/reports/argument_values.h"

#include <fmt/format.h>

#include "app/reports/effect_words.h"
#include "app/reports/explain.h"
#include "app/terminal/help_text.h"
#include "experiments/study/reproduction.h"
#include "model/effects/effect.h"

namespace hoplab {
namespace {

using Kind = ArgumentValues::Kind;
using Words = std::vector<std::string>;

Words EffectWords() {
  Words words;
  for (const Effect* effect : AllEffects()) words.emplace_back(effect->info.name);
  return words;
}

Words EffectAssignments() {
  Words words;
  for (const Effect* effect : AllEffects()) {
    for (const EffectParameter& p : effect->info.parameters)
      words.push_back(fmt::format("{}:{}=", effect->info.name, p.name));
  }
  return words;
}

Words LawWords() {
  Words words;
  for (const Law law : AllLaws()) words.emplace_back(NameOf(law));
  return words;
}

Words ParameterWords(const std::string& end) {
  Words words;
  for (const ParameterInfo& info : AllParameters()) words.push_back(std::string(info.name) + end);
  return words;
}

Words StudyWords() {
  Words words = StudyGroupNames();
  const Words items = StudyItemNames();
  words.insert(words.end(), items.begin(), items.end());
  return words;
}

}  // namespace

ArgumentValues ValuesOf(const CLI::Option& option) {
  if (Words choices = ChoicesOf(option); !choices.empty())
    return {Kind::kWords, std::move(choices)};
  // What a placeholder stands for is the same in every command.
  const std::string& text = option.get_option_text();
  const std::string placeholder = text.empty() ? option.get_name(true, false) : text;
  if (placeholder == "LAW" || placeholder == "LAW+EFFECT...") return {Kind::kWords, LawWords()};
  if (placeholder == "EFFECT") return {Kind::kWords, EffectWords()};
  if (placeholder == "EFFECT,...") return {Kind::kWords, EffectWords(), true};
  if (placeholder == "EFFECT:PARAMETER=VALUE") return {Kind::kWords, EffectAssignments()};
  if (placeholder == "NAME,...") return {Kind::kWords, ParameterWords(""), true};
  if (placeholder == "NAME=VALUE") return {Kind::kWords, ParameterWords("=")};
  if (placeholder == "ITEM") return {Kind::kWords, StudyWords()};
  if (placeholder == "WORD") return {Kind::kWords, ExplainedWords()};
  if (placeholder == "SCENARIO" || placeholder == "FILE") return {Kind::kFiles};
  if (placeholder == "DATASET" || placeholder == "DIR" || placeholder == "RUN_DIR")
    return {Kind::kFolders};
  return {};
}

}  // namespace hoplab
