// What is told of a cause whose size differs between trials, and of one that the whole trials do
// not confirm.
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "app/records/cause_record.h"
#include "app/reports/diagnosis_report.h"
#include "fitting/diagnosis/believe.h"
#include "tests/support/diagnosed_hops.h"

namespace hoplab {
namespace {

using testing::HopsWithDrag;

DiagnosisRun RunOf(const Dataset& dataset) {
  DiagnosisRun run;
  run.diagnosis = Diagnose(dataset, testing::OptionsWith({"air_drag", "sensor_delay"}));
  return run;
}

// One line, since a terminal breaks it anywhere.
std::string Unbroken(const std::string& text) {
  std::string words;
  for (const char c : text) {
    const bool gap = c == ' ' || c == '\n';
    if (!gap || words.empty() || words.back() != ' ') words += gap ? ' ' : c;
  }
  return words;
}

// Of few trials the told model has one size, and what sizes are worth stands beside it.
TEST(SizesInWords, DragThatDiffersIsToldWithItsSizesAndWhatTheyExplain) {
  const Dataset dataset = HopsWithDrag({0.03, 0.09, 0.05, 0.07}, {0.06}, 3);
  const DiagnosisRun run = RunOf(dataset);
  ASSERT_TRUE(run.diagnosis.extension) << run.diagnosis.reason;
  const std::string text = Unbroken(DiagnosisReport(dataset, run, true, false));
  EXPECT_NE(text.find("air_drag in every trial, differently: mean 0.0"), std::string::npos) << text;
  EXPECT_NE(text.find("train-2.csv 0.0"), std::string::npos) << text;
  EXPECT_NE(text.find("with these sizes the causes explain "), std::string::npos) << text;

  const Json causes = CausesRecord(run.diagnosis);
  const Json& varies = causes.at(0).at("varies").at(0);
  EXPECT_EQ(varies.at("name"), "c_drag");
  EXPECT_EQ(varies.at("refitted"), true);
  EXPECT_EQ(varies.at("told"), true);
  EXPECT_EQ(varies.at("in_the_model"), false);
  EXPECT_EQ(varies.at("trials").size(), 4u);
  EXPECT_NEAR(varies.at("trials").at(1).at("value"), 0.09,
              4.0 * varies.at("trials").at(1).at("std_error").get<double>());
  const Json& worth = varies.at("with_sizes");
  EXPECT_EQ(worth.at("pays"), true);
  EXPECT_GT(worth.at("explained"), worth.at("explained_one_size"));
  EXPECT_LT(worth.at("held_out_rmse").at("body_x_m"),
            worth.at("held_out_rmse_one_size").at("body_x_m"));
}

// Of more the model has them itself.
TEST(SizesInWords, DragOfEachTrialsOwnIsNamedSo) {
  const Dataset dataset = HopsWithDrag({0.03, 0.09, 0.05, 0.07, 0.02, 0.08}, {0.06}, 3);
  const DiagnosisRun run = RunOf(dataset);
  ASSERT_TRUE(run.diagnosis.extension) << run.diagnosis.reason;
  const std::string text = Unbroken(DiagnosisReport(dataset, run, true, false));
  EXPECT_NE(text.find("lacks air_drag of each trial's own size"), std::string::npos) << text;
  // An interval of their mean would say little: the table has how far they differ.
  const std::size_t row = text.find("air_drag.c_drag ");
  ASSERT_NE(row, std::string::npos) << text;
  const std::size_t spread = text.find(" spread 0.0", row);
  EXPECT_LT(spread, row + 40) << text;
  EXPECT_LT(text.find(" by trial N s^2/m^2 ", spread), spread + 20) << text;
  EXPECT_NE(text.find("air_drag in every trial, differently: mean 0.0"), std::string::npos) << text;
  EXPECT_NE(text.find("train-2.csv 0.0"), std::string::npos) << text;
  EXPECT_EQ(text.find("with these sizes the causes explain "), std::string::npos) << text;

  const Json causes = CausesRecord(run.diagnosis);
  EXPECT_EQ(causes.at(0).at("name"), "air_drag");
  EXPECT_EQ(causes.at(0).at("each_trial"), true);
  const Json& varies = causes.at(0).at("varies").at(0);
  EXPECT_EQ(varies.at("refitted"), true);
  EXPECT_EQ(varies.at("told"), true);
  EXPECT_EQ(varies.at("in_the_model"), true);
  EXPECT_TRUE(varies.at("with_sizes").is_null());
  EXPECT_NEAR(varies.at("trials").at(1).at("value"), 0.09,
              4.0 * varies.at("trials").at(1).at("std_error").get<double>());
}

TEST(SizesInWords, NothingIsSaidWhereOneSizeServesAll) {
  const Dataset dataset = HopsWithDrag(std::vector<double>(4, 0.06), {0.06}, 3);
  const DiagnosisRun run = RunOf(dataset);
  ASSERT_TRUE(run.diagnosis.extension) << run.diagnosis.reason;
  const std::string text = DiagnosisReport(dataset, run, true, false);
  EXPECT_EQ(text.find("differently"), std::string::npos) << text;
  // What the cause makes of the model's values, with their intervals.
  const std::string words = Unbroken(text);
  EXPECT_NE(words.find("before after 95 % interval unit moved by E "), std::string::npos) << text;
  const std::string row = words.substr(words.find(" moved by E ") + 10);
  EXPECT_LT(row.find(" .. "), row.find(" GPa ")) << row;
}

TEST(LeftOutInWords, WhatTheWholeTrialsKnowInAnotherSizeIsToldWithBoth) {
  using testing::EffectOfSize;
  const Dataset dataset =
      testing::DatasetOf({.effects = {EffectOfSize("touchdown_angle_bias", 0.03),
                                      EffectOfSize("sensor_delay", 0.006)}});
  const DiagnosisOptions options = testing::OptionsWith({"touchdown_angle_bias", "sensor_delay"});
  DiagnosisRun run;
  run.diagnosis = Diagnose(dataset, options);
  ASSERT_TRUE(run.diagnosis.extension && run.diagnosis.extension->causes.size() == 2u);
  const std::vector<CauseReport>& causes = run.diagnosis.extension->causes;
  const CauseReport& delay = causes[causes[0].cause.Name() == "sensor_delay" ? 0 : 1];
  SetAside out = AsSetAside(delay, *run.diagnosis.extension, run.diagnosis.naming);
  out.values[0] = 0.0064;
  out.by_whole_trials = Eigen::VectorXd::Constant(1, 0.0025);
  run.diagnosis = DiagnosedWithout(run.diagnosis, {out}, options);

  const std::string text = Unbroken(DiagnosisReport(dataset, run, true, false));
  EXPECT_NE(text.find("left out of another size in the whole trials, so most likely standing for "
                      "something else: sensor_delay ("),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("% of the misfit; 6.4 ms by the first parts, 2.5 ms by the whole trials)"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("would explain a little more"), std::string::npos) << text;

  const Json record = SetAsideRecord(run.diagnosis);
  ASSERT_EQ(record.size(), 1u);
  EXPECT_EQ(record[0].at("name"), "sensor_delay");
  EXPECT_EQ(record[0].at("parameters").at(0).at("value"), 0.0064);
  EXPECT_EQ(record[0].at("parameters_by_whole_trials").at(0).at("value"), 0.0025);
}

TEST(DiagnosisReport, AFitThatIsNoMinimumHasNotPassed) {
  DiagnosisRun run;
  Diagnosis& d = run.diagnosis;
  d.gate.checks = {{"fit", true, "the fit is no minimum"}, {"events", true, "all are there"}};
  d.gate.checks.push_back({"gradients", false, "differ from differences"});
  d.refusal = d.gate.Refusal();
  EXPECT_TRUE(d.gate.OnlyGradientsFailed());
  const auto label_of = [&](const std::string& check) {
    std::istringstream lines(DiagnosisReport(Dataset(), run, true, false));
    for (std::string line; std::getline(lines, line);)
      if (const auto at = line.find(check + ": "); at != std::string::npos)
        if (line.find("no verdict") == std::string::npos) return line.substr(2, 8);
    return std::string();
  };
  EXPECT_EQ(label_of("fit"), "in doubt");
  EXPECT_EQ(label_of("events"), "passed  ");
  EXPECT_EQ(label_of("gradients"), "failed  ");
  d.gate.at_minimum = true;
  EXPECT_EQ(label_of("fit"), "passed  ");
}

// What is there when a search is stopped: the causes that explain most alone, three at most.
TEST(DiagnosisReport, ASearchThatIsStoppedTellsWhatItHas) {
  DiagnosisRun run;
  Diagnosis& d = run.diagnosis;
  d.interrupted = true;
  const auto report = [&] { return DiagnosisReport(Dataset(), run, true, false); };
  EXPECT_EQ(report().find("so far"), std::string::npos);
  const auto add = [&](const char* effect, double value, double gain, bool came_to_rest) {
    CandidateResult c;
    c.candidate = {FindEffect(effect), {}};
    c.gain = gain;
    c.alone.shared = Eigen::VectorXd::Constant(1, value);
    c.alone.problem.shared.push_back({.name = effect, .unit = "s"});
    c.alone.status = came_to_rest ? SolveStatus::kConverged : SolveStatus::kFailed;
    c.alone.complete = came_to_rest;
    d.naming.candidates.push_back(c);
  };
  add("sensor_delay", 0.004, 12.0, true);
  add("torque_lag", 0.002, 200.0, true);
  add("air_drag", 0.001, 900.0, false);
  add("wind", 0.001, -1.0, true);
  const std::string text = Unbroken(report());
  EXPECT_NE(text.find("torque_lag 2.0 ms (200 nats), sensor_delay 4.0 ms (12 nats)"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("air_drag"), std::string::npos);
  EXPECT_EQ(text.find("wind"), std::string::npos);
  EXPECT_EQ(text.find("together"), std::string::npos);

  d.notes = {"in the first 0.2 s nothing is missing"};
  FittedModel& best = d.naming.best;
  best = d.naming.candidates[0].alone;
  best.members = {d.naming.candidates[0].candidate, {FindEffect("gravity_scale"), {}}};
  best.shared = Eigen::Vector2d(0.003, 0.02);
  best.problem.shared.push_back({.name = "gravity_scale", .unit = "-"});
  const std::string longer = Unbroken(report());
  EXPECT_NE(longer.find("together, which may not be all: sensor_delay 3.0 ms, gravity_scale 0.02"),
            std::string::npos)
      << longer;
  EXPECT_NE(longer.find("note in the first 0.2 s nothing is missing"), std::string::npos);
}

}  // namespace
}  // namespace hoplab
