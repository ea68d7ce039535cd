// A recorded fall as loggers of other kinds write it: times of a clock, titles in a comment.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "datasets/import/clock_text.h"
#include "tests/datasets/import_samples.h"

namespace hoplab {
namespace {

using testing::Fall;
using testing::FallCsv;
using testing::ImportFile;

class ImportTexts : public testing::FallImport {};

// The fall as rows of a text file: `time` writes the instant of a row, after 10:00:00.
std::string FallText(const Fall& fall, const std::string& titles,
                     const std::function<std::string(double)>& time) {
  std::string text = titles + "\n";
  for (std::size_t i = 0; i < fall.t_s.size(); ++i)
    text += time(fall.t_s[i]) + "," + testing::Format("%.2f", fall.x_mm[i]) + "," +
            testing::Format("%.2f", fall.y_mm[i]) + "\n";
  return text;
}

TEST_F(ImportTexts, TimesOfAClockAreReadAsSeconds) {
  const auto clock = [](const std::string& before, const std::string& after) {
    return [=](double t) { return before + "10:00:0" + testing::Format("%.3f", t) + after; };
  };
  for (const auto& time : {clock("", ""), clock("2026-05-01T", "Z"), clock("2026-05-01 ", "+02:00"),
                           clock("2026/05/01 ", ""), clock("1.5.2026 ", "")}) {
    const std::string text = FallText(fall_, "stamp,X (mm),Y (mm)", time);
    const ImportResult result = ImportFile(Write("drop.csv", text), {"t=stamp", "x=X", "y=Y"});
    EXPECT_EQ(CsvOf(result), FallCsv(fall_)) << time(0.1);
  }
}

TEST_F(ImportTexts, AClockGoesOnOverMidnightWhereItHasADate) {
  const auto time = [](double t) {
    const int ms = 990 + static_cast<int>(std::lround(1e3 * t));
    const std::string fraction = testing::Format("%03.0f", static_cast<double>(ms % 1000));
    return (ms < 1000 ? "2026-02-28T23:59:59." : "2026-03-01T00:00:00.") + fraction;
  };
  const std::string text = FallText(fall_, "stamp,X (mm),Y (mm)", time);
  const std::string csv = CsvOf(ImportFile(Write("drop.csv", text), {"t=stamp", "x=X", "y=Y"}));
  EXPECT_NE(csv.find("\n0.998,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n1.002,"), std::string::npos) << csv;
}

TEST_F(ImportTexts, AClockWithoutADatePassesMidnightWhereItGoesBack) {
  const auto time = [](double t) {
    const int ms = 990 + static_cast<int>(std::lround(1e3 * t));
    const std::string fraction = testing::Format("%03.0f", static_cast<double>(ms % 1000));
    return (ms < 1000 ? "23:59:59." : "00:00:00.") + fraction;
  };
  const std::string text = FallText(fall_, "stamp,X (mm),Y (mm)", time);
  const ImportResult made = ImportFile(Write("drop.csv", text), {"t=stamp", "x=X", "y=Y"});
  EXPECT_NE(CsvOf(made).find("\n0.998,"), std::string::npos) << CsvOf(made);
  EXPECT_NE(CsvOf(made).find("\n1.002,"), std::string::npos) << CsvOf(made);
  EXPECT_NE(made.notes.at(0).find("past midnight"), std::string::npos) << made.notes[0];
}

TEST_F(ImportTexts, HalvesOfTheDayAreRead) {
  const auto seconds = [](const char* text) { return ParseClockText(text).value().second; };
  EXPECT_EQ(seconds("12:00:01 AM"), 1);
  EXPECT_EQ(seconds("12:00:01 pm"), 12 * 3600 + 1);
  EXPECT_EQ(seconds("1:00:00.5 p.m."), 13 * 3600);
  EXPECT_EQ(seconds("5/1/2026 11:59:59 PM"), 86399);
  EXPECT_FALSE(ParseClockText("13:00:00 PM"));
  EXPECT_FALSE(ParseClockText("0:00:00 AM"));
  // Over noon.
  const auto time = [](double t) {
    const int ms = 990 + static_cast<int>(std::lround(1e3 * t));
    const std::string fraction = testing::Format("%03.0f", static_cast<double>(ms % 1000));
    return ms < 1000 ? "11:59:59." + fraction + " AM" : "12:00:00." + fraction + " PM";
  };
  const std::string text = FallText(fall_, "stamp,X (mm),Y (mm)", time);
  const std::string csv = CsvOf(ImportFile(Write("drop.csv", text), {"t=stamp", "x=X", "y=Y"}));
  EXPECT_NE(csv.find("\n1.002,"), std::string::npos) << csv;
}

// Quotes within a quoted title are doubled, and a separator there is none.
TEST_F(ImportTexts, QuotedTitlesHaveTheirQuotes) {
  const auto seconds = [](double t) { return testing::Format("%.3f", t); };
  const std::string text = FallText(fall_, "\"t\",\"x \"\"a\"\", left\",\"y\"\"q\"", seconds);
  const ImportResult made =
      ImportFile(Write("drop.csv", text), {"t=t:s", "x=x \"a\", left:mm", "y=y\"q:mm"});
  EXPECT_EQ(CsvOf(made), FallCsv(fall_));
}

TEST_F(ImportTexts, WhatIsNoClockStaysAsItIs) {
  for (const char* text : {"10:00", "a:10:00:00", "10:61:00", "10:00:00x", "25:00:00", "", "1.5",
                           "2026-05-01", "10:00:00+2"})
    EXPECT_FALSE(ParseClockText(text)) << text;
}

// Rows of a logger's settings above the titles, times of a clock among them.
TEST_F(ImportTexts, AClockAboveTheTitlesIsNoSample) {
  for (const char* above : {"Time,10:00:00,\nRate,500,\n", "10:00:00,on,\n10:00:01,trigger,\n"}) {
    const auto seconds = [](double t) { return testing::Format("%.3f", t); };
    const std::string text = FallText(fall_, std::string(above) + "time_s,X (mm),Y (mm)", seconds);
    const ImportResult result = ImportFile(Write("drop.csv", text), {"t=time_s", "x=X", "y=Y"});
    EXPECT_EQ(CsvOf(result), FallCsv(fall_)) << above;
  }
}

TEST_F(ImportTexts, ACommentWithoutATimeIsNoTitles) {
  const auto seconds = [](double t) { return testing::Format("%.3f", t); };
  const std::string text = FallText(fall_, "# leg A, PLA, drop from 2 m", seconds);
  const ImportResult result = ImportFile(Write("drop.csv", text), {"t=#1:s", "x=#2:mm", "y=#3:mm"});
  EXPECT_EQ(CsvOf(result), FallCsv(fall_));
}

// The unit of body_x is told by the height that falls, wherever that stands.
TEST_F(ImportTexts, AUnitIsToldByTheHeight) {
  const auto seconds = [](double t) { return testing::Format("%.3f", t); };
  const std::string text = FallText(fall_, "time_s,body_x,body_y", seconds);
  EXPECT_EQ(CsvOf(ImportFile(Write("drop.csv", text), {})), FallCsv(fall_));
}

TEST_F(ImportTexts, TitlesMayStandInAComment) {
  for (const char* titles : {"# time_s,x_mm,y_mm", "%time_s,x_mm,y_mm", "// time_s,x_mm,y_mm",
                             "\xEF\xBB\xBF# time_s,x_mm,y_mm"}) {
    const auto seconds = [](double t) { return testing::Format("%.3f", t); };
    const ImportResult result = ImportFile(Write("drop.csv", FallText(fall_, titles, seconds)), {});
    EXPECT_EQ(CsvOf(result), FallCsv(fall_)) << titles;
  }
}

}  // namespace
}  // namespace hoplab
