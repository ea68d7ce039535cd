// sweep: the same rows whatever computes them, failures as rows, and going on after an
// interruption.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

const char* const kGrid =
    "sweep:\n"
    "  grid: {touchdown_angle_deg: [25, 40, 70], initial.y_m: [0.1, 0.3]}\n"
    "  outputs: [hops, energy_percent, stiffness_min_N_per_m, stiffness_max_N_per_m]\n";

const char* const kHypercube =
    "sweep:\n"
    "  latin_hypercube: {samples: 20000, ranges: {touchdown_angle_deg: [20, 50], initial.y_m: "
    "[0.2, 0.4]}}\n"
    "  outputs: [apex_height_m, energy_percent]\n";

constexpr const char* kMpirun = "/usr/bin/mpirun";

class SweepCli : public ::testing::Test {
 protected:
  std::vector<std::string> Arguments(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"sweep", "hops.yaml", "--set", "stop.hops=1", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  ProcessResult Sweep(const std::vector<std::string>& more) {
    return RunHoplab(Arguments(more), temp_.path());
  }
  // Through `launcher` (a program and its first arguments).
  ProcessResult SweepUnder(std::vector<std::string> launcher,
                           const std::vector<std::string>& more) {
    launcher.emplace_back(HOPLAB_BINARY);
    const std::vector<std::string> arguments = Arguments(more);
    launcher.insert(launcher.end(), arguments.begin(), arguments.end());
    return RunProcess({.command = launcher, .folder = temp_.path()});
  }
  std::string Rows(const char* folder) const {
    return ReadText(temp_.path() / folder / "rows.csv");
  }
  bool Exists(const char* name) const { return std::filesystem::exists(temp_.path() / name); }
  TempFolder temp_;
};

TEST_F(SweepCli, AFailingRunIsARowWithItsReason) {
  WriteScenario(temp_.path(), kGrid);
  const ProcessResult run = Sweep({"--json", "--out", "run"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json record = nlohmann::json::parse(run.out);
  ASSERT_EQ(record.at("rows").size(), 6u);
  std::vector<std::string> names;
  for (const auto& column : record.at("columns")) names.push_back(column.at("name"));
  EXPECT_EQ(names, (std::vector<std::string>{"touchdown_angle_deg", "initial.y_m", "hops",
                                             "energy_percent", "stiffness_min_N_per_m",
                                             "stiffness_max_N_per_m", "outcome", "reason"}));
  EXPECT_EQ(record.at("columns")[1].at("unit"), "m");
  const nlohmann::json& low = record.at("rows")[0];  // 25 deg from 0.1 m: in the ground
  EXPECT_EQ(low[6], "starts_in_ground");
  EXPECT_TRUE(low[3].is_null()) << "not computed is null, never 0";
  EXPECT_TRUE(low[7].is_string());
  const nlohmann::json& good = record.at("rows")[1];
  EXPECT_EQ(good[0], 25.0);
  EXPECT_EQ(good[1], 0.3);
  EXPECT_EQ(good[6], "hop_limit");
  EXPECT_TRUE(good[7].is_null());
  EXPECT_GT(good[3], 50.0);
  EXPECT_LT(good[4], good[5]);
  EXPECT_EQ(Sweep({"--out", "run"}).exit_code, 65) << "not overwritten";
  EXPECT_FALSE(Exists("run.partial"));
}

TEST_F(SweepCli, JobsDoNotChangeTheRows) {
  WriteScenario(temp_.path(), kHypercube);
  const std::vector<std::string> few = {"--set", "sweep.latin_hypercube.samples=300"};
  for (const char* jobs : {"1", "2", "5"}) {
    std::vector<std::string> more = few;
    more.insert(more.end(), {"--jobs", jobs, "--out", std::string("run-") + jobs});
    ASSERT_EQ(Sweep(more).exit_code, 0);
  }
  EXPECT_EQ(Rows("run-1"), Rows("run-2"));
  EXPECT_EQ(Rows("run-1"), Rows("run-5"));
  const std::string rows = Rows("run-1");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 301);
}

TEST_F(SweepCli, AnInterruptedSweepGoesOnWhereItWas) {
  WriteScenario(temp_.path(), kHypercube);
  ProcessRequest request{
      .command = {HOPLAB_BINARY, "sweep", "hops.yaml", "--set", "stop.hops=1", "--out", "run"},
      .folder = temp_.path()};
  request.signal = SIGINT;
  request.signal_after = "sweeping";
  const ProcessResult first = RunProcess(request);
  ASSERT_EQ(first.exit_code, 130) << first.err;
  EXPECT_NE(first.err.find("run.partial"), std::string::npos) << first.err;
  EXPECT_FALSE(Exists("run"));
  ASSERT_TRUE(Exists("run.partial"));

  // Rows of other settings are not mixed in.
  const ProcessResult other = Sweep({"--set", "mechanism.leg.E_Pa=20e9", "--out", "run"});
  EXPECT_EQ(other.exit_code, 65);
  EXPECT_NE(other.err.find("another scenario"), std::string::npos) << other.err;

  // A line that the interruption tore.
  const std::string partial = ReadText(temp_.path() / "run.partial");
  WriteText(temp_.path() / "run.partial", partial + "7\thop_lim");
  ASSERT_EQ(Sweep({"--out", "run"}).exit_code, 0);
  EXPECT_FALSE(Exists("run.partial"));
  ASSERT_EQ(Sweep({"--out", "straight"}).exit_code, 0);
  EXPECT_EQ(Rows("run"), Rows("straight"));
}

TEST_F(SweepCli, WhatCannotBeSweptIsRefused) {
  WriteScenario(temp_.path(), kGrid);
  EXPECT_EQ(Sweep({"--set", "sweep=null"}).exit_code, 65);
  const ProcessResult output = Sweep({"--set", "sweep.outputs=[hop]"});
  EXPECT_EQ(output.exit_code, 65);
  EXPECT_NE(output.err.find("hops"), std::string::npos) << output.err;
  EXPECT_EQ(CountEntries(temp_.path()), 1);
}

TEST_F(SweepCli, RanksGiveTheSameRowsBitForBit) {
  ASSERT_TRUE(std::filesystem::exists(kMpirun)) << "package openmpi-bin of cmake/packages.txt";
  WriteScenario(temp_.path(), kHypercube);
  const std::vector<std::string> launcher = {kMpirun, "--allow-run-as-root", "--oversubscribe",
                                             "-n", "3"};
  const ProcessResult ranks =
      SweepUnder(launcher, {"--set", "sweep.latin_hypercube.samples=500", "--out", "ranks"});
  ASSERT_EQ(ranks.exit_code, 0) << ranks.err;
  ASSERT_EQ(Sweep({"--set", "sweep.latin_hypercube.samples=500", "--out", "threads"}).exit_code, 0);
  EXPECT_EQ(Rows("ranks"), Rows("threads"));
  // Bad input ends every rank; nobody waits for ever.
  const ProcessResult bad = SweepUnder(launcher, {"--set", "sweep=null"});
  EXPECT_FALSE(bad.timed_out);
  EXPECT_NE(bad.err.find("sweep; is absent"), std::string::npos) << bad.err;
}

TEST_F(SweepCli, ALostRankCostsOnlyItsOwnRows) {
  ASSERT_TRUE(std::filesystem::exists(kMpirun)) << "package openmpi-bin of cmake/packages.txt";
  WriteScenario(temp_.path(), kHypercube);
  // Rank 1 is killed once two hundred rows are on disk.
  const char* const wrapper =
      "if [ \"$OMPI_COMM_WORLD_RANK\" = 1 ]; then\n"
      "  \"$@\" & until [ -s run.partial ] && [ $(grep -c hop_limit run.partial) -ge 200 ]; do :; "
      "done\n"
      "  kill -9 $!; wait $!\n"
      "else exec \"$@\"; fi\n";
  const ProcessResult lost =
      SweepUnder({kMpirun, "--allow-run-as-root", "--oversubscribe", "-n", "2", "/bin/sh", "-c",
                  wrapper, "sh"},
                 {"--set", "sweep.latin_hypercube.samples=20000", "--out", "run"});
  EXPECT_FALSE(lost.timed_out);
  ASSERT_NE(lost.exit_code, 0);
  // mpirun may forward no more messages then; the file names the gap as well.
  const std::string partial = ReadText(temp_.path() / "run.partial");
  EXPECT_NE(partial.find("rows are kept in run.partial, missing are"), std::string::npos);
  EXPECT_FALSE(Exists("run"));
  ASSERT_TRUE(Exists("run.partial"));
  ASSERT_EQ(Sweep({"--set", "sweep.latin_hypercube.samples=20000", "--out", "run"}).exit_code, 0);
  const std::string rows = Rows("run");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 20001);
}

}  // namespace
}  // namespace hoplab::testing
