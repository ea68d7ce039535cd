#include "app/reports/explanation_text.h"

#include <utility>

#include "app/terminal/console.h"
#include "app/terminal/report_text.h"
#include "base/text.h"

namespace hoplab {

std::string ExplanationText(const Explanation& e, bool colours, std::size_t columns) {
  return Styled(e.name, Emphasis::kBold, colours) + "  " + std::string(NameOf(e.kind)) + "\n\n  " +
         Wrapped(e.what, 2, columns) + "\n\n  " + Wrapped(e.meaning, 2, columns) + "\n";
}

std::string ExplanationList(bool colours, std::size_t columns) {
  using Kind = Explanation::Kind;
  const std::vector<std::string> words = ExplainedWords();
  std::string text;
  for (const auto& [kind, title] :
       {std::pair(Kind::kLaw, "Laws"), {Kind::kEffect, "Effects"}, {Kind::kWord, "Words"}}) {
    std::vector<std::string> of_kind;
    for (const std::string& word : words) {
      if (FindExplanation(word)->kind == kind) of_kind.push_back(word);
    }
    text += Styled(title, Emphasis::kBold, colours) + "\n  " + Wrapped(Join(of_kind), 2, columns) +
            "\n\n";
  }
  return text + "hoplab explain WORD tells one of them in two paragraphs\n";
}

Json ExplainRecord(const std::vector<Explanation>& explanations) {
  RecordHeader header;
  header.command = "explain";
  Json record = NewRecord(header);
  record["explanations"] = Json::array();
  for (const Explanation& e : explanations) {
    record["explanations"].push_back(
        {{"name", e.name}, {"kind", NameOf(e.kind)}, {"what", e.what}, {"meaning", e.meaning}});
  }
  return record;
}

}  // namespace hoplab
