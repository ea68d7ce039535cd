#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/records/run_record.h"
#include "model/effects/effect.h"

namespace hoplab {

/// Two paragraphs on an effect, a law or a word of the glossary.
struct Explanation {
  enum class Kind { kEffect, kLaw, kWord };
  Kind kind = Kind::kWord;
  std::string name;
  std::string what;     // what it is, with its equation and unit
  std::string meaning;  // what it means for the reader, and what to do about it
};
std::string_view NameOf(Explanation::Kind kind);

Explanation ExplanationOf(const Effect& effect);
Explanation ExplanationOf(Law law);

/// What is meant by `text`: case, blanks, underscores and hyphens do not matter, nor which of its
/// names a word of the glossary is called by.
std::optional<Explanation> FindExplanation(const std::string& text);

/// Every name that can be explained: laws, effects, words.
std::vector<std::string> ExplainedWords();

/// The glossary, and what a record itself names (its law, its effects), for a report's page: by
/// name {kind, what, meaning}.
Json ExplanationsFor(const Json& record);

}  // namespace hoplab
