// reproduce: printed numbers beside ours, what the run folder holds, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "tests/app/hoplab_process.h"
#include "tests/support/study_constants.h"

namespace hoplab::testing {
namespace {

class ReproduceCli : public ::testing::Test {
 protected:
  ReproduceCli() { WriteText(temp_.path() / "study.yaml", kStudyConstants); }
  ProcessResult Reproduce(std::vector<std::string> more) {
    more.insert(more.begin(), {"reproduce", "--constants", "study.yaml", "--quiet"});
    return RunHoplab(more, temp_.path());
  }
  TempFolder temp_;
};

TEST_F(ReproduceCli, OutsideOfTheProjectTheConstantsAreAskedFor) {
  const ProcessResult run = RunHoplab({"reproduce", "table-6.5"}, temp_.path());
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_NE(run.err.find("experiments/published.yaml: the constants of the study are not in this "
                         "folder. Run this in the project's folder"),
            std::string::npos)
      << run.err;
  EXPECT_NE(run.err.find("--constants FILE"), std::string::npos) << run.err;
}

TEST_F(ReproduceCli, TableSixPointFiveStandsBesideThePrintedOne) {
  const ProcessResult run = Reproduce({"table-6.5", "--json", "--out", "run"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("command"), "reproduce");
  EXPECT_EQ(record.at("law"), "thesis");
  const nlohmann::json& published = record.at("comparison").at("published");
  ASSERT_EQ(published.size(), 15u);
  EXPECT_EQ(published[0].at("published"), 103.12);
  double square = 0.0;
  for (const nlohmann::json& number : published) {
    const double difference =
        number.at("ours").get<double>() - number.at("published").get<double>();
    square += difference * difference;
    EXPECT_EQ(number.at("agrees").get<bool>(),
              std::abs(difference) <= number.at("tolerance").get<double>());
  }
  const nlohmann::json& rms =
      record.at("comparison").at("statistics").at("table-6.5").at("energy_rms_difference");
  EXPECT_NEAR(rms.at("value").get<double>(), std::sqrt(square / 15.0), 1e-12);
  EXPECT_EQ(ReadRecord(temp_.path() / "run"), record);
  const std::string csv = ReadText(temp_.path() / "run" / "table-6.5.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 16);
}

TEST_F(ReproduceCli, AFigureSaysInTheRecordHowItsDataArePlotted) {
  ASSERT_EQ(Reproduce({"figure-6.29", "figure-3.5", "--out", "run"}).exit_code, 0);
  const nlohmann::json record = ReadRecord(temp_.path() / "run");
  ASSERT_EQ(record.at("figures").size(), 2u);
  for (const nlohmann::json& figure : record.at("figures")) {
    const std::string csv = ReadText(temp_.path() / "run" / figure.at("file").get<std::string>());
    const std::string header = csv.substr(0, csv.find('\n'));
    if (!figure.at("series_column").is_null()) {
      EXPECT_TRUE(header.starts_with(figure.at("series_column").get<std::string>() + ","));
    }
    for (const nlohmann::json& column : figure.at("columns"))
      EXPECT_NE(header.find(column.at("name").get<std::string>()), std::string::npos);
  }
  const nlohmann::json& both = record.at("figures")[1];
  EXPECT_EQ(both.at("kind"), "lines");
  ASSERT_EQ(both.at("series").size(), 2u);
  const nlohmann::json& straight = both.at("series")[1].at("settings").at("straight_leg");
  EXPECT_GT(straight.at("k_N_per_m").get<double>(), 0.0);
  EXPECT_TRUE(both.at("series")[0].at("settings").at("straight_leg").is_null());
}

TEST_F(ReproduceCli, JobsDoNotChangeAByteOfTheTables) {
  ASSERT_EQ(Reproduce({"claim-h", "figure-6.12", "--jobs", "1", "--out", "a"}).exit_code, 0);
  ASSERT_EQ(Reproduce({"claim-h", "figure-6.12", "--jobs", "4", "--out", "b"}).exit_code, 0);
  for (const char* file : {"claim-h.csv", "figure-6.12.csv"})
    EXPECT_EQ(ReadText(temp_.path() / "a" / file), ReadText(temp_.path() / "b" / file));
}

TEST_F(ReproduceCli, AClaimNamesTheCausesWithFigures) {
  const ProcessResult run = Reproduce({"claim-h"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("note: the study blames integration along the arc"), std::string::npos);
}

TEST_F(ReproduceCli, WhatDoesNotExistIsRefusedBeforeAnythingRuns) {
  const ProcessResult name = Reproduce({"figure-6.4"});
  EXPECT_EQ(name.exit_code, 65);
  EXPECT_NE(name.err.find("figure-6.5"), std::string::npos) << name.err;
  EXPECT_EQ(Reproduce({"table-6.5", "--hip-distance", "-0.4"}).exit_code, 65);
  EXPECT_EQ(Reproduce({"table-6.5", "--law", "straight_leg"}).exit_code, 65);
  EXPECT_EQ(Reproduce({"table-6.5", "--set", "controller=null"}).exit_code, 65);
  EXPECT_EQ(Reproduce({"table-6.5", "--job", "2"}).exit_code, 64);
  const ProcessResult file = RunHoplab({"reproduce", "table-6.5"}, temp_.path());
  EXPECT_EQ(file.exit_code, 65);
  EXPECT_NE(file.err.find("experiments/published.yaml"), std::string::npos) << file.err;
  EXPECT_EQ(CountEntries(temp_.path()), 1) << "no run folder was made";
}

TEST_F(ReproduceCli, AnInterruptKeepsWhatIsFinished) {
  ProcessRequest request{
      .command = {HOPLAB_BINARY, "reproduce", "--constants", "study.yaml", "all", "--out", "run"},
      .folder = temp_.path()};
  request.signal = SIGINT;
  request.signal_after = "reproducing";
  const ProcessResult run = RunProcess(request);
  ASSERT_EQ(run.exit_code, 130) << run.err;
  const nlohmann::json record = ReadRecord(temp_.path() / "run");
  EXPECT_EQ(record.at("status"), "failed");
  EXPECT_FALSE(record.at("left_out").empty());
  EXPECT_NE(run.err.find("interrupted"), std::string::npos);
}

}  // namespace
}  // namespace hoplab::testing
