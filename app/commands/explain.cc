#include <ostream>

#include "app/reports/explanation_text.h"
#include "app/terminal/command.h"
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

ExitCode RunExplain(const ExplainSettings& settings, Console& console) {
  const std::string text = Join(settings.words, " ");
  std::vector<Explanation> wanted;
  if (!text.empty()) wanted.push_back(Wanted(text));
  if (!settings.json) {
    console.out << (wanted.empty() ? ExplanationList(console.out_colours, console.out_columns)
                                   : ExplanationText(wanted.front(), console.out_colours,
                                                     console.out_columns));
    return ExitCode::kDone;
  }
  if (wanted.empty()) {
    for (const std::string& word : ExplainedWords()) wanted.push_back(*FindExplanation(word));
  }
  console.out << TextOf(ExplainRecord(wanted));
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
