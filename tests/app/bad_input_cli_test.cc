// What `hoplab fit` does with input that is not what it should be: the exit code, what it says, and
// that nothing is left behind.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;

AssertionResult Says(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return AssertionSuccess();
  return AssertionFailure() << "no \"" << part << "\" in:\n" << text;
}

// `csv` with `change` applied to the cells of each row below the header.
template <class Change>
std::string EachRow(const std::string& csv, const Change& change) {
  std::istringstream in(csv);
  std::ostringstream out;
  std::string line;
  std::getline(in, line);
  out << line << '\n';
  while (std::getline(in, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    change(cells);
    for (std::size_t i = 0; i < cells.size(); ++i) out << (i ? "," : "") << cells[i];
    out << '\n';
  }
  return out.str();
}

std::string FirstRows(const std::string& csv, int rows) {
  std::size_t at = 0;
  for (int i = 0; i <= rows; ++i) at = csv.find('\n', at) + 1;
  return csv.substr(0, at);
}

class BadInputCli : public ::testing::Test {
 protected:
  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }
  TempFolder temp_;
};

TEST_F(BadInputCli, AFolderThatIsNoDatasetIsBadInput) {
  const ProcessResult run = Hoplab({"fit", "."});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_TRUE(Says(run.err, "dataset.yaml"));
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(CountEntries(temp_.path()), 0);
}

TEST_F(BadInputCli, WithJsonTheFailureIsOneRecord) {
  const ProcessResult run = Hoplab({"fit", "absent", "--json"});
  EXPECT_EQ(run.exit_code, 65);
  const auto record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("schema"), "hoplab-run/1");
  EXPECT_EQ(record.at("command"), "fit");
  EXPECT_EQ(record.at("status"), "failed");
  EXPECT_TRUE(Says(record.at("message"), "absent"));
}

TEST_F(BadInputCli, OneSampleDeterminesNothingAndIsSaid) {
  const std::string data =
      ChangedDataset(temp_.path(), [](const std::string& csv) { return FirstRows(csv, 1); });
  const ProcessResult run = Hoplab({"fit", data});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(Says(run.err, "single sample"));
  EXPECT_TRUE(Says(run.out, "not determined"));
}

TEST_F(BadInputCli, AConstantChannelIsSuspected) {
  const std::string data = ChangedDataset(temp_.path(), [](const std::string& csv) {
    return EachRow(csv, [](std::vector<std::string>& cells) { cells[2] = "0.3"; });
  });
  const ProcessResult run = Hoplab({"fit", data});
  EXPECT_TRUE(run.exit_code == 0 || run.exit_code == 1) << run.exit_code;
  EXPECT_TRUE(Says(run.err, "constant channel"));
  EXPECT_TRUE(Says(run.err, "8 more files"));
}

TEST_F(BadInputCli, TimesInMillisecondsAreToldWithoutATry) {
  const std::string data = ChangedDataset(temp_.path(), [](const std::string& csv) {
    return EachRow(csv, [](std::vector<std::string>& cells) {
      cells[0] = std::to_string(1000.0 * std::stod(cells[0]));
    });
  });
  for (const char* command : {"fit", "diagnose"}) {
    const ProcessResult run = Hoplab({command, data, "--json"});
    EXPECT_EQ(run.exit_code, 1) << command;
    const auto record = nlohmann::json::parse(run.out);
    EXPECT_EQ(record.at("status"), "failed") << command;
    EXPECT_TRUE(Says(record.at("message"), "looks like milliseconds; divide it by 1000"));
  }
}

TEST_F(BadInputCli, WithoutContactNoParameterGetsANumber) {
  const std::string data =
      ChangedDataset(temp_.path(), [](const std::string& csv) { return FirstRows(csv, 60); });
  const ProcessResult run = Hoplab({"fit", data, "--out", "run"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(Says(run.err, "never touches the ground"));
  EXPECT_TRUE(Says(run.err, "determine none of the parameters (E, d)"));
  EXPECT_TRUE(Says(run.out, "the data say nothing about"));
  const nlohmann::json record = ReadRecord(temp_.path() / "run");
  EXPECT_EQ(record.at("status"), "failed");
  for (const auto& parameter : record.at("parameters")) {
    EXPECT_TRUE(parameter.at("value").is_null());
    EXPECT_TRUE(parameter.at("std_error").is_null());
    EXPECT_TRUE(parameter.at("ci95").is_null());
  }
  const auto& id = record.at("identifiability");
  EXPECT_TRUE(id.at("condition_number").is_null());
  EXPECT_EQ(id.at("rank"), 0);
  ASSERT_EQ(id.at("weak_directions").size(), 2u);
  EXPECT_EQ(id.at("weak_directions")[0].at("eigenvalue"), 0.0);
}

TEST_F(BadInputCli, AnUnknownParameterGetsAHint) {
  const ProcessResult run = Hoplab({"fit", ShippedDataset("rig-drops"), "--free", "E,v_dez"});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_TRUE(Says(run.err, "Did you mean v_des?"));
  EXPECT_EQ(CountEntries(temp_.path()), 0);
}

TEST_F(BadInputCli, AnUnknownProfileParameterGetsAHintBeforeTheFit) {
  const ProcessResult run =
      Hoplab({"fit", ShippedDataset("rig-drops"), "--profile", "EE", "--starts", "10000"});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_TRUE(Says(run.err, "--profile"));
}

TEST_F(BadInputCli, AParameterIsProfiledOnce) {
  const ProcessResult run = Hoplab({"fit", ShippedDataset("rig-drops"), "--profile", "E,E"});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_TRUE(Says(run.err, "--profile: E; is named twice"));
}

TEST_F(BadInputCli, AnUnknownLawGetsAHint) {
  const ProcessResult run = Hoplab({"fit", ShippedDataset("rig-drops"), "--law", "thesys"});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_TRUE(Says(run.err, "Did you mean thesis?"));
}

TEST_F(BadInputCli, AnUnknownEffectGetsAHint) {
  const ProcessResult run = Hoplab({"fit", ShippedDataset("rig-drops"), "--with", "air_drg"});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_TRUE(Says(run.err, "Did you mean air_drag?"));
}

TEST_F(BadInputCli, AFixWithoutAValueIsWrongUse) {
  for (const char* fix : {"E", "E=", "=3", "E=much", "E=nan"}) {
    const ProcessResult run = Hoplab({"fit", ShippedDataset("rig-drops"), "--fix", fix});
    EXPECT_EQ(run.exit_code, 64) << fix;
    EXPECT_TRUE(Says(run.err, "name=value")) << fix;
  }
}

TEST_F(BadInputCli, AFixOutOfBoundsIsBadInput) {
  const ProcessResult run = Hoplab({"fit", ShippedDataset("rig-drops"), "--fix", "E=-4"});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_TRUE(Says(run.err, "E = -4"));
}

TEST_F(BadInputCli, AFolderThatIsTakenIsLeftAlone) {
  WriteText(temp_.path() / "run" / "run.json", "mine");
  const ProcessResult run = Hoplab({"fit", ShippedDataset("rig-drops"), "--out", "run"});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_TRUE(Says(run.err, "--force"));
  EXPECT_EQ(run.err.find("fitting"), std::string::npos) << "it worked before it looked";
  EXPECT_EQ(ReadText(temp_.path() / "run" / "run.json"), "mine");
  EXPECT_EQ(CountEntries(temp_.path() / "run"), 1);
}

TEST_F(BadInputCli, ForceReplacesARunButNoOtherFolder) {
  const std::string drops = ShippedDataset("rig-drops");
  WriteText(temp_.path() / "run" / "run.json", "old");
  EXPECT_EQ(Hoplab({"fit", drops, "--out", "run", "--force"}).exit_code, 0);
  EXPECT_EQ(ReadRecord(temp_.path() / "run").at("status"), "ok");
  WriteText(temp_.path() / "thesis" / "chapter.txt", "years of work");
  EXPECT_EQ(Hoplab({"fit", drops, "--out", "thesis", "--force"}).exit_code, 65);
  EXPECT_EQ(ReadText(temp_.path() / "thesis" / "chapter.txt"), "years of work");
}

TEST_F(BadInputCli, OptionsThatDoNotExistOrDoNotFitAreWrongUse) {
  const ProcessResult typo = Hoplab({"fit", ShippedDataset("rig-drops"), "--strats", "3"});
  EXPECT_EQ(typo.exit_code, 64);
  EXPECT_TRUE(Says(typo.err, "Did you mean --starts?"));
  EXPECT_EQ(Hoplab({"fit"}).exit_code, 64);
  EXPECT_EQ(Hoplab({"fit", "x", "--starts", "none"}).exit_code, 64);
  EXPECT_EQ(Hoplab({"fit", "x", "--strategy", "luck"}).exit_code, 64);
}

TEST_F(BadInputCli, ANumberThatMustBeAboveZeroIsOneAndFinite) {
  struct Case {
    std::vector<std::string> call;
    const char* says;
  };
  for (const Case& c : std::vector<Case>{
           {{"fit", "x", "--loss-scale", "nan"}, "--loss-scale: nan; must be a number above 0."},
           {{"fit", "x", "--loss-scale", "0"}, "--loss-scale: 0; must be a number above 0."},
           {{"fit", "x", "--loss-scale", "1e300"}, "1e300; must be at most 1e6."},
           {{"fit", "x", "--loss-scale", "1e-300"}, "1e-300; must be at least 1e-6."},
           {{"fit", "x", "--loss-scale", "1,5"}, "above 0. The decimal sign is a point: 1.5."},
           {{"fit", "x", "--tolerance", "0,001"}, "0.001. The decimal sign is a point: 0.001."},
           {{"import", "x", "--out", "d", "--rate", "nan"}, "--rate: nan; must be a number above"},
           {{"import", "x", "--out", "d", "--rate", "1e300"}, "--rate: 1e300; must be at most 1e6"},
           {{"export", "x", "--leg-mass", "0"}, "--leg-mass: 0; must be a number above 0."}}) {
    const ProcessResult run = Hoplab(c.call);
    EXPECT_EQ(run.exit_code, 64) << run.err;
    EXPECT_TRUE(Says(run.err, c.says));
    EXPECT_LT(run.err.size(), 150u) << run.err;
  }
}

TEST_F(BadInputCli, ASeedIsAWholeNumberOf64Bits) {
  for (const char* seed : {"-1", "18446744073709551616", "1.5", "0x10", "", "seven"}) {
    const ProcessResult run = Hoplab({"fit", "x", "--seed", seed});
    EXPECT_EQ(run.exit_code, 64) << seed;
    EXPECT_TRUE(Says(run.err, "must be a whole number from 0 to 18446744073709551615.")) << seed;
  }
  const std::string scenario = WriteScenario(temp_.path());
  const ProcessResult most =
      Hoplab({"generate", scenario, "--seed", "18446744073709551615", "--out", "made", "--json"});
  EXPECT_EQ(most.exit_code, 0) << most.err;
  EXPECT_EQ(nlohmann::json::parse(most.out).at("seed"), 18446744073709551615u);
}

TEST_F(BadInputCli, WithoutACommandOrWithAnUnknownOneHelpIsNear) {
  const ProcessResult none = Hoplab({});
  EXPECT_EQ(none.exit_code, 64);
  EXPECT_TRUE(Says(none.err, "simulate"));
  EXPECT_EQ(none.out, "");
  const ProcessResult typo = Hoplab({"simulat"});
  EXPECT_EQ(typo.exit_code, 64);
  EXPECT_TRUE(Says(typo.err, "Did you mean simulate?"));
}

TEST_F(BadInputCli, AScenarioThatIsNoneIsBadInput) {
  EXPECT_EQ(Hoplab({"simulate", "absent.yaml"}).exit_code, 65);
  const std::string scenario = WriteScenario(temp_.path());
  EXPECT_EQ(Hoplab({"simulate", scenario, "--set", "mechanism.leg.E_Pa=-1"}).exit_code, 65);
  EXPECT_EQ(Hoplab({"simulate", scenario, "--set", "nonsense"}).exit_code, 64);
  EXPECT_EQ(Hoplab({"generate", scenario, "--with", "air_drag", "--out", "d"}).exit_code, 64);
  const ProcessResult effect =
      Hoplab({"generate", scenario, "--with", "air_drag:drag=1", "--out", "d"});
  EXPECT_EQ(effect.exit_code, 65);
  EXPECT_TRUE(Says(effect.err, "c_drag"));
  EXPECT_EQ(CountEntries(temp_.path()), 1);
}

}  // namespace
}  // namespace hoplab::testing
