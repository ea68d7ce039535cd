// Effects as formulas on the command line.
#include <gtest/gtest.h>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

const char* const kCable =
    "format: hoplab-effect/1\nname: cable\nacts_as: body_force_x\n"
    "formula: \"-k * max(x - x_end, 0)^2 / x_end\"\n"
    "parameters:\n  k: {unit: N/m, null: 0, lower: 0, upper: 200, typical: 2}\n"
    "  x_end: {unit: m, value: 0.1, lower: 0.01, upper: 10}\n"
    "sentence: a cable pulls the body back\n";

class FormulaCli : public ::testing::Test {
 protected:
  void SetUp() override { WriteText(temp_.path() / "cable.yaml", kCable); }
  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }
  TempFolder temp_;
};

TEST_F(FormulaCli, EffectsChecksAndExplainsAFile) {
  const ProcessResult run = Hoplab({"effects", "cable.yaml"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("-k max(x - x_end, 0)²/x_end"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("held at 0.1 unless freed by name"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("1 corner; the solver stops there"), std::string::npos) << run.out;
  const auto record = nlohmann::json::parse(Hoplab({"effects", "cable.yaml", "--json"}).out);
  EXPECT_EQ(record["effects"][0]["acts_as"], "body_force_x");
  EXPECT_NE(record["effects"][0]["mathml"].get<std::string>().find("<msup>"), std::string::npos);
}

TEST_F(FormulaCli, AMistakeHasACaretAndExitCode65) {
  std::string text = kCable;
  text.replace(text.find("x_end, 0"), 8, "x_emd, 0");
  WriteText(temp_.path() / "cable.yaml", text);
  const ProcessResult run = Hoplab({"effects", "cable.yaml"});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_NE(run.err.find("cable.yaml:4"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("Did you mean x_end?"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("^~~~~"), std::string::npos) << run.err;
}

// The body begins at x = 0, where the logarithm has no value.
TEST_F(FormulaCli, AFormulaThatIsNoNumberIsNamedWithWhereThatIs) {
  std::string text = kCable;
  const std::string formula = "-k * max(x - x_end, 0)^2 / x_end";
  text.replace(text.find(formula), formula.size(), "-k * x * log(x / x_end)");
  WriteText(temp_.path() / "cable.yaml", text);
  WriteScenario(temp_.path());
  const ProcessResult run =
      Hoplab({"simulate", "hops.yaml", "--with", "cable.yaml:k=5", "--out", "a"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("the formula cable (body_force_x), -k * x * log(x / x_end), is no number "
                         "at x = 0 m"),
            std::string::npos)
      << run.err;
  EXPECT_EQ(run.err.find("leg law"), std::string::npos) << run.err;
}

TEST_F(FormulaCli, ATypicalSizeBeyondTheBoundsIsRefused) {
  for (const char* typical : {"201", "-2"}) {
    std::string text = kCable;
    text.replace(text.find("typical: 2"), 10, std::string("typical: ") + typical);
    WriteText(temp_.path() / "cable.yaml", text);
    const ProcessResult run = Hoplab({"effects", "cable.yaml"});
    EXPECT_EQ(run.exit_code, 65);
    EXPECT_NE(run.err.find("cable.yaml:6: parameters.k.typical = " + std::string(typical) +
                           "; leads out of its bounds [0, 200]"),
              std::string::npos)
        << run.err;
  }
}

TEST_F(FormulaCli, AScenarioTakesAFileByOptionAndByKey) {
  WriteScenario(temp_.path());
  const ProcessResult by_option =
      Hoplab({"simulate", "hops.yaml", "--with", "cable.yaml:k=5", "--sensitivities",
              "cable.k,cable.x_end", "--json", "--out", "a"});
  ASSERT_EQ(by_option.exit_code, 0) << by_option.err;
  WriteScenario(temp_.path(), "effects: {cable: {file: cable.yaml, k: 5}}\n");
  const ProcessResult by_key = Hoplab(
      {"simulate", "hops.yaml", "--sensitivities", "cable.k,cable.x_end", "--json", "--out", "b"});
  ASSERT_EQ(by_key.exit_code, 0) << by_key.err;
  const auto a = ReadRecord(temp_.path() / "a"), b = ReadRecord(temp_.path() / "b");
  EXPECT_EQ(a["events"], b["events"]);
  EXPECT_NE(ReadText(temp_.path() / "a/events.csv").find("corner"), std::string::npos);
}

TEST_F(FormulaCli, FitTakesAFileAndSaysItsFormula) {
  const ProcessResult run = Hoplab({"fit", ShippedDataset("rig-drops"), "--with", "cable.yaml",
                                    "--law", "consistent", "--out", "fit", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto record = ReadRecord(temp_.path() / "fit");
  EXPECT_EQ(record["formulas"][0]["name"], "cable");
  bool fitted = false;
  for (const auto& p : record["parameters"]) fitted = fitted || p["name"] == "cable.k";
  EXPECT_TRUE(fitted);
}

// Of a recording, whose errors are of many kinds.
TEST_F(FormulaCli, DiscoverEndsWithAFormulaForTheRig) {
  const ProcessResult run =
      Hoplab({"discover", ShippedDataset("rig-drops"), "--quiet", "--out", "run"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto record = ReadRecord(temp_.path() / "run");
  EXPECT_EQ(record["verdict"], "found");
  ASSERT_FALSE(record["discovered"].empty());
  // The joints of its leg are viscous.
  EXPECT_EQ(record["discovered"][0]["acts_as"], "chord_force");
  EXPECT_NE(record["discovered"][0]["formula"].get<std::string>().find("rate"), std::string::npos);
}

}  // namespace
}  // namespace hoplab::testing
