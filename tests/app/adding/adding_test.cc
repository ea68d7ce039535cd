// The worked examples of docs/adding, done as they stand there: files are cut from the pages into a
// scratch tree, whatever else is in it is a link to the project or built already.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/export/effect_code.h"
#include "app/records/discovery_words.h"
#include "tests/support/formulas.h"
#include "tests/support/run_process.h"

namespace hoplab {
namespace {

namespace fs = std::filesystem;
using testing::ProcessResult;
using testing::ReadText;
using testing::RunProcess;

const fs::path kSource = HOPLAB_SOURCE_DIR;

// The insides of a page's blocks of this language.
std::vector<std::string> Blocks(const std::string& page, const std::string& language) {
  const std::string text = ReadText(kSource / "docs/adding" / page), fence = "```";
  const std::string begin = "\n" + fence + language + "\n";
  std::vector<std::string> blocks;
  for (std::size_t at = text.find(begin); at != text.npos; at = text.find(begin, at)) {
    at += begin.size();
    const std::size_t end = text.find("\n" + fence, at);
    blocks.push_back(text.substr(at, end + 1 - at));
    at = end;
  }
  EXPECT_FALSE(blocks.empty()) << page << " has no " << language;
  return blocks;
}

// Writes each block to the file that its first line names, as `// model/effects/x.cc`.
void WriteFiles(const std::string& page, const std::string& language, const fs::path& tree) {
  for (const std::string& block : Blocks(page, language)) {
    const std::size_t end = block.find('\n'), name = block.find(' ') + 1;
    const fs::path file = tree / block.substr(name, end - name);
    fs::create_directories(file.parent_path());
    testing::WriteText(file, block.substr(end + 1));
  }
}

// Applies the page's blocks of changes to copies of the files that they name. What went wrong.
std::string ChangeFiles(const std::string& page, const fs::path& tree) {
  for (const std::string& block : Blocks(page, "diff")) {
    std::istringstream lines(block);
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("+++ b/")) continue;
      const fs::path file = tree / line.substr(6);
      fs::create_directories(file.parent_path());
      if (fs::is_symlink(file)) fs::remove(file);
      if (!fs::exists(file)) fs::copy_file(kSource / line.substr(6), file);
    }
    testing::WriteText(tree / "changes", block);
    const ProcessResult run =
        RunProcess({.command = {"/usr/bin/patch", "-p1", "-i", "changes"}, .folder = tree});
    if (run.exit_code != 0) return page + ": " + run.out + run.err;
  }
  return "";
}

// Links all files of one of the project's folders into the tree.
void LinkFolder(const std::string& folder, const fs::path& tree) {
  fs::create_directories(tree / folder);
  for (const auto& entry : fs::directory_iterator(kSource / folder))
    fs::create_symlink(entry.path(), tree / folder / entry.path().filename());
}

// Formulas that are added as code too, named so that the file stays free for the formula.
struct AddedFormula {
  FormulaSource source;
  std::vector<std::string> sizes;  // parameter=value
};
std::vector<AddedFormula> AddedFormulas() {
  using testing::Factor;
  using testing::Shape;
  const auto named = [](const char* name, FormulaSource source) {
    source.name = name;
    return source;
  };
  return {
      {named(
           "drag_along",
           testing::Source("body_force_along", "-c * (speed/v0)^p - c * sin(2 * pi * f * t)^2",
                           {Factor("c", "N", -10.0, 10.0, 0.1), Shape("v0", "m/s", 1.3, 0.1, 10.0),
                            Shape("p", "1", 1.7, 0.5, 3.0), Shape("f", "Hz", 2.5, 0.1, 10.0)})),
       {"c=0.2"}},
      {named("chord_while_loading",
             testing::Source("chord_force", "-(k * max(s - s0, 0) + b * rate) * loading",
                             {Factor("k", "N", -1e3, 1e3, 10.0), Factor("b", "N s/m", -10, 10, 1),
                              Shape("s0", "1", 0.005, 0.0, 0.5)})),
       {"k=40", "b=0.5"}},
      {named("landing_slip",
             testing::Source("landing_velocity_across", "-zeta * across/(1 + abs(theta))",
                             {Factor("zeta", "1", 0.0, 1.0, 0.01)})),
       {"zeta=0.05"}},
      {named("place_by_speed",
             testing::Source(
                 "touchdown_angle", "a * (vx - v1) - a * sqrt(vx * v1)/2",
                 {Factor("a", "rad s/m", -1.0, 1.0, 0.02), Shape("v1", "m/s", 1.0, 0.1, 2.0)})),
       {"a=0.03"}}};
}

class Adding : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    tree_ = new testing::TempFolder;
    const fs::path effects = tree_->path() / "model/effects";
    LinkFolder("model/effects", tree_->path());
    LinkFolder("model/laws/legs", tree_->path());
    LinkFolder("app/commands", tree_->path());
    LinkFolder("app/reports/texts", tree_->path());
    LinkFolder("model/channels", tree_->path());
    fs::create_directories(tree_->path() / "experiments");
    fs::create_symlink(kSource / "experiments/three-drops.yaml",
                       tree_->path() / "experiments/three-drops.yaml");
    fs::copy_file(kSource / "tests/app/adding/CMakeLists.txt", tree_->path() / "CMakeLists.txt");
    for (const AddedFormula& f : AddedFormulas()) {
      FormulaSource coded = f.source;
      coded.name = "code_of_" + f.source.name;
      testing::WriteText(effects / (coded.name + ".cc"), EffectCodeOf(coded, "formula"));
      testing::WriteText(tree_->path() / (f.source.name + ".yaml"),
                         EffectFileText(f.source, "the same as a formula"));
    }
    WriteFiles("effect.md", "cpp", tree_->path());
    WriteFiles("mechanism.md", "cpp", tree_->path());
    WriteFiles("law.md", "cpp", tree_->path());
    WriteFiles("channel.md", "cpp", tree_->path());
    WriteFiles("command.md", "cpp", tree_->path());
    WriteFiles("experiment.md", "yaml", tree_->path());
    WriteFiles("formula.md", "yaml", tree_->path());
    for (const char* page : {"law.md", "channel.md"}) log_ += ChangeFiles(page, tree_->path());
    if (!log_.empty()) return;
    const std::vector<std::vector<std::string>> steps = {
        {HOPLAB_CMAKE, "-S", ".", "-B", "build", "-G", HOPLAB_GENERATOR,
         "-DHOPLAB_SOURCE=" + kSource.string(), "-DHOPLAB_BUILD=" HOPLAB_BUILD_DIR,
         "-DCMAKE_BUILD_TYPE=" HOPLAB_BUILD_TYPE, "-DCMAKE_CXX_COMPILER=" HOPLAB_COMPILER,
         "-DCMAKE_CXX_COMPILER_LAUNCHER=" HOPLAB_LAUNCHER},
        {HOPLAB_CMAKE, "--build", "build"}};
    for (const std::vector<std::string>& command : steps) {
      const ProcessResult r = RunProcess(
          {.command = command, .folder = tree_->path(), .timeout = std::chrono::seconds(900)});
      built_ = r.exit_code == 0;
      if (!built_) {
        log_ = r.out + r.err;
        return;
      }
    }
  }
  static void TearDownTestSuite() {
    delete tree_;
    tree_ = nullptr;
  }
  void SetUp() override { ASSERT_TRUE(built_) << log_; }

  static ProcessResult Run(const std::string& program, const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {(tree_->path() / "build" / program).string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return RunProcess({.command = command, .folder = tree_->path()});
  }

  // Runs every `./hoplab` line of a page; gives back what each printed.
  static std::vector<std::string> RunCommands(const std::string& page) {
    std::vector<std::string> printed;
    for (const std::string& block : Blocks(page, "sh")) {
      std::istringstream lines(block);
      for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::vector<std::string> arguments;
        std::string program;
        words >> program;
        EXPECT_EQ(program, "./hoplab");
        for (std::string word; words >> word;) arguments.push_back(word);
        const ProcessResult run = Run("hoplab", arguments);
        EXPECT_EQ(run.exit_code, 0) << line << "\n" << run.err;
        printed.push_back(run.out);
      }
    }
    return printed;
  }

  static fs::path tree() { return tree_->path(); }

 private:
  static inline testing::TempFolder* tree_ = nullptr;
  static inline bool built_ = false;
  static inline std::string log_;
};

TEST_F(Adding, AnEffectInAFileOfItsOwnIsListedExplainedAndNamedByADiagnosis) {
  const std::vector<std::string> printed = RunCommands("effect.md");
  ASSERT_EQ(printed.size(), 4u);
  EXPECT_NE(printed[0].find("k_line"), std::string::npos) << printed[0];
  EXPECT_NE(printed[1].find("An elastic line pulls the body back"), std::string::npos);
  std::istringstream answer(Blocks("effect.md", "text").at(0));
  for (std::string line; std::getline(answer, line);)
    EXPECT_NE(printed[3].find(line + "\n"), std::string::npos) << line << "\n" << printed[3];
  const std::string others = Run("hoplab", {"effects"}).out;
  EXPECT_NE(others.find("safety_line"), std::string::npos);
  EXPECT_NE(others.find("air_drag"), std::string::npos);
}

// What --code writes moves the body as the formula does.
TEST_F(Adding, AFormulaAsCodeIsTheFormula) {
  const auto ends = [](const std::string& effect, const std::vector<std::string>& sizes) {
    std::vector<std::string> arguments = {"simulate", "experiments/three-drops.yaml", "--json",
                                          "--out",    (tree() / "run").string(),      "--force"};
    for (const std::string& size : sizes) {
      arguments.emplace_back("--with");
      arguments.push_back(effect + ":" + size);
    }
    const ProcessResult run = Run("hoplab", arguments);
    EXPECT_EQ(run.exit_code, 0) << effect << run.err;
    const auto record = nlohmann::json::parse(run.out);
    std::vector<double> values = {record["end_time_s"]};
    for (const char* name : {"x_m", "y_m", "vx_m_per_s", "vy_m_per_s"})
      values.push_back(record["final_state"][name]);
    return values;
  };
  const std::vector<double> plain = ends("", {});
  for (const AddedFormula& f : AddedFormulas()) {
    const std::string name = f.source.name;
    const std::vector<double> formula = ends(name + ".yaml", f.sizes),
                              code = ends("code_of_" + name, f.sizes);
    double moved = 0.0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      EXPECT_NEAR(code[i], formula[i], 1e-7) << name;  // the solver's, across corners
      moved = std::max(moved, std::abs(formula[i] - plain[i]));
    }
    EXPECT_GT(moved, 1e-3) << name << " changes nothing";
  }
}

TEST_F(Adding, AMechanismHoldsAgainstItsClosedForm) {
  const ProcessResult run = Run("pogo_test", {});
  EXPECT_EQ(run.exit_code, 0) << run.out;
  EXPECT_NE(run.out.find("1 test from 1 test suite ran"), std::string::npos) << run.out;
}

TEST_F(Adding, ALawHoldsAgainstItsOracleAndIsKnownEverywhere) {
  const ProcessResult test = Run("even_stiffness_test", {});
  EXPECT_EQ(test.exit_code, 0) << test.out;
  EXPECT_NE(test.out.find("1 test from 1 test suite ran"), std::string::npos) << test.out;
  const std::vector<std::string> printed = RunCommands("law.md");
  ASSERT_EQ(printed.size(), 4u);
  EXPECT_NE(printed[0].find("even_stiffness"), std::string::npos) << printed[0];
  EXPECT_NE(printed[1].find("k = 1/C(pi)"), std::string::npos) << printed[1];
  const ProcessResult elastica = Run("hoplab", {"apexes", "experiments/three-drops.yaml"});
  const ProcessResult even =
      Run("hoplab", {"apexes", "experiments/three-drops.yaml", "--law", "even_stiffness"});
  EXPECT_EQ(even.exit_code, 0) << even.err;
  EXPECT_NE(even.out, elastica.out) << "the law changes nothing";
  const ProcessResult refused =
      Run("hoplab", {"simulate", "experiments/three-drops.yaml", "--law", "even_stiffness",
                     "--with", "leg_hardening:beta=0.1", "--out", (tree() / "hard").string()});
  EXPECT_EQ(refused.exit_code, 65) << refused.out << refused.err;
}

// The cells of a table's line.
std::vector<std::string> CellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST_F(Adding, AChannelIsTheSpeedAndIsGeneratedCheckedAndFitted) {
  const std::vector<std::string> printed = RunCommands("channel.md");
  ASSERT_EQ(printed.size(), 4u);
  std::istringstream table(ReadText(tree() / "runs/speed/trajectory.csv"));
  std::string line;
  std::getline(table, line);
  const std::vector<std::string> titles = CellsOf(line);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(titles.begin(), titles.end(), name) - titles.begin());
  };
  const std::size_t vx = column("body_vx_m_per_s"), vy = column("body_vy_m_per_s"),
                    speed = column("body_speed_m_per_s");
  ASSERT_LT(speed, titles.size()) << line;
  int rows = 0;
  for (; std::getline(table, line); ++rows) {
    const std::vector<std::string> cells = CellsOf(line);
    EXPECT_NEAR(std::stod(cells[speed]), std::hypot(std::stod(cells[vx]), std::stod(cells[vy])),
                1e-12)
        << line;
  }
  EXPECT_GT(rows, 100);
  EXPECT_NE(printed[2].find("body_speed    0.0100 m/s"), std::string::npos) << printed[2];
  const auto fit = nlohmann::json::parse(ReadText(tree() / "runs/with-speed/run.json"));
  EXPECT_EQ(fit.at("channels").size(), 3u) << fit.at("channels");
  const double chi2 = fit.at("chi2_per_dof");
  EXPECT_NEAR(chi2, 1.0, 0.1);  // the noise that was added, in all three
}

TEST_F(Adding, ACommandPrintsWhatStandsThere) {
  const std::vector<std::string> printed = RunCommands("command.md");
  ASSERT_EQ(printed.size(), 2u);
  EXPECT_EQ(printed[0], Blocks("command.md", "text").at(0));
  const std::string help = Run("hoplab", {"--help"}).out;
  const std::size_t apexes = help.find("  apexes"), report = help.find("  report");
  EXPECT_LT(help.find("  generate"), apexes) << help;
  EXPECT_LT(apexes, report) << help;
  EXPECT_NE(printed[1].find("--plain"), std::string::npos) << printed[1];
  const ProcessResult json = Run(
      "hoplab", {"apexes", "experiments/three-drops.yaml", "--json", "--law", "even_stiffness"});
  EXPECT_EQ(nlohmann::json::parse(json.out).at("apexes").size(), 3u) << json.out;
  EXPECT_EQ(Run("hoplab", {"apexes", "no-such-file.yaml"}).exit_code, 65);
}

TEST_F(Adding, AnExperimentGivesTheTableThatStandsThere) {
  const std::vector<std::string> printed = RunCommands("experiment.md");
  ASSERT_EQ(printed.size(), 4u);
  const std::string table = Blocks("experiment.md", "text").at(0);
  EXPECT_NE(printed[1].find(table), std::string::npos) << printed[1];
  EXPECT_EQ(printed[3].find(table), std::string::npos) << "another law, other numbers";
}

TEST_F(Adding, AFormulaIsCheckedGeneratedAndFitted) {
  const std::vector<std::string> printed = RunCommands("formula.md");
  ASSERT_EQ(printed.size(), 4u);
  EXPECT_NE(printed[0].find("-k max(x - x_end, 0)"), std::string::npos) << printed[0];
  EXPECT_NE(printed[2].find("cable.k"), std::string::npos) << printed[2];
  EXPECT_NE(printed[3].find("cable.x_end"), std::string::npos) << printed[3];
}

}  // namespace
}  // namespace hoplab
