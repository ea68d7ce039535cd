#include "app/reports/report_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/records/csv.h"
#include "base/nan.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::InputErrorOf;

std::string Decoded(const std::string& base64) {
  std::string out;
  unsigned word = 0;
  int bits = 0;
  for (const char c : base64) {
    if (c == '=') break;
    const unsigned digit = c >= 'a'   ? c - 'a' + 26
                           : c >= 'A' ? c - 'A'
                           : c == '+' ? 62
                           : c == '/' ? 63
                                      : c - '0' + 52;
    word = word << 6 | digit;
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      out += static_cast<char>(word >> bits & 255U);
    }
  }
  return out;
}

template <class Number>
std::vector<Number> Unpacked(const std::string& base64) {
  const std::string bytes = Decoded(base64);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

TEST(ReportTable, ReadsBackWhatCsvTextWrites) {
  CsvText csv({"trial", "time_s", "value"});
  csv.Cell("a, \"b\"\nc").Cell(0.1).Cell(std::nan("")).EndRow();
  csv.Cell("d").Cell(1.0 / 3.0).Cell(-2.5e-300).EndRow();
  const Json packed = ReportTable("t.csv", csv.text()).Packed(100);
  EXPECT_EQ(packed.at("rows"), 2);
  EXPECT_EQ(packed.at("shown"), 2);
  const Json& columns = packed.at("columns");
  EXPECT_EQ(columns.at(0).at("words"), Json({"a, \"b\"\nc", "d"}));
  EXPECT_EQ(Unpacked<std::uint16_t>(columns.at(0).at("places")),
            (std::vector<std::uint16_t>{0, 1}));
  EXPECT_EQ(columns.at(1).at("bits"), 64);
  EXPECT_EQ(Unpacked<double>(columns.at(1).at("numbers")), (std::vector<double>{0.1, 1.0 / 3.0}));
  const std::vector<double> values = Unpacked<double>(columns.at(2).at("numbers"));
  EXPECT_TRUE(std::isnan(values.at(0))) << "not computed is no number, and not 0";
  EXPECT_EQ(values.at(1), -2.5e-300);
}

TEST(ReportTable, AColumnThatTurnsToWordsKeepsItsFirstRows) {
  const Json packed = ReportTable("t.csv", "reason\n\n12\nfell\n").Packed(100);
  const Json& column = packed.at("columns").at(0);
  EXPECT_EQ(column.at("words"), Json({"", "12", "fell"}));
}

TEST(ReportTable, ThinningKeepsTheExtremesAndTheEndsOfEverySeries) {
  constexpr int kRows = 5000, kSpike = 3217;
  CsvText csv({"trial", "channel", "time_s", "whitened"});
  for (int row = 0; row < kRows; ++row) {
    for (const char* channel : {"x", "y"}) {
      const bool spike = row == kSpike && channel[0] == 'y';
      csv.Cell("a.csv").Cell(channel).Cell(0.01 * row).Cell(spike ? -40.0 : std::sin(row)).EndRow();
    }
  }
  const ReportTable table("residuals.csv", csv.text());
  const std::vector<std::size_t> kept = table.Thinned(1000);
  EXPECT_LE(kept.size(), 1100u);
  EXPECT_GE(kept.size(), 800u);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), 2u * kSpike + 1));
  EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), 2u * kRows - 2));
  EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), 2u * kRows - 1));
}

// A stretch may begin with a sample that is missing.
TEST(ReportTable, ThinningKeepsTheExtremesBesideMissingCells) {
  constexpr int kRows = 10'000, kHigh = 4321, kLow = 7654;
  CsvText csv({"time_s", "whitened"});
  for (int row = 0; row < kRows; ++row) {
    const double value = row == kHigh ? 40.0 : row == kLow ? -40.0 : std::sin(row);
    csv.Cell(0.01 * row).Cell(row % 2 == 0 && row != kLow ? kNaN : value).EndRow();
  }
  const std::vector<std::size_t> kept = ReportTable("residuals.csv", csv.text()).Thinned(1000);
  for (const int row : {kHigh, kLow})
    EXPECT_TRUE(std::binary_search(kept.begin(), kept.end(), static_cast<std::size_t>(row))) << row;
}

TEST(ReportTable, ManyShortSeriesAreThinnedToo) {
  CsvText csv({"trial", "hop"});
  for (int row = 0; row < 3000; ++row) csv.Cell("trial-" + std::to_string(row)).Cell(0.0).EndRow();
  EXPECT_LE(ReportTable("hops.csv", csv.text()).Thinned(500).size(), 1000u);
}

TEST(ReportTable, WhatIsNoTableIsToldWithItsPlace) {
  EXPECT_NE(InputErrorOf([] { ReportTable("t.csv", ""); }).find("t.csv: is empty"),
            std::string::npos);
  EXPECT_NE(InputErrorOf([] { ReportTable("t.csv", "a,b\n1,2\n3\n"); }).find("t.csv:3: 1; cells"),
            std::string::npos);
  EXPECT_NE(InputErrorOf([] { ReportTable("t.csv", "a\n\"open\n"); }).find("t.csv:2"),
            std::string::npos);
}

}  // namespace
}  // namespace hoplab
