// Every kind of bad trace that the format names: the whole message is compared.

#include <gtest/gtest.h>

#include <string>

#include "datasets/read_dataset.h"
#include "tests/datasets/small_dataset.h"

namespace hoplab {
namespace {

using testing::ErrorOf;
using testing::ErrorWithCsv;
using testing::kYaml;

TEST(BadDataset, TimeMustIncrease) {
  EXPECT_EQ(ErrorWithCsv("0.02,", "0.005,"),
            "hops/a.csv:4: time_s = 0.005; must be greater than the time before, 0.01. "
            "Sort the rows by time and remove repeated ones; hoplab import --mend-times does.");
}

TEST(BadDataset, TimeMayNotStandStill) {
  EXPECT_EQ(ErrorWithCsv("0.02,", "0.01,"),
            "hops/a.csv:4: time_s = 0.01; must be greater than the time before, 0.01. "
            "Sort the rows by time and remove repeated ones; hoplab import --mend-times does.");
}

TEST(BadDataset, EveryRowNeedsATime) {
  EXPECT_EQ(ErrorWithCsv("0.02,", "nan,"),
            "hops/a.csv:4: time_s = nan; every row must have a time. Remove the row.");
}

TEST(BadDataset, ACellThatIsNoNumberIsReportedWithItsColumn) {
  EXPECT_EQ(
      ErrorWithCsv("0.298", "high"),
      "hops/a.csv:4: body_y_m = high; is not a number. Write a number with a decimal point, or "
      "leave the cell empty if it is missing.");
}

TEST(BadDataset, LineNumbersCountCommentsAndBlankLines) {
  EXPECT_EQ(
      ErrorWithCsv("0.01,0.01,0.2995\n0.02,0.02,0.298", "# a comment\n\n0.02,0.02,high"),
      "hops/a.csv:5: body_y_m = high; is not a number. Write a number with a decimal point, or "
      "leave the cell empty if it is missing.");
}

TEST(BadDataset, ARaggedRowIsReportedWithBothLengths) {
  EXPECT_EQ(ErrorWithCsv("0.02,0.02,0.298", "0.02,0.298"),
            "hops/a.csv:4: 2 cells; must have 3, one for each column. "
            "Look for a missing or a stray comma.");
}

TEST(BadDataset, AnInfiniteSampleIsReported) {
  EXPECT_EQ(ErrorWithCsv("0.298", "inf"),
            "hops/a.csv:4: body_y_m = inf; must be a finite number. "
            "Leave the cell empty if the sample is missing.");
}

TEST(BadDataset, ASampleOutOfItsRangeIsReported) {
  EXPECT_EQ(ErrorWithCsv("0.298", "2.98e9"),
            "hops/a.csv:4: body_y_m = 2.98e9; must be in [-1e6, 1e6] m. "
            "Check the unit: m is meant.");
}

TEST(BadDataset, ContactIsZeroOrOne) {
  EXPECT_EQ(ErrorOf(kYaml, "time_s,body_x_m,body_y_m,contact\n0,0,0.3,0\n1,0,0.2,0.5\n"),
            "hops/a.csv:3: contact = 0.5; must be 0 or 1. Write 1 while the leg is on the ground.");
}

TEST(BadDataset, TheFirstColumnIsTime) {
  EXPECT_EQ(ErrorWithCsv("time_s", "t"),
            "hops/a.csv:1: column t; the first column must be time_s. "
            "The first row names the columns, time in seconds first.");
}

TEST(BadDataset, TimeInMillisecondsIsToldHowTheColumnIsWritten) {
  EXPECT_EQ(ErrorWithCsv("time_s", "time_ms"),
            "hops/a.csv:1: column time_ms; the first column must be time_s. "
            "Rename it to time_s and give the times in s.");
}

TEST(BadDataset, SemicolonsDoNotSeparateCells) {
  EXPECT_EQ(ErrorOf(kYaml, "time_s;body_x_m\n0;0\n"),
            "hops/a.csv:1: column time_s;body_x_m; the first column must be time_s. "
            "Separate the cells by commas and write decimals with a point.");
}

TEST(BadDataset, AColumnMayNotStandTwice) {
  EXPECT_EQ(ErrorWithCsv("body_x_m", "body_y_m"),
            "hops/a.csv:1: column body_y_m; stands twice in the first row. "
            "Remove or rename one of the two.");
}

TEST(BadDataset, AColumnNeedsAName) {
  EXPECT_EQ(ErrorWithCsv("body_x_m", ""),
            "hops/a.csv:1: column 2; has no name. Name or remove the column.");
}

TEST(BadDataset, AnEmptyTraceIsReported) {
  EXPECT_EQ(ErrorOf(kYaml, "# nothing\n"),
            "hops/a.csv: is empty; must have a row of column names and samples. "
            "Begin with time_s,body_x_m,... and one row for each sample.");
}

TEST(BadDataset, ATraceWithoutSamplesIsReported) {
  EXPECT_EQ(ErrorOf(kYaml, "time_s,body_x_m,body_y_m\n"),
            "hops/a.csv:1: has column names but no samples. Add one row for each sample.");
}

TEST(BadDataset, TooManyColumnsAreRefused) {
  std::string header = "time_s";
  for (int i = 0; i < 64; ++i) header += ",c" + std::to_string(i);
  EXPECT_EQ(ErrorOf(kYaml, header + "\n"),
            "hops/a.csv:1: 65 columns; must have at most 64. Remove columns.");
}

}  // namespace
}  // namespace hoplab
