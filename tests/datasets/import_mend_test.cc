// --mend-times: what is done to repeated and swapped stamps, and what is still refused.

#include <gtest/gtest.h>

#include "datasets/import/mend_times.h"
#include "datasets/read_dataset.h"
#include "tests/datasets/import_samples.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::ImportFile;
using testing::InputErrorOf;

class MendTimesTest : public ::testing::Test {
 protected:
  ImportResult Import(const std::string& rows, bool zero_time = false) {
    testing::WriteText(temp_.path() / "log.csv", "t [ms],z [mm]\n" + rows);
    TraceOptions options;
    options.mend_times = true;
    options.zero_time = zero_time;
    return ImportFile(temp_.path() / "log.csv", {"t=t", "y=z"}, options);
  }
  std::string Csv(const std::string& rows) { return Import(rows).files.at("log.csv"); }
  testing::TempFolder temp_;
};

TEST_F(MendTimesTest, AWholeLogIsLeftAsItIs) {
  const ImportResult made = Import("0,300\n2,299\n4,298\n");
  EXPECT_EQ(made.files.at("log.csv"), "time_s,body_y_m\n0.000,0.300\n0.002,0.299\n0.004,0.298\n");
  EXPECT_FALSE(made.logs[0].trace.mended.any());
  EXPECT_TRUE(made.notes.empty());
}

TEST_F(MendTimesTest, SwappedRowsAreSortedByTheirStamps) {
  const ImportResult made = Import("0,300\n4,298\n2,299\n6,297\n");
  EXPECT_EQ(made.files.at("log.csv"),
            "time_s,body_y_m\n0.000,0.300\n0.002,0.299\n0.004,0.298\n0.006,0.297\n");
  EXPECT_EQ(made.logs[0].trace.mended.swapped, 2u);
}

TEST_F(MendTimesTest, ARowWrittenTwiceIsDropped) {
  EXPECT_EQ(Csv("0,300\n2,299\n2,299\n4,298\n"),
            "time_s,body_y_m\n0.000,0.300\n0.002,0.299\n0.004,0.298\n");
}

TEST_F(MendTimesTest, RowsThatShareAStampOfACoarseClockAreSpreadUpToTheNext) {
  EXPECT_EQ(Csv("0,300\n2,299\n2,298\n2,297\n2,296\n4,295\n"),
            "time_s,body_y_m\n0.000,0.300\n0.002,0.299\n0.0025,0.298\n0.003,0.297\n0.0035,0.296\n"
            "0.004,0.295\n");
}

TEST_F(MendTimesTest, TheLastRowsAreSpreadByTheStepBeforeThem) {
  EXPECT_EQ(Csv("0,300\n2,299\n2,298\n"),
            "time_s,body_y_m\n0.000,0.300\n0.002,0.299\n0.003,0.298\n");
}

TEST_F(MendTimesTest, TheLastRowsAreSpreadAsThoseThatShareTheStampBefore) {
  std::string rows;
  for (int i = 0; i < 12; ++i)
    rows += std::to_string(10 * (i / 4)) + "," + std::to_string(300 - i) + "\n";
  const std::string csv = Csv(rows);
  EXPECT_TRUE(csv.ends_with("0.020,0.292\n0.0225,0.291\n0.025,0.290\n0.0275,0.289\n")) << csv;
}

TEST_F(MendTimesTest, TimeMayBeginAtTheFirstRowKept) {
  EXPECT_EQ(Import("12,299\n10,300\n14,298\n", true).files.at("log.csv"),
            "time_s,body_y_m\n0.000,0.300\n0.002,0.299\n0.004,0.298\n");
}

TEST_F(MendTimesTest, WhatWasDoneIsToldInTheOutputAndInTheDataset) {
  const ImportResult made = Import("0,300\n4,298\n2,299\n4,298\n6,297\n6,296\n8,295\n");
  const std::string told =
      "2 rows put in the order of their stamps, 1 repeated row dropped, 1 row that shared a stamp "
      "spread up to the next one";
  ASSERT_EQ(made.notes.size(), 1u);
  EXPECT_EQ(made.notes[0], (temp_.path() / "log.csv").string() + ": " + told);
  EXPECT_NE(made.files.at("dataset.yaml").find("; stamps of log.csv mended: " + told),
            std::string::npos)
      << made.files.at("dataset.yaml");
}

TEST_F(MendTimesTest, AClockThatWasSetBackIsStillRefused) {
  std::string rows;
  for (int i = 0; i < 20; ++i)
    rows += std::to_string(2 * (i % 10)) + "," + std::to_string(300 - i) + "\n";
  const std::string error = InputErrorOf([&] { Import(rows); });
  EXPECT_NE(error.find("lies more than 8 rows from where its stamp belongs: the clock was set"),
            std::string::npos)
      << error;
  EXPECT_NE(error.find("--cut"), std::string::npos) << error;
}

TEST_F(MendTimesTest, WithoutTheOptionTheRemedyNamesIt) {
  testing::WriteText(temp_.path() / "log.csv", "t [ms],z [mm]\n0,300\n0,299\n");
  const std::string error = InputErrorOf([&] {
    ImportFile(temp_.path() / "log.csv", {"t=t", "y=z"});
  });
  EXPECT_NE(error.find("or say --mend-times."), std::string::npos) << error;
}

}  // namespace
}  // namespace hoplab
