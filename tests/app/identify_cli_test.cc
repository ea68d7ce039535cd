#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

constexpr const char* kMpirun = "/usr/bin/mpirun";

class IdentifyCli : public ::testing::Test {
 protected:
  static std::vector<std::string> Arguments(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"identify", "--tables", "6.5", "--budget", "40"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  ProcessResult Identify(const std::vector<std::string>& more) {
    return RunHoplab(Arguments(more), temp_.path());
  }
  std::string Text(const char* file) const { return ReadText(temp_.path() / file); }
  TempFolder temp_;
};

// Through the launcher; what hangs is ended.
ProcessResult OnTwoRanks(const std::vector<std::string>& arguments,
                         const std::filesystem::path& folder) {
  std::vector<std::string> command = {"/usr/bin/timeout", "100", kMpirun, "--allow-run-as-root",
                                      "--oversubscribe",  "-n",  "2",     HOPLAB_BINARY};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return RunProcess({.command = command, .folder = folder});
}

TEST_F(IdentifyCli, RanksShareTheSearchesAndFindTheSame) {
  ASSERT_EQ(Identify({"--quiet", "--out", "alone"}).exit_code, 0);
  const ProcessResult shared = OnTwoRanks(Arguments({"--quiet", "--out", "shared"}), temp_.path());
  ASSERT_EQ(shared.exit_code, 0) << shared.err;
  const std::string readings = Text("alone/readings.csv");
  EXPECT_EQ(std::count(readings.begin(), readings.end(), '\n'), 1 + 2 * 192);
  EXPECT_EQ(Text("shared/readings.csv"), readings);
}

TEST_F(IdentifyCli, RanksThatWaitEndWhereTheFirstCannotBegin) {
  WriteText(temp_.path() / "taken" / "run.json", "{}");
  const ProcessResult run = OnTwoRanks(Arguments({"--quiet", "--out", "taken"}), temp_.path());
  EXPECT_EQ(run.exit_code, 65) << run.err;
  EXPECT_NE(run.err.find("taken"), std::string::npos) << run.err;
}

TEST_F(IdentifyCli, GoesOnFromItsJournal) {
  ASSERT_EQ(Identify({"--quiet", "--out", "whole"}).exit_code, 0);
  // As an interruption leaves it: the header and a hundred fits.
  const std::string journal = Text("whole/fits.txt");
  std::size_t end = 0;
  for (int line = 0; line <= 100; ++line) end = journal.find('\n', end) + 1;
  std::ofstream(temp_.path() / "rest.partial", std::ios::binary) << journal.substr(0, end);
  const ProcessResult rest = Identify({"--out", "rest"});
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_NE(rest.err.find("192 searches, 100 stand in the journal"), std::string::npos) << rest.err;
  EXPECT_EQ(Text("rest/readings.csv"), Text("whole/readings.csv"));
  EXPECT_FALSE(std::filesystem::exists(temp_.path() / "rest.partial"));
  // Of other tables it is another one.
  std::ofstream(temp_.path() / "other.partial", std::ios::binary) << journal;
  const ProcessResult other =
      RunHoplab({"identify", "--tables", "6.5,6.2", "--out", "other"}, temp_.path());
  EXPECT_EQ(other.exit_code, 65);
  EXPECT_NE(other.err.find("other.partial"), std::string::npos) << other.err;
}

TEST_F(IdentifyCli, TheScenarioItFindsIsReproducedAsItSays) {
  const ProcessResult found = Identify({"--quiet", "--json", "--out", "found"});
  ASSERT_EQ(found.exit_code, 0) << found.err;
  const double said = nlohmann::json::parse(found.out)
                          .at("best_on_table_6_5")
                          .at("scores")
                          .at("table_6_5_rms_points")
                          .get<double>();
  const ProcessResult again =
      RunHoplab({"reproduce", "table-6.5", "--json", "--constants", "found/published-energy.yaml"},
                temp_.path());
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const double reproduced = nlohmann::json::parse(again.out)
                                .at("comparison")
                                .at("statistics")
                                .at("table-6.5")
                                .at("energy_rms_difference")
                                .at("value")
                                .get<double>();
  EXPECT_NEAR(reproduced, said, 1e-4);
  EXPECT_LT(said, 0.3);
}

TEST_F(IdentifyCli, TellsWhatItDoesNotKnow) {
  const ProcessResult table = RunHoplab({"identify", "--tables", "6.6"}, temp_.path());
  EXPECT_EQ(table.exit_code, 65);
  EXPECT_NE(table.err.find("6.6"), std::string::npos) << table.err;
  const ProcessResult times = Identify({"--times", "flight,stay,last_five"});
  EXPECT_EQ(times.exit_code, 65);
  EXPECT_NE(times.err.find("Did you mean flight,stays,last_five?"), std::string::npos) << times.err;
}

}  // namespace
}  // namespace hoplab::testing
