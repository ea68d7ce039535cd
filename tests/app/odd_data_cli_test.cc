// What check, fit and diagnose say of data that are odd.
#include <gtest/gtest.h>

#include <functional>
#include <sstream>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

class OddDataCli : public ::testing::Test {
 protected:
  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }
  nlohmann::json RecordOf(const std::string& run) {
    return nlohmann::json::parse(ReadText(temp_.path() / run / "run.json"));
  }
  // Three drops and one held out, in hops/.
  void Generate() {
    const std::filesystem::path drops =
        std::filesystem::path(HOPLAB_SOURCE_DIR) / "experiments/three-drops.yaml";
    const ProcessResult run = Hoplab({"generate", drops.string(), "--seed", "7", "--out", "hops"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  void ChangeYaml(const std::string& from, const std::string& to) {
    std::string yaml = ReadText(temp_.path() / "hops/dataset.yaml");
    for (std::size_t at = yaml.find(from); at != yaml.npos; at = yaml.find(from, at + to.size()))
      yaml.replace(at, from.size(), to);
    WriteText(temp_.path() / "hops/dataset.yaml", yaml);
  }
  // `change` of the cells of each row of a trace, which counts from 0 without the titles.
  using Cells = std::vector<std::string>;
  void ChangeTrace(const std::string& file, const std::function<void(int, Cells&)>& change) {
    std::istringstream rows(ReadText(temp_.path() / "hops" / file));
    std::string text, row;
    for (int i = -1; std::getline(rows, row); ++i) {
      std::istringstream line(row);
      Cells cells;
      for (std::string cell; std::getline(line, cell, ',');) cells.push_back(cell);
      if (i >= 0) change(i, cells);
      for (std::size_t c = 0; c < cells.size(); ++c) text += (c > 0 ? "," : "") + cells[c];
      text += '\n';
    }
    WriteText(temp_.path() / "hops" / file, text);
  }
  // A sample that lies 0.1 m above the others.
  void AddStray() {
    ChangeTrace("train-1.csv", [](int row, Cells& cells) {
      if (row == 50) cells[2] = std::to_string(std::stod(cells[2]) + 0.1);
    });
  }
  TempFolder temp_;
};

// The dataset is called three-drops.
TEST_F(OddDataCli, WarningsNameADatasetByItsFolder) {
  Generate();
  ASSERT_EQ(Hoplab({"check", "hops", "--fix", "E=1e6", "--out", "run"}).exit_code, 0);
  const std::string warning = RecordOf("run")["warnings"][0];
  const std::string begin = "hops/train-1.csv: at the nominal values the simulation fell: ";
  EXPECT_EQ(warning.substr(0, begin.size()), begin);
}

TEST_F(OddDataCli, DiagnoseTellsItAndKeepsIt) {
  Generate();
  ChangeYaml("role: test", "role: train");
  AddStray();
  const ProcessResult run = Hoplab(
      {"diagnose", "hops", "--effects", "air_drag,touchdown_loss", "--out", "run", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("warning: hops/dataset.yaml: no trial has role: test"), run.err.npos)
      << run.err;
  EXPECT_NE(run.out.find("1 sample of body_y_m, in train-1.csv at 0.2 s"), run.out.npos) << run.out;
  const nlohmann::json record = RecordOf("run");
  EXPECT_EQ(record["warnings"].size(), 1U);
  ASSERT_EQ(record["trace_faults"].size(), 1U);
  const nlohmann::json& fault = record["trace_faults"][0];
  EXPECT_EQ(fault["kind"], "stray");
  EXPECT_EQ(fault["file"], "train-1.csv");
  EXPECT_EQ(fault["times_s"], nlohmann::json::array({0.2}));
  EXPECT_EQ(fault["compared"], false);
  EXPECT_EQ(record["options"]["keep_stray"], false);
}

TEST_F(OddDataCli, FitComparesAStraySampleOnlyWhereItIsAsked) {
  Generate();
  AddStray();
  ASSERT_EQ(Hoplab({"fit", "hops", "--out", "without", "--quiet"}).exit_code, 0);
  const ProcessResult kept = Hoplab({"fit", "hops", "--keep-stray", "--out", "with", "--quiet"});
  ASSERT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_NE(kept.out.find("it is compared"), kept.out.npos) << kept.out;
  EXPECT_EQ(RecordOf("with")["trace_faults"][0]["compared"], true);
  EXPECT_EQ(RecordOf("with")["options"]["keep_stray"], true);
  // Half the square of 0.1 m over the noise of 1 mm; the noise of that sample is some per cent.
  const double more =
      RecordOf("with")["cost"].get<double>() - RecordOf("without")["cost"].get<double>();
  EXPECT_NEAR(more, 5000.0, 500.0);
}

// Written with x backwards, start and trace.
TEST_F(OddDataCli, CheckSaysWhichSignIsTurned) {
  Generate();
  for (const char* file : {"train-1.csv", "train-2.csv", "train-3.csv", "test-4.csv"})
    ChangeTrace(file, [](int, Cells& cells) { cells[1] = std::to_string(-std::stod(cells[1])); });
  ChangeYaml("vx_m_per_s: 1.", "vx_m_per_s: -1.");  // all starts, no sigma
  const ProcessResult run = Hoplab({"check", "hops"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("with the sign of x turned"), run.out.npos) << run.out;
}

}  // namespace
}  // namespace hoplab::testing
