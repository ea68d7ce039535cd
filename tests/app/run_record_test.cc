#include "app/records/run_record.h"

#include <gtest/gtest.h>

#include <limits>

#include "app/records/csv.h"
#include "app/records/fit_record.h"
#include "app/records/fit_words.h"
#include "app/records/record_parts.h"
#include "app/reports/fit_report.h"
#include "app/runs/identify_settings.h"
#include "tests/datasets/small_dataset.h"

namespace hoplab {
namespace {

TEST(RunRecord, WhatIsNotComputedIsNull) {
  RecordHeader header;
  header.command = "fit";
  const Json record = NewRecord(header);
  EXPECT_EQ(record.at("status"), "ok");
  for (const char* key : {"dataset", "law", "seed", "seconds"})
    EXPECT_TRUE(record.at(key).is_null()) << key;
  EXPECT_TRUE(NumberOrNull(std::numeric_limits<double>::quiet_NaN()).is_null());
  EXPECT_TRUE(NumberOrNull(std::numeric_limits<double>::infinity()).is_null());
  EXPECT_TRUE(NumberOrNull(std::optional<double>()).is_null());
  EXPECT_EQ(NumberOrNull(0.0), 0.0);
}

TEST(RunRecord, NumbersReadBackExactly) {
  for (const double value :
       {0.1, 1.0 / 3.0, 22.976543210987654e9, 5e-324, 1.7976931348623157e308}) {
    Json record;
    record["value"] = NumberOrNull(value);
    EXPECT_EQ(Json::parse(TextOf(record)).at("value").get<double>(), value);
  }
}

TEST(RunRecord, BytesThatAreNoTextDoNotStopIt) {
  EXPECT_TRUE(Json::accept(FailureText("fit", "caf\xe9")));
}

TEST(CsvText, QuotesAndEmptyCells) {
  CsvText csv({"a", "b"});
  csv.Cell("x,\"y\"").Cell(std::numeric_limits<double>::quiet_NaN()).EndRow();
  csv.Cell(std::string_view("plain")).Cell(0.1).EndRow();
  EXPECT_EQ(csv.text(), "a,b\n\"x,\"\"y\"\"\",\nplain,0.1\n");
}

// A fit in which nothing was computed: every key of the contract is there all the same.
TEST(FitRecord, AFitThatLedNowhereHasAllKeys) {
  // `sigma: estimate` has nothing to go by in four rows.
  const Dataset dataset = testing::ReadWithYaml("{sigma: estimate}", "{sigma: 0.001}");
  FitRun run;
  run.problem = MakeProblem(dataset, {});
  run.fit.message = "a.csv: fell";
  const Json record = FitRecord(dataset, "hops", {}, run);
  EXPECT_EQ(record.at("status"), "failed");
  EXPECT_NE(record.at("message").get<std::string>().find("a.csv: fell"), std::string::npos);
  ASSERT_EQ(record.at("parameters").size(), 2u);
  EXPECT_TRUE(record.at("parameters")[0].at("value").is_null());
  EXPECT_TRUE(record.at("parameters")[0].at("ci95").is_null());
  for (const char* role : {"train", "test"}) {
    EXPECT_TRUE(record.at(role).at("rmse").at("body_x_m").is_null());
    EXPECT_TRUE(record.at(role).at("nll_per_sample").is_null());
  }
  EXPECT_TRUE(record.at("identifiability").at("condition_number").is_null());
  EXPECT_TRUE(record.at("gradient_check").at("max_relative_error").is_null());
  EXPECT_TRUE(record.at("starts").empty());
  EXPECT_NE(FitReport(dataset, run, false).find("no result"), std::string::npos);
}

// A trial that was cut begins later than its file.
TEST(TrialsRecord, TimesAreThoseOfTheTrialsFile) {
  FitRun run;
  run.problem = MakeProblem(testing::ReadWithYaml("{sigma: estimate}", "{sigma: 0.001}"), {});
  run.problem.trials[0].begin_s = 0.25;
  for (const TrialProblem& trial : run.problem.trials) {
    TrialErrors errors{};
    errors.file = trial.file;
    errors.start = OwnValues::Zero(4);
    errors.end_time = 0.03;
    errors.rmse = {0.001, 0.001};
    errors.hops = {{0.0, 0.02, {0.001, 0.001}}};
    run.trials.push_back(errors);
  }
  const Json trial = TrialsRecord(run.problem, run.trials)[0];
  EXPECT_EQ(trial.at("hops")[0].at("begin_s"), 0.25);
  EXPECT_EQ(trial.at("hops")[0].at("end_s"), 0.25 + 0.02);
  EXPECT_EQ(trial.at("end_time_s"), 0.25 + 0.03);
}

// What a scenario says it was made by leads to the same.
TEST(IdentifyOrigin, HasTheSolverWhereItIsNotTheUsualOne) {
  IdentifySettings settings;
  const std::string usual = OriginText(settings);
  EXPECT_EQ(usual.find("--tolerance"), std::string::npos) << usual;
  EXPECT_EQ(usual.find("--integrator"), std::string::npos) << usual;
  settings.solver = {"cvodes", 1e-8};
  const std::string other = OriginText(settings);
  EXPECT_NE(other.find(" --integrator cvodes --tolerance 1e-8`"), std::string::npos) << other;
}

TEST(FitReport, NoSentenceForAnIntervalThatIsMissing) {
  const Dataset dataset = testing::ReadWithYaml("{sigma: estimate}", "{sigma: 0.001}");
  FitProblem problem = MakeProblem(dataset, {});
  Uncertainty u;
  u.parameters.resize(2);
  u.identifiability.rank = 1;
  u.identifiability.condition_number = std::numeric_limits<double>::infinity();
  u.identifiability.weak_directions = {{0.0, {0.0, 1.0}}, {4.0, {0.8, 0.6}}};
  EXPECT_EQ(DeterminedLine(problem, u, ""),
            "the data say nothing about d; weakly: +0.80 E +0.60 d (to 0.50 of its size)");
  EXPECT_EQ(CertificateLine(std::nullopt), "not computed");
}

// A leg a hundred times softer is no estimate where the model misses something, and may be one
// where it does not.
TEST(FitWords, AStiffnessFarFromWhereItBeganIsRemarkedOfAModelThatMissesSomething) {
  FitRun run;
  run.problem.shared.push_back({.name = "E_1", .unit = "Pa", .initial = 24e9});
  run.problem.shared.push_back({.name = "E_2", .unit = "Pa", .initial = 24e9});
  run.problem.shared.push_back({.name = "leg_damping", .unit = "s", .initial = 3e-4});
  run.fit.shared = Eigen::Vector3d(40e9, 0.08e9, 1e-6);
  run.uncertainty.emplace();
  EXPECT_TRUE(Remarks(run).empty());
  run.uncertainty->misfit = true;
  const std::vector<std::string> remarks = Remarks(run);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks[0].find("E_2 ended 300 times softer than it began"), 0U) << remarks[0];
}

}  // namespace
}  // namespace hoplab
