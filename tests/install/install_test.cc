// `cmake --install` to a scratch prefix, and a program outside the tree that uses what stands
// there.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/install/steps.h"

namespace hoplab::testing {
namespace {

namespace fs = std::filesystem;

class Install : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new TempFolder;
    log_ = RunSteps({{HOPLAB_CMAKE, "--install", HOPLAB_BUILD_DIR, "--prefix", Prefix().string()}},
                    scratch_->path());
  }
  static void TearDownTestSuite() {
    delete scratch_;
    scratch_ = nullptr;
  }
  void SetUp() override { ASSERT_EQ(log_, ""); }

  static fs::path Scratch() { return scratch_->path(); }
  static fs::path Prefix() { return scratch_->path() / "prefix"; }
  static std::string Dataset() { return (Prefix() / "share/hoplab/datasets/rig-drops").string(); }

 private:
  static inline TempFolder* scratch_ = nullptr;
  static inline std::string log_;
};

TEST_F(Install, AProgramOutsideTheTreeBuildsAgainstItAndFitsTheSame) {
  const fs::path source = Scratch() / "consumer";
  fs::copy(fs::path(HOPLAB_SOURCE_DIR) / "tests/install/consumer", source);
  const std::string log = RunSteps(
      {{HOPLAB_CMAKE, "-S", ".", "-B", "build", "-G", HOPLAB_GENERATOR,
        "-DCMAKE_PREFIX_PATH=" + Prefix().string(), "-DCMAKE_BUILD_TYPE=" HOPLAB_BUILD_TYPE,
        "-DCMAKE_CXX_COMPILER=" HOPLAB_COMPILER, "-DCMAKE_CXX_COMPILER_LAUNCHER=" HOPLAB_LAUNCHER},
       {HOPLAB_CMAKE, "--build", "build"}},
      source);
  ASSERT_EQ(log, "");
  const ProcessResult consumer =
      RunProcess({.command = {(source / "build/fit_modulus").string(), Dataset()}});
  ASSERT_EQ(consumer.exit_code, 0) << consumer.err;
  double value = 0.0, lower = 0.0, upper = 0.0;
  std::istringstream(consumer.out) >> value >> lower >> upper;

  const ProcessResult program = RunProcess(
      {.command = {(Prefix() / "bin/hoplab").string(), "fit", Dataset(), "--json", "--quiet"},
       .folder = Scratch()});
  ASSERT_EQ(program.exit_code, 0) << program.err;
  const nlohmann::json e = nlohmann::json::parse(program.out).at("parameters").at(0);
  EXPECT_EQ(e.at("name"), "E");
  // The command line's absolute tolerance, 0.1 x 1e-9, is one unit in the last place off the
  // library's 1e-10: steps differ in their rounding, values by less than the tolerance.
  EXPECT_NEAR(value / e.at("value").get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(lower / e.at("ci95").at(0).get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(upper / e.at("ci95").at(1).get<double>(), 1.0, 1e-9);
}

// What each prints is held by tests/examples; here it is that they build, and one runs.
TEST_F(Install, TheExamplesBuildAgainstIt) {
  const fs::path source = Scratch() / "examples";
  fs::copy(Prefix() / "share/hoplab/examples", source);
  const std::string log = RunSteps(
      {{HOPLAB_CMAKE, "-S", ".", "-B", "build", "-G", HOPLAB_GENERATOR,
        "-DCMAKE_PREFIX_PATH=" + Prefix().string(), "-DCMAKE_BUILD_TYPE=" HOPLAB_BUILD_TYPE,
        "-DCMAKE_CXX_COMPILER=" HOPLAB_COMPILER, "-DCMAKE_CXX_COMPILER_LAUNCHER=" HOPLAB_LAUNCHER},
       {HOPLAB_CMAKE, "--build", "build"}},
      source);
  ASSERT_EQ(log, "");
  const ProcessResult run = RunProcess({.command = {(source / "build/hop").string()}});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.out.find("energy 3.7880 J before, 3.7880 J after"), std::string::npos) << run.out;
}

TEST_F(Install, ANewerMinorVersionIsNotTakenForThisOne) {
  const fs::path source = Scratch() / "newer";
  WriteText(source / "CMakeLists.txt",
            "cmake_minimum_required(VERSION 3.25)\nproject(newer LANGUAGES NONE)\n"
            "find_package(hoplab 0.3 REQUIRED)\n");
  const std::string log = RunSteps(
      {{HOPLAB_CMAKE, "-S", ".", "-B", "build", "-DCMAKE_PREFIX_PATH=" + Prefix().string()}},
      source);
  EXPECT_NE(log.find("considered but not accepted"), std::string::npos) << log;
}

TEST_F(Install, TheProgramShowsItsReportAndShippedScenariosWithoutTheSourceTree) {
  const std::string scenario = (Prefix() / "share/hoplab/experiments/three-drops.yaml").string();
  const ProcessResult run = RunProcess(
      {.command = {(Prefix() / "bin/hoplab").string(), "simulate", scenario, "--out", "run"},
       .folder = Scratch()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(ReadText(Scratch() / "run/report.html").find("Plotly"), std::string::npos);
}

TEST_F(Install, NoFileNamesTheSourceTreeOrTheBuild) {
  long files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(Prefix())) {
    // Archives and modules of a debug build hold the places of their sources, as they should.
    if (!entry.is_regular_file() || entry.path().extension() == ".a" ||
        entry.path().extension() == ".so")
      continue;
    ++files;
    const std::string text = ReadText(entry.path());
    EXPECT_EQ(text.find(HOPLAB_SOURCE_DIR "/"), std::string::npos) << entry.path();
    EXPECT_EQ(text.find(HOPLAB_BUILD_DIR), std::string::npos) << entry.path();
  }
  EXPECT_GT(files, 100);
}

TEST_F(Install, LeavesNoEmptyFolder) {
  for (const auto& entry : fs::recursive_directory_iterator(Prefix())) {
    if (entry.is_directory()) {
      EXPECT_FALSE(fs::is_empty(entry)) << entry.path();
    }
  }
}

#ifdef HOPLAB_PYTHON
TEST_F(Install, PythonFindsTheModuleWhereAUserInstallsIt) {
  // As with the prefix ~/.local.
  const ProcessResult run = RunProcess(
      {.command = {"/usr/bin/env", "-u", "PYTHONPATH", "PYTHONUSERBASE=" + Prefix().string(),
                   HOPLAB_PYTHON, "-B", "-c", "import hoplab; print(hoplab.__file__)"},
       .folder = Scratch()});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(run.out.starts_with(Prefix().string() + "/lib/python3")) << run.out;
}
#endif

}  // namespace
}  // namespace hoplab::testing
