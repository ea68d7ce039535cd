#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/run_process.h"

// Adding an effect means adding one file. A scratch tree gets one more in model/effects; everything
// else in it is a link to the project or built already.

namespace hoplab {
namespace {

namespace fs = std::filesystem;
using testing::ProcessResult;
using testing::RunProcess;

const fs::path kSource = HOPLAB_SOURCE_DIR;
const fs::path kHere = kSource / "tests/app/new_effect";

class NewEffect : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    tree_ = new testing::TempFolder;
    const fs::path effects = tree_->path() / "model/effects";
    fs::create_directories(effects);
    for (const auto& entry : fs::directory_iterator(kSource / "model/effects"))
      fs::create_symlink(entry.path(), effects / entry.path().filename());
    fs::copy_file(kHere / "CMakeLists.txt", tree_->path() / "CMakeLists.txt");
    fs::copy_file(kHere / "steady_push.cc.txt", effects / "steady_push.cc");
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

 private:
  static inline testing::TempFolder* tree_ = nullptr;
  static inline bool built_ = false;
  static inline std::string log_;
};

TEST_F(NewEffect, InAFileOfItsOwnIsListedAndNamedByADiagnosis) {
  const ProcessResult listed = Run("hoplab", {"effects", "--json"});
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  bool found = false, others = false;
  const nlohmann::json record = nlohmann::json::parse(listed.out);
  for (const nlohmann::json& e : record.at("effects")) {
    found = found || e.at("name") == "steady_push";
    others = others || e.at("name") == "air_drag";
  }
  EXPECT_TRUE(found);
  EXPECT_TRUE(others);

  const ProcessResult diagnosed = Run("diagnose_push", {});
  EXPECT_EQ(diagnosed.exit_code, 0) << diagnosed.err;
  EXPECT_EQ(diagnosed.out, "named steady_push\n");
}

}  // namespace
}  // namespace hoplab
