#include "app/reports/explain.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>

#include "app/reports/effect_advice.h"
#include "app/reports/effect_words.h"
#include "app/reports/glossary.h"
#include "app/reports/report_page.h"
#include "app/reports/text_entries.h"
#include "app/terminal/pace.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

using testing::ReadText;
const std::filesystem::path kTextsSource = HOPLAB_SOURCE_DIR;

TEST(Explain, EveryLawEffectAndWordHasTwoParagraphs) {
  std::size_t effects = 0, laws = 0, words = 0;
  for (const std::string& name : ExplainedWords()) {
    const std::optional<Explanation> e = FindExplanation(name);
    ASSERT_TRUE(e) << name;
    EXPECT_EQ(e->name, name);
    for (const std::string& paragraph : {e->what, e->meaning}) {
      EXPECT_GT(paragraph.size(), 40u) << name;
      EXPECT_EQ(paragraph.find('\n'), std::string::npos) << name;
      EXPECT_TRUE(paragraph.ends_with('.') || paragraph.ends_with(')')) << name << paragraph;
      EXPECT_TRUE(std::isupper(static_cast<unsigned char>(paragraph[0])) ||
                  paragraph.starts_with("chi") || paragraph.starts_with("hoplab") ||
                  std::isdigit(static_cast<unsigned char>(paragraph[0])))
          << paragraph;
    }
    effects += e->kind == Explanation::Kind::kEffect;
    laws += e->kind == Explanation::Kind::kLaw;
    words += e->kind == Explanation::Kind::kWord;
  }
  EXPECT_EQ(effects, AllEffects().size());
  EXPECT_EQ(laws, AllLaws().size());
  EXPECT_EQ(words, Glossary().size());
}

TEST(Explain, AnEffectIsToldFromItsOwnSentenceEquationAndUnits) {
  const std::optional<Explanation> e = FindExplanation("air_drag");
  ASSERT_TRUE(e);
  const EffectInfo& info = FindEffect("air_drag")->info;
  EXPECT_NE(e->what.find(std::string(info.sentence).substr(1)), std::string::npos);
  EXPECT_NE(e->what.find(info.equation), std::string::npos);
  EXPECT_NE(e->what.find("c_drag [N s^2/m^2]"), std::string::npos);
  EXPECT_NE(e->meaning.find("constant_force"), std::string::npos) << "looks like it";
  EXPECT_NE(e->meaning.find("--with air_drag"), std::string::npos);
  EXPECT_NE(FindExplanation("consistent")->what.find(SentenceOf(Law::kConsistent)),
            std::string::npos);
}

TEST(Explain, AWordIsFoundHoweverItIsWritten) {
  for (const char* text : {"spectral radius", "Spectral_Radius", "spectral-radius", " rho "})
    EXPECT_EQ(FindExplanation(text).value_or(Explanation{}).name, "spectral-radius") << text;
  EXPECT_EQ(FindExplanation("eigenvalue")->name, "floquet-multiplier");
  EXPECT_EQ(FindExplanation("Air Drag")->name, "air_drag");
  EXPECT_FALSE(FindExplanation(""));
  EXPECT_FALSE(FindExplanation("nothing of the kind"));
}

TEST(Explain, TheGlossaryIsInOrderAndNoNameMeansTwoThings) {
  std::set<std::string> names;
  for (const std::string& name : ExplainedWords()) EXPECT_TRUE(names.insert(name).second) << name;
  std::string_view last;
  for (const GlossaryEntry& entry : Glossary()) {
    EXPECT_LT(last, entry.word);
    last = entry.word;
    const std::regex word("[^ ]+");
    const std::string also(entry.also);
    for (std::sregex_iterator it(also.begin(), also.end(), word), end; it != end; ++it)
      EXPECT_TRUE(names.insert(it->str()).second) << it->str();
  }
}

TEST(Explain, AnEntryIsItsTextsInOrderWithLinesJoined) {
  constexpr std::string_view kKeys[] = {"word", "also", "what"};
  const std::vector<TextEntry> entries = ParseEntries(
      "# a remark\n\nword: one\nwhat: It goes on:\n  here; and\n  here.\n\n\nword: two\nalso: 2\n",
      kKeys);
  const std::vector<TextEntry> expected = {{"one", "", "It goes on: here; and here."},
                                           {"two", "2", ""}};
  EXPECT_EQ(entries, expected);
}

TEST(Explain, AdviceSpeaksOfEffectsThatExist) {
  std::set<std::string_view> advised;
  for (const EffectAdvice& advice : AllAdvice()) {
    EXPECT_NE(FindEffect(advice.effect), nullptr) << advice.effect;
    EXPECT_TRUE(advised.insert(advice.effect).second) << advice.effect;
  }
}

TEST(Explain, AReportHasTheSameTextForItsWordsItsLawAndItsEffects) {
  const Json record = {{"command", "diagnose"},
                       {"law", "thesis"},
                       {"effects", {"air_drag"}},
                       {"group", {"air_drag", "constant_force"}}};
  const std::string page = ReportPage(record, {});
  const std::string begin = "id=\"explanations\">";
  const std::size_t at = page.find(begin) + begin.size();
  const Json shown = Json::parse(page.substr(at, page.find("</script>", at) - at));
  for (const std::string& name : ExplainedWords()) {
    const Explanation e = *FindExplanation(name);
    const bool expected = e.kind == Explanation::Kind::kWord || name == "thesis" ||
                          name == "air_drag" || name == "constant_force";
    ASSERT_EQ(shown.contains(name), expected) << name;
    if (!expected) continue;
    EXPECT_EQ(shown.at(name).at("what"), e.what);
    EXPECT_EQ(shown.at(name).at("meaning"), e.meaning);
  }
}

TEST(Explain, EveryWordAReportsPageAsksForExists) {
  int asked = 0;
  const std::regex call("explained\\(([^)]*)\\)"), name("'([^']+)'");
  for (const auto& entry : std::filesystem::directory_iterator(kTextsSource / "web")) {
    if (entry.path().extension() != ".js") continue;
    const std::string text = ReadText(entry.path());
    for (std::sregex_iterator c(text.begin(), text.end(), call), end; c != end; ++c) {
      const std::string arguments = (*c)[1].str();
      for (std::sregex_iterator n(arguments.begin(), arguments.end(), name); n != end; ++n, ++asked)
        EXPECT_TRUE(FindExplanation((*n)[1].str())) << (*n)[1].str();
    }
  }
  EXPECT_GE(asked, 25);
  for (const char* status :
       {"supported", "indistinguishable", "excluded", "not-needed", "not-tested"})
    EXPECT_EQ(FindExplanation(status)->what.rfind("Judgement on a cause: ", 0), 0u);
}

TEST(Pace, TellsTheMeanRateAndTheTimeThatIsLeftAtIt) {
  using Seconds = Pace::Seconds;
  EXPECT_EQ(Pace(0).Text(50, 200, Seconds(10.0)), "5.0/s, 30 s left");
  EXPECT_EQ(Pace(100).Text(110, 200, Seconds(10.0)), "1.0/s, 1 min 30 s left")
      << "what stood before says nothing of the rate";
  EXPECT_EQ(Pace(0).Text(1, 3, Seconds(30.0)), "2.0/min, 1 min 0 s left");
  EXPECT_EQ(Pace(0).Text(1, 8, Seconds(1800.0)), "2.0/h, 3 h 30 min left");
  EXPECT_EQ(Pace(0).Text(4000, 8000, Seconds(2.0)), "2000/s, 2 s left");
  EXPECT_EQ(Pace(0).Text(0, 8, Seconds(1.0)), "") << "nothing is known yet";
  EXPECT_EQ(Pace(0).Text(8, 8, Seconds(1.0)), "") << "nothing is left";
}

}  // namespace
}  // namespace hoplab
