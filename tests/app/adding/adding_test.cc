// The worked examples of docs/adding, done as they stand there: files are cut from the pages into a
// scratch tree, whatever else is in it is a link to the project or built already.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

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

class Adding : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    tree_ = new testing::TempFolder;
    const fs::path effects = tree_->path() / "model/effects";
    fs::create_directories(effects);
    for (const auto& entry : fs::directory_iterator(kSource / "model/effects"))
      fs::create_symlink(entry.path(), effects / entry.path().filename());
    fs::create_directories(tree_->path() / "experiments");
    fs::create_symlink(kSource / "experiments/three-drops.yaml",
                       tree_->path() / "experiments/three-drops.yaml");
    fs::copy_file(kSource / "tests/app/adding/CMakeLists.txt", tree_->path() / "CMakeLists.txt");
    WriteFiles("effect.md", "cpp", tree_->path());
    WriteFiles("mechanism.md", "cpp", tree_->path());
    WriteFiles("experiment.md", "yaml", tree_->path());
    WriteFiles("formula.md", "yaml", tree_->path());
    const std::vector<std::vector<std::string>> steps = {
        {HOPLAB_CMAKE, "-S", ".", "-B", "build", "-G", HOPLAB_GENERATOR,
         "-DHOPLAB_SOURCE=" + kSource.string(), "-DHOPLAB_BUILD=" HOPLAB_BUILD_DIR,
         "-DCMAKE_BUILD_TYPE=" HOPLAB_BUILD_TYPE, "-DCMAKE_CXX_COMPILER=" HOPLAB_COMPILER,
         "-DCMAKE_CXX_COMPILER_LAUNCHER=" HOPLAB_LAUNCHER},
        {HOPLAB_CMAKE, "--build", "build"}};
    for (const std::vector<std::string>& command : steps) {
      const ProcessResult r = RunProcess(
          {.command = command, .folder = tree_->path(), .timeout = std::chrono::seconds(300)});
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

TEST_F(Adding, AMechanismHoldsAgainstItsClosedForm) {
  const ProcessResult run = Run("pogo_test", {});
  EXPECT_EQ(run.exit_code, 0) << run.out;
  EXPECT_NE(run.out.find("1 test from 1 test suite ran"), std::string::npos) << run.out;
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
