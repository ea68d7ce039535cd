// Runs side by side: what is held against what, by figures done by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "app/records/comparison_record.h"
#include "app/reports/comparison_report.h"
#include "base/input_error.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::InputErrorOf;

Json Parameter(const std::string& name, double value, double half, double between = 0.0) {
  Json p = {{"name", name},
            {"unit", "Pa"},
            {"value", value},
            {"ci95", Json::array({value - half, value + half})},
            {"ci95_between_trials", nullptr}};
  if (between > 0.0) p["ci95_between_trials"] = Json::array({value - between, value + between});
  return p;
}

Json FitOf(const std::string& dataset, const Json& parameters, bool misfit = false) {
  return {{"schema", kRunSchema},
          {"command", "fit"},
          {"status", "ok"},
          {"dataset", dataset},
          {"law", "elastica"},
          {"options", {{"dataset", dataset}, {"starts", 1}}},
          {"parameters", parameters},
          {"misfit", misfit},
          {"trials", Json::array({{{"file", "a.csv"}}})},
          {"test", {{"rmse", {{"body_y_m", 1e-3}}}, {"nll_per_sample", -5.0}}},
          {"train", {{"rmse", {{"body_y_m", 2e-3}}}}},
          {"chi2_per_dof", 1.2},
          {"mechanism", {{"parameters", {{"m", 1.0}, {"E", 1.0}}}}}};
}

Json Compare(const std::vector<Json>& records) {
  std::vector<ComparedRun> runs;
  for (std::size_t i = 0; i < records.size(); ++i)
    runs.push_back({"runs/" + std::string(1, static_cast<char>('a' + i)), {records[i], {}}});
  return ComparisonRecord(runs);
}

TEST(Comparison, ADifferenceJoinsTheIntervalsOfBoth) {
  const Json record = Compare({FitOf("old", Json::array({Parameter("E", 100.0, 3.0)})),
                               FitOf("new", Json::array({Parameter("E", 110.0, 4.0)}))});
  const Json& own = record["values"][0]["runs"][1];
  EXPECT_DOUBLE_EQ(own["difference"].get<double>(), 10.0);
  EXPECT_NEAR(own["difference_ci95"][0].get<double>(), 5.0, 1e-12);  // 10 -+ hypot(3, 4)
  EXPECT_NEAR(own["difference_ci95"][1].get<double>(), 15.0, 1e-12);
  EXPECT_NEAR(own["z"].get<double>(), 2.0 * 1.959963984540054, 1e-12);
  EXPECT_NEAR(own["p_value"].get<double>(), 8.857e-5, 1e-8);  // of a normal at 3.92
  EXPECT_EQ(own["clear"], Json(true));
  EXPECT_TRUE(record["values"][0]["runs"][0]["difference"].is_null());
  EXPECT_NE(record["sentence"].get<std::string>().find("E rose from 100.0 to 110.0 Pa (z = 3.9)"),
            std::string::npos)
      << record["sentence"];
}

TEST(Comparison, WhereAModelMissesMoreThanTheNoiseTheIntervalBetweenTrialsCounts) {
  const Json p = Parameter("E", 100.0, 3.0, 12.0), q = Parameter("E", 110.0, 4.0, 5.0);
  const Json noise = Compare({FitOf("old", Json::array({p})), FitOf("new", Json::array({q}))});
  const Json misfit =
      Compare({FitOf("old", Json::array({p}), true), FitOf("new", Json::array({q}), true)});
  const auto half = [](const Json& record) {
    const Json& range = record["values"][0]["runs"][1]["difference_ci95"];
    return 0.5 * (range[1].get<double>() - range[0].get<double>());
  };
  EXPECT_NEAR(half(noise), 5.0, 1e-12);
  EXPECT_NEAR(half(misfit), 13.0, 1e-12);
}

// p of 0.02 each: alone it is clear, one of three it is not (Holm: 0.05/3).
TEST(Comparison, OfManyValuesOneIsNotClearByChance) {
  const double z = 2.3263478740408408, half = 1.959963984540054 * std::sqrt(0.5);
  const auto fit = [&](const std::string& dataset, double by, int count) {
    Json parameters = Json::array();
    for (int i = 0; i < count; ++i)
      parameters.push_back(Parameter("p" + std::to_string(i), 10.0 + (i == 0 ? by : 0.0), half));
    return FitOf(dataset, parameters);
  };
  EXPECT_EQ(Compare({fit("old", 0.0, 1), fit("new", z, 1)})["clear_changes"], Json(1));
  EXPECT_EQ(Compare({fit("old", 0.0, 3), fit("new", z, 3)})["clear_changes"], Json(0));
}

TEST(Comparison, RunsOnTheSameRecordingsHaveNoIntervalOfTheirDifference) {
  const Json record = Compare({FitOf("old", Json::array({Parameter("E", 100.0, 3.0)})),
                               FitOf("old", Json::array({Parameter("E", 110.0, 4.0)}))});
  const Json& own = record["values"][0]["runs"][1];
  EXPECT_DOUBLE_EQ(own["difference"].get<double>(), 10.0);
  EXPECT_TRUE(own["difference_ci95"].is_null());
  EXPECT_TRUE(own["z"].is_null());
  EXPECT_NE(record["sentence"].get<std::string>().find("the same recordings"), std::string::npos);
}

TEST(Comparison, WhatOneRunDoesNotHaveIsNullAndWhatDiffersIsListed) {
  Json other = FitOf("new", Json::array({Parameter("d", 2.0, 0.1)}));
  other["law"] = "thesis";
  other["options"]["starts"] = 8;
  other["mechanism"]["parameters"]["m"] = 1.1;
  const Json record = Compare({FitOf("old", Json::array({Parameter("E", 100.0, 3.0)})), other});
  ASSERT_EQ(record["values"].size(), 2u);
  EXPECT_TRUE(record["values"][0]["runs"][1]["value"].is_null());
  EXPECT_TRUE(record["values"][1]["runs"][0]["value"].is_null());
  EXPECT_TRUE(record["values"][1]["runs"][1]["difference"].is_null());
  std::vector<std::string> changed;
  for (const Json& each : record["changed"]) changed.push_back(each["key"].get<std::string>());
  EXPECT_EQ(changed, (std::vector<std::string>{"dataset", "law", "dataset folder", "starts", "m"}))
      << "not E, which one of them fitted";
  EXPECT_EQ(record["errors"][0]["values"], (Json::array({1e-3, 1e-3})));
  const std::string text = ComparisonReport(record, false);
  EXPECT_NE(text.find("thesis"), std::string::npos);
  EXPECT_NE(ComparisonTable(record).find("\nE,Pa,a,100,97,103,,,,\n"), std::string::npos)
      << ComparisonTable(record);
}

TEST(Comparison, OfADiagnosisTheValuesAreThoseOfTheModelWithItsCauses) {
  Json diagnosis = {
      {"schema", kRunSchema},
      {"command", "diagnose"},
      {"status", "ok"},
      {"dataset", "new"},
      {"verdict", "named"},
      {"options", {{"dataset", "new"}}},
      {"null", {{"parameters", Json::array({Parameter("E", 1.0, 0.1)})}, {"chi2_per_dof", 9.0}}},
      {"extension",
       {{"parameters", Json::array({Parameter("E", 2.0, 0.1)})},
        {"chi2_per_dof", 1.0},
        {"test_after", {{"rmse", {{"body_y_m", 5e-4}}}}}}},
      {"causes",
       {{{"name", "air_drag"},
         {"share", 0.9},
         {"probability", 0.8},
         {"parameters", Json::array()}}}}};
  const Json first = FitOf("old", Json::array({Parameter("E", 3.0, 0.1)}));
  const auto value = [&] {
    return Compare({first, diagnosis})["values"][0]["runs"][1]["value"].get<double>();
  };
  EXPECT_EQ(value(), 2.0);
  const Json record = Compare({first, diagnosis});
  EXPECT_EQ(record["causes"][0]["runs"][0]["looked_for"], Json(false));
  EXPECT_EQ(record["causes"][0]["runs"][1]["share"], Json(0.9));
  diagnosis["verdict"] = "unexplained";
  EXPECT_EQ(value(), 1.0);
}

TEST(Comparison, ARunWithoutValuesIsRefusedWithItsPlace) {
  const Json fit = FitOf("old", Json::array({Parameter("E", 100.0, 3.0)}));
  Json sweep = fit, failed = fit;
  sweep["command"] = "sweep";
  failed["status"] = "failed";
  failed["message"] = "nothing fell";
  const auto of = [&](const Json& other) { return InputErrorOf([&] { Compare({fit, other}); }); };
  EXPECT_EQ(of(sweep),
            "runs/b/run.json: command = sweep; must be fit or diagnose: other runs have no values "
            "to compare. Give folders that fit or diagnose wrote.");
  EXPECT_EQ(of(failed),
            "runs/b/run.json: status = failed; must have a result: there is nothing to compare. "
            "nothing fell");
}

}  // namespace
}  // namespace hoplab
