#include "app/reports/run_folder.h"

#include <gtest/gtest.h>

#include "tests/support/input_error_of.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

using testing::InputErrorOf;
using testing::ReadText;
using testing::TempFolder;

TEST(RunFolder, ATakenPlaceIsRefusedBeforeTheWork) {
  const TempFolder temp;
  testing::WriteText(temp.path() / "run" / "run.json", "{}");
  EXPECT_NE(InputErrorOf([&] {
              RunFolder({temp.path() / "run"}, "drops", "fit");
            }).find("exists already"),
            std::string::npos);
  EXPECT_NO_THROW(RunFolder({temp.path() / "run", true}, "drops", "fit"));
}

TEST(RunFolder, AllFilesAppearAtOnce) {
  const TempFolder temp;
  const RunFolder folder({temp.path() / "deep" / "run"}, "drops", "fit");
  EXPECT_EQ(folder.Write({{"run.json", "{}"}, {"a.csv", "x\n"}}), temp.path() / "deep" / "run");
  EXPECT_EQ(ReadText(temp.path() / "deep" / "run" / "a.csv"), "x\n");
  EXPECT_TRUE(std::filesystem::exists(temp.path() / "deep" / "run" / "report.html"));
  EXPECT_EQ(testing::CountEntries(temp.path() / "deep"), 1);
}

TEST(RunFolder, NumbersGoOnAndNamesAreMadeHarmless) {
  const TempFolder temp;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(temp.path());
  const RunFolder folder({}, "../my drops", "fit");
  EXPECT_EQ(folder.Write({{"run.json", "{}"}}), "runs/-.-my-drops-fit-001");
  std::filesystem::create_directory("runs/-.-my-drops-fit-007");
  EXPECT_EQ(folder.Write({{"run.json", "{}"}}), "runs/-.-my-drops-fit-008");
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace hoplab
