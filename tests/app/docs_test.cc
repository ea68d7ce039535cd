// Documentation that follows the code: equations, links, the catalogue of effects.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "app/reports/effect_catalogue.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;
using testing::ReadText;

const fs::path kDocsSource = HOPLAB_SOURCE_DIR;
const std::vector<std::string> kFolders = {"base",     "model",       "datasets", "fitting",
                                           "optimize", "experiments", "app",      "web",
                                           "tests",    "bench",       "docs"};

std::vector<fs::path> FilesWith(const std::set<std::string>& extensions) {
  std::vector<fs::path> files;
  for (const std::string& folder : kFolders) {
    for (const auto& entry : fs::recursive_directory_iterator(kDocsSource / folder)) {
      if (entry.is_regular_file() && extensions.contains(entry.path().extension()))
        files.push_back(entry.path());
    }
  }
  return files;
}

std::set<std::string> Matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    found.insert((*it)[1]);
  return found;
}

// An equation stands at the beginning of an indented line; those of the events of a leg with a toe
// mass stand in a table.
std::map<std::string, int> EquationsOfTheSheet() {
  std::map<std::string, int> defined;
  std::istringstream sheet(ReadText(kDocsSource / "model/README.md"));
  const std::regex line_begin("^    (?:  )?(M[0-9]+[a-z]?) ");
  for (std::string line; std::getline(sheet, line);) {
    std::smatch found;
    if (std::regex_search(line, found, line_begin)) ++defined[found[1]];
  }
  return defined;
}

TEST(Docs, EveryEquationTheCodeCitesStandsInTheSheetOnce) {
  const std::map<std::string, int> defined = EquationsOfTheSheet();
  const std::string sheet = ReadText(kDocsSource / "model/README.md");
  const std::set<std::string> in_tables =
      Matches(sheet, std::regex("\\| (?:[a-z -]+, )?(M4[3-6])[: ]"));
  for (const auto& [name, times] : defined) EXPECT_EQ(times, 1) << name << " means two things";
  std::map<std::string, std::string> cited;  // and where
  for (const fs::path& file : FilesWith({".cc", ".h", ".js"})) {
    if (file.filename() == "docs_test.cc") continue;
    for (const std::string& name : Matches(ReadText(file), std::regex("\\b(M[0-9]{1,2}b?)\\b")))
      cited.emplace(name, file.string());
  }
  EXPECT_GE(cited.size(), 40u);
  for (const auto& [name, file] : cited)
    EXPECT_TRUE(defined.contains(name) || in_tables.contains(name))
        << name << ", cited in " << file;
}

// A page without its blocks of code.
std::string ProseOf(const fs::path& page) {
  std::istringstream lines(ReadText(page));
  std::string prose;
  bool code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) code = !code;
    if (!code) prose += line + "\n";
  }
  return prose;
}

TEST(Docs, EveryRelativeLinkLeadsToAFile) {
  std::vector<fs::path> pages = FilesWith({".md"});
  pages.push_back(kDocsSource / "README.md");
  pages.push_back(kDocsSource / "CHANGELOG.md");
  int links = 0;
  for (const fs::path& page : pages) {
    for (const std::string& link :
         Matches(ProseOf(page), std::regex("\\]\\(([^)#:]+)(?:#[^)]*)?\\)"))) {
      EXPECT_TRUE(fs::exists(page.parent_path() / link)) << page << ": " << link;
      ++links;
    }
  }
  EXPECT_GE(links, 40);
}

TEST(Docs, TheIndexLeadsToEveryPage) {
  const std::string index = ReadText(kDocsSource / "docs/README.md");
  for (const fs::path& page : FilesWith({".md"})) {
    const std::string name = fs::relative(page, kDocsSource / "docs").string();
    const bool decision = name.starts_with("decisions/");
    if (page.parent_path().string().find("tests") != std::string::npos || name == "README.md" ||
        decision || page.parent_path().parent_path() != kDocsSource / "docs")
      continue;
    EXPECT_NE(index.find("(" + name + ")"), std::string::npos) << name;
  }
}

// The rooms of the command line, each seeing those before it only; export stands beside the
// reports.
TEST(Docs, IncludesBetweenTheRoomsOfAppPointDown) {
  const std::vector<std::string> rooms = {"terminal", "runs",    "records",
                                          "export",   "reports", "commands"};
  const auto height = [&](const std::string& room) {
    return std::find(rooms.begin(), rooms.end(), room) - rooms.begin();
  };
  const std::regex include("#include \"app/([a-z_]+)/[a-z_/]+[.]h\"");
  int seen = 0;
  for (const std::string& room : rooms) {
    for (const auto& entry : fs::directory_iterator(kDocsSource / "app" / room)) {
      if (!entry.is_regular_file()) continue;
      for (const std::string& other : Matches(ReadText(entry.path()), include)) {
        EXPECT_LE(height(other), height(room)) << entry.path() << " includes app/" << other;
        ++seen;
      }
    }
  }
  EXPECT_GE(seen, 200);
  for (const auto& entry : fs::directory_iterator(kDocsSource / "app")) {
    if (!entry.is_directory()) continue;
    EXPECT_LT(height(entry.path().filename().string()), std::ssize(rooms)) << entry.path();
  }
}

TEST(Docs, TheCatalogueOfEffectsIsWhatTheCodeSays) {
  const std::span<const Effect* const> all = AllEffects();
  EXPECT_EQ(ReadText(kDocsSource / "docs/effects.md"), EffectCatalogue({all.begin(), all.end()}))
      << "hoplab effects --markdown > docs/effects.md";
}

}  // namespace
}  // namespace hoplab
