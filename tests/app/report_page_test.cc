#include "app/reports/report_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "app/records/csv.h"
#include "app/reports/headline.h"
#include "base/check.h"
#include "web/assets.h"

namespace hoplab {
namespace {

Json SmallFit() {
  Json record = {
      {"schema", kRunSchema}, {"command", "fit"}, {"status", "ok"}, {"dataset", "drops"}};
  record["parameters"] = {{{"name", "E"},
                           {"unit", "Pa"},
                           {"value", 22.976e9},
                           {"ci95", {22.96e9, 22.99e9}},
                           {"ci95_between_trials", {22.79e9, 23.16e9}}}};
  record["channels"] = {{{"name", "body_x_m"}, {"sigma", 0.0005}},
                        {{"name", "body_y_m"}, {"sigma", 0.0005}}};
  record["train"] = {{"rmse", {{"body_x_m", 0.0007}, {"body_y_m", 0.0029}}}};
  record["test"] = {{"rmse", {{"body_x_m", 0.000723}, {"body_y_m", 0.00302}}}};
  record["misfit"] = true;
  record["chi2_per_dof"] = 17.56;
  return record;
}

// Instrumented code takes several times as long; the bound is that of the program.
#ifdef HOPLAB_SANITIZE
constexpr double kLongestWrite = 15.0;  // s
#else
constexpr double kLongestWrite = 1.0;  // s
#endif

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(ReportPage, NothingInARunEndsTheScriptItStandsIn) {
  Json record = SmallFit();
  record["dataset"] = "</script><script>alert(1)</script><!-- \xc3\xa9 \xe2\x80\xa8 \xff";
  record["notes"] = {"</SCRIPT >", "<!--"};
  const std::string page = ReportPage(record, {{"a.csv", "word\n</script><!--\n"}});
  // The template's own: run, explanations, tables, plotting library (two), the line between them,
  // the report.
  EXPECT_EQ(Count(page, "</script"), 7u);
  EXPECT_EQ(Count(page, "</SCRIPT"), 0u);
  EXPECT_EQ(Count(page, "<!--"), 0u);
  EXPECT_NE(page.find("&lt;/script&gt;"), std::string::npos) << "the title shows it as text";
  EXPECT_NE(page.find("\\u003c/script>"), std::string::npos);
}

TEST(ReportPage, TheRecordReadsBackFromThePage) {
  Json record = SmallFit();
  record["notes"] = {"a < b & c > d", "caf\xc3\xa9", "{{style}}"};
  record["cost"] = nullptr;
  const std::string page = ReportPage(record, {});
  const std::string open = "<script type=\"application/json\" id=\"run\">";
  const std::size_t begin = page.find(open) + open.size();
  const Json found = Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  for (const auto& [key, value] : record.items()) EXPECT_EQ(found.at(key), value) << key;
}

TEST(ReportPage, NeedsNothingButItself) {
  const std::string page = ReportPage(SmallFit(), {});
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("<link"), std::string::npos);
  EXPECT_EQ(page.find("{{"), page.find("{{", page.find("id=\"run\""))) << "a place was not filled";
  EXPECT_NE(page.find("Plotly Technologies"), std::string::npos) << "the library's licence";
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
}

TEST(ReportPage, SurfacesAloneBringTheSecondLibrary) {
  Json record = SmallFit();
  record["figures"] = {{{"name", "a"}, {"kind", "lines"}}};
  const std::size_t flat = ReportPage(record, {}).size();
  record["figures"].push_back({{"name", "b"}, {"kind", "surface"}, {"columns", {1, 2, 3, 4}}});
  const std::size_t both = ReportPage(record, {}).size();
  EXPECT_GT(both, flat + WebAsset("plotly-3d.js").size());
}

TEST(ReportPage, OfALongRunIsBelowSixMegabytesAndWrittenInASecond) {
  // 100 trials of 20 s at 250 Hz: 40 MB of CSV.
  CsvText residuals({"trial", "time_s", "channel", "measured", "simulated", "whitened"});
  CsvText trajectories({"trial", "time_s", "body_x_m", "body_y_m", "leg_angle_rad", "mode"});
  for (int trial = 0; trial < 100; ++trial) {
    const std::string name = "train-" + std::to_string(trial) + ".csv";
    for (int row = 0; row < 5000; ++row) {
      const double t = 0.004 * row, v = std::sin(12.9898 * row + trial);
      residuals.Cell(name).Cell(t).Cell(row % 2 ? "body_x_m" : "body_y_m");
      residuals.Cell(v).Cell(v + 1e-3 * v * v).Cell(3.0 * v).EndRow();
      if (row % 5) continue;
      trajectories.Cell(name).Cell(t).Cell(t).Cell(v).Cell(v * v).Cell("flight").EndRow();
    }
  }
  Json record = SmallFit();
  record["figures"] = {
      {{"name", "b"}, {"kind", "surface"}, {"columns", {1, 2, 3, 4}}}};  // with both libraries
  record["starts"] = Json(std::vector<Json>(10000, {{"cost", 1.25}, {"status", "converged"}}));
  const std::map<std::string, std::string> files = {{"residuals.csv", residuals.text()},
                                                    {"trajectories.csv", trajectories.text()}};
  const std::clock_t begin = std::clock();
  const std::string page = ReportPage(record, files);
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  EXPECT_LT(page.size(), 6'000'000u);
  EXPECT_LT(seconds, kLongestWrite);
  RecordProperty("bytes", static_cast<int>(page.size()));
  RecordProperty("milliseconds", static_cast<int>(1e3 * seconds));
}

TEST(ReportHeadline, AFitBeginsWithItsFirstValueItsErrorAndItsMisfit) {
  const Headline headline = HeadlineOf(SmallFit());
  EXPECT_EQ(headline.title, "Fit of drops");
  EXPECT_EQ(headline.sentence,
            "E = 22.98 GPa reproduces body_x within 0.723 mm and body_y within 3.02 mm of trials "
            "that were not fitted; the model misses more than the noise.");
  ASSERT_EQ(headline.figures.size(), 3u);
  EXPECT_EQ(headline.figures[0].value, "22.98");
  EXPECT_EQ(headline.figures[0].unit, "GPa");
  EXPECT_EQ(headline.figures[0].note, "95 % between trials: 22.79 to 23.16");
  EXPECT_EQ(headline.figures[1].label, "test error, body_y");
  EXPECT_EQ(headline.figures[1].value + headline.figures[1].unit, "3.02mm");
  EXPECT_EQ(headline.figures[1].pointer, "/test/rmse/body_y_m");
  EXPECT_EQ(headline.figures[2].value, "17.6");
}

TEST(ReportHeadline, WhatIsMissingIsNotComputedAndNeverZero) {
  for (const char* command : {"check", "fit", "diagnose", "design", "gait", "optimize", "sweep",
                              "simulate", "reproduce", "something new"}) {
    const Headline headline = HeadlineOf({{"command", command}});
    EXPECT_FALSE(headline.sentence.empty()) << command;
    for (const HeadlineFigure& figure : headline.figures) {
      const bool is_count = figure.pointer == "/rows" || figure.pointer == "/trials" ||
                            figure.pointer == "/claims" || figure.pointer == "/tables" ||
                            figure.pointer == "/figures";
      if (is_count) continue;
      EXPECT_EQ(figure.value, "not computed") << command << figure.label;
    }
  }
}

TEST(ReportPage, ARecordOfWrongTypesIsNoReasonToStop) {
  for (const char* command : {"check", "fit", "diagnose", "design", "gait", "optimize", "sweep",
                              "simulate", "reproduce"}) {
    const Json record = {{"command", command},
                         {"status", 3},
                         {"parameters", 5},
                         {"channels", {Json::object(), 1, "x"}},
                         {"test", {{"rmse", {1}}}},
                         {"best", {{"parameters", {{"kp", "much"}}}}},
                         {"figures", {{{"kind", 2}}, 4}},
                         {"rows", "none"},
                         {"claims", {1, nullptr}},
                         {"apex_energies", {{{"energy_J", "x"}}}}};
    EXPECT_NO_THROW(ReportPage(record, {})) << command;
  }
}

TEST(ReportHeadline, OfAFailedRunIsItsMessage) {
  Json record = {{"command", "gait"}, {"scenario", "steep"}, {"status", "failed"}};
  record["message"] = "no fixed point was found near the start";
  EXPECT_EQ(HeadlineOf(record).sentence, "no fixed point was found near the start.");
}

TEST(ReportHeadline, ASimulatedRobotIsNoHopper) {
  Json record = {{"command", "simulate"}, {"law", "robot"}, {"hops", 17}, {"end_time_s", 5.0}};
  record["outcome_sentence"] = "ran to the end";
  EXPECT_EQ(HeadlineOf(record).sentence, "The robot ran to the end, 5.000 s.");
  record["law"] = "elastica";
  EXPECT_EQ(HeadlineOf(record).sentence, "The hopper ran to the end: 17 hops in 5.000 s.");
}

TEST(ReportHeadline, ADiagnosisSpeaksItsVerdict) {
  Json record = {{"command", "diagnose"}, {"dataset", "drops"}, {"verdict", "named"}};
  record["sentence"] = "The simulation lacks air_drag.";
  record["candidates"] = {Json::object(), Json::object()};
  record["channels"] = {{{"name", "body_x_m"}, {"sigma", 0.001}}};
  record["null"] = {{"test", {{"rmse", {{"body_x_m", 0.00885}}}}}};
  record["extension"] = {{"explained", 0.9912},
                         {"test_after", {{"rmse", {{"body_x_m", 0.000562}}}}},
                         {"heldout_gain", {{"nats_per_sample", 102.3}, {"ci95", {60.4, 153.0}}}}};
  const Headline headline = HeadlineOf(record);
  EXPECT_EQ(headline.sentence, "The simulation lacks air_drag.");
  ASSERT_EQ(headline.figures.size(), 3u);
  EXPECT_EQ(headline.figures[0].value + headline.figures[0].unit, "99.1%");
  EXPECT_EQ(headline.figures[1].value, "0.562");
  EXPECT_EQ(headline.figures[1].note, "8.85 mm before");
  EXPECT_EQ(headline.figures[1].pointer, "/extension/test_after/rmse/body_x_m");
  EXPECT_EQ(headline.figures[2].note, "95 %: 60.4 to 153");
}

TEST(WebAssets, TheLibrariesCanStandInAScriptElement) {
  for (const char* name : {"plotly.js", "plotly-3d.js", "report.js"}) {
    EXPECT_EQ(WebAsset(name).find("</script"), std::string_view::npos) << name;
    EXPECT_EQ(WebAsset(name).find("<!--"), std::string_view::npos) << name;
  }
  EXPECT_THROW(WebAsset("nothing"), BugError);
}

}  // namespace
}  // namespace hoplab
