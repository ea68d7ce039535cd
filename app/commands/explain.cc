#include "app/reports/explain.h"

#include <ostream>

#include "app/terminal/command.h"
#include "app/terminal/report_text.h"
#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

struct ExplainSettings {
  std::vector<std::string> words;
  bool json = false;
};

Explanation Wanted(const std::string& text) {
  if (auto found = FindExplanation(text)) return *found;
  const auto nearest = NearestWord(text, ExplainedWords());
  throw InputError(
      {"WORD", Printable(text), "is no effect, law or word of the glossary",
       nearest ? "Did you mean " + *nearest + "?" : std::string("hoplab explain lists them all.")});
}

void PrintOne(const Explanation& e, Console& console) {
  console.out << Styled(e.name, Emphasis::kBold, console.out_colours) << "  " << NameOf(e.kind)
              << "\n\n  " << Wrapped(e.what, 2, console.out_columns) << "\n\n  "
              << Wrapped(e.meaning, 2, console.out_columns) << '\n';
}

void PrintList(Console& console) {
  std::vector<std::pair<std::string_view, std::vector<std::string>>> lists = {
      {"Laws", {}}, {"Effects", {}}, {"Words", {}}};
  for (const std::string& word : ExplainedWords()) {
    switch (FindExplanation(word)->kind) {
      case Explanation::Kind::kLaw:
        lists[0].second.push_back(word);
        break;
      case Explanation::Kind::kEffect:
        lists[1].second.push_back(word);
        break;
      case Explanation::Kind::kWord:
        lists[2].second.push_back(word);
        break;
    }
  }
  for (const auto& [title, words] : lists) {
    console.out << Styled(title, Emphasis::kBold, console.out_colours) << "\n  "
                << Wrapped(Join(words), 2, console.out_columns) << "\n\n";
  }
  console.out << "hoplab explain WORD tells one of them in two paragraphs\n";
}

ExitCode RunExplain(const ExplainSettings& settings, Console& console) {
  const std::string text = Join(settings.words, " ");
  std::vector<Explanation> wanted;
  if (!text.empty()) wanted.push_back(Wanted(text));
  if (!settings.json) {
    if (wanted.empty())
      PrintList(console);
    else
      PrintOne(wanted.front(), console);
    return ExitCode::kDone;
  }
  if (wanted.empty()) {
    for (const std::string& word : ExplainedWords()) wanted.push_back(*FindExplanation(word));
  }
  RecordHeader header;
  header.command = "explain";
  Json record = NewRecord(header);
  record["explanations"] = Json::array();
  for (const Explanation& e : wanted) {
    record["explanations"].push_back(
        {{"name", e.name}, {"kind", NameOf(e.kind)}, {"what", e.what}, {"meaning", e.meaning}});
  }
  console.out << TextOf(record);
  return ExitCode::kDone;
}

void AddExplain(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<ExplainSettings>();
  sub.add_option("WORD", settings->words, "As air_drag, consistent, weak direction; none: a list");
  OnParsed(sub, invocation, settings, RunExplain);
}

}  // namespace

namespace commands {
extern constexpr Command explain = {
    .place = 190,
    .name = "explain",
    .what = "Two paragraphs on an effect, a law, or a word of the reports",
    .footer =
        "Examples:\n"
        "  hoplab explain\n"
        "  hoplab explain spectral radius\n"
        "  hoplab explain touchdown_loss",
    .add = AddExplain};
}  // namespace commands
}  // namespace hoplab
