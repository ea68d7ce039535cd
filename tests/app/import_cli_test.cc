// `hoplab import` as its user meets it: what it asks, what it writes, what check says of the
// result.

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

bool Says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class ImportCli : public ::testing::Test {
 protected:
  ImportCli() {
    // A recorded drop, as a camera would have it: milliseconds, millimetres, z up.
    std::istringstream in(ReadText(ShippedDataset("rig-drops") + "/train-1.csv"));
    std::string text = "Time (ms),X,Z\n";
    std::getline(in, text_line_);
    for (double t, x, y; ReadRow(in, &t, &x, &y);)
      text += std::to_string(1e3 * t) + "," + std::to_string(1e3 * x) + "," +
              std::to_string(1e3 * y) + "\n";
    WriteText(temp_.path() / "drop.csv", text);
  }

  bool ReadRow(std::istream& in, double* t, double* x, double* y) {
    if (!std::getline(in, text_line_)) return false;
    char comma;
    return static_cast<bool>(std::istringstream(text_line_) >> *t >> comma >> *x >> comma >> *y);
  }

  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }

  TempFolder temp_;
  std::string text_line_;
};

TEST_F(ImportCli, GuessesAreShownAndNothingIsWrittenUntilTheyAreConfirmed) {
  const ProcessResult asked = Hoplab({"import", "drop.csv", "--out", "drops"});
  EXPECT_EQ(asked.exit_code, 64);
  EXPECT_EQ(asked.out, "");
  EXPECT_TRUE(Says(asked.err, "body_y_m  Z          mm  guessed  falls at "));
  EXPECT_TRUE(Says(asked.err, "--accept-guesses"));
  EXPECT_TRUE(Says(asked.err, "--map 't=Time (ms):ms' --map y=Z:mm --map x=X:mm")) << asked.err;
  EXPECT_EQ(CountEntries(temp_.path()), 1);

  const ProcessResult accepted =
      Hoplab({"import", "drop.csv", "--accept-guesses", "--out", "drops"});
  EXPECT_EQ(accepted.exit_code, 0) << accepted.err;
  EXPECT_TRUE(Says(accepted.out, "8 values in drops/dataset.yaml"));
  const ProcessResult said = Hoplab({"import", "drop.csv", "--map", "t=Time (ms):ms", "--map",
                                     "y=Z:mm", "--map", "x=X:mm", "--out", "said"});
  EXPECT_EQ(said.exit_code, 0) << said.err;
  EXPECT_EQ(ReadText(temp_.path() / "said" / "drop.csv"),
            ReadText(temp_.path() / "drops" / "drop.csv"));
}

TEST_F(ImportCli, ColumnsThatAreNotUsedAreSaidWhetherAskedOrAccepted) {
  std::string log = ReadText(temp_.path() / "drop.csv");
  log.replace(0, log.find('\n'), "Time (ms),X,Z,battery");
  for (std::size_t at = log.find('\n') + 1; at < log.size(); at = log.find('\n', at + 3) + 1)
    log.insert(log.find('\n', at), ",7");
  WriteText(temp_.path() / "drop.csv", log);
  const ProcessResult asked = Hoplab({"import", "drop.csv", "--out", "a"});
  EXPECT_TRUE(Says(asked.err, "  not used: battery\n")) << asked.err;
  const ProcessResult accepted = Hoplab({"import", "drop.csv", "--accept-guesses", "--out", "a"});
  EXPECT_TRUE(Says(accepted.out, "  not used    battery\n")) << accepted.out << accepted.err;
  const ProcessResult said =
      Hoplab({"import", "drop.csv", "--map", "t=Time (ms)", "--map", "y=Z:mm", "--out", "b"});
  EXPECT_TRUE(Says(said.out, "  not used    X, battery\n")) << said.out << said.err;
}

TEST_F(ImportCli, CheckFitAndDiagnoseSayWhatIsMissing) {
  ASSERT_EQ(Hoplab({"import", "drop.csv", "--accept-guesses", "--out", "drops"}).exit_code, 0);
  for (const char* command : {"check", "fit", "diagnose"}) {
    const ProcessResult run = Hoplab({command, "drops"});
    EXPECT_EQ(run.exit_code, 65);
    EXPECT_TRUE(Says(run.err, "drops/dataset.yaml: 8 values are still blank")) << run.err;
    for (const char* key : {"line 6  mechanism.body_mass_kg  (", "mechanism.leg.rest_radius_m",
                            "mechanism.leg.E_Pa", "trials[0].touchdown_angle_deg"})
      EXPECT_TRUE(Says(run.err, key)) << key;
  }
}

TEST_F(ImportCli, WithEveryValueSetTheResultCanBeFitted) {
  std::vector<std::string> arguments = {"import", "drop.csv", "--accept-guesses", "--out", "drops"};
  for (const char* value :
       {"body_mass_kg=1.01", "leg.rest_radius_m=0.09", "leg.E_Pa=20e9", "leg.G_Pa=4e9",
        "leg.width_m=0.03", "leg.thickness_m=0.0038", "leg.damping_N_s_per_m=1"}) {
    arguments.emplace_back("--set");
    arguments.push_back(std::string("mechanism.") + value);
  }
  arguments.insert(arguments.end(), {"--set", "trials.0.touchdown_angle_deg=22"});
  const ProcessResult made = Hoplab(arguments);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_FALSE(Says(made.out, "to fill in"));
  const ProcessResult check = Hoplab({"check", "drops"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_TRUE(Says(check.out, "nothing weakly")) << check.out;
}

TEST_F(ImportCli, WithJsonTheRecordTellsMapTrialsAndBlanks) {
  const ProcessResult run =
      Hoplab({"import", "drop.csv", "--accept-guesses", "--out", "drops", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("schema"), "hoplab-run/1");
  EXPECT_EQ(record.at("command"), "import");
  EXPECT_EQ(record.at("columns").at(1).at("channel"), "body_y_m");
  EXPECT_EQ(record.at("columns").at(1).at("column"), "Z");
  EXPECT_EQ(record.at("columns").at(1).at("guessed"), true);
  EXPECT_EQ(record.at("trials").at(0).at("rows"), 569);
  EXPECT_EQ(record.at("blank").size(), 8u);
}

TEST_F(ImportCli, NothingIsOverwrittenWithoutForceAndOnlyADatasetWithIt) {
  const std::vector<std::string> call = {"import", "drop.csv", "--accept-guesses", "--out", "d"};
  WriteText(temp_.path() / "d" / "thesis.txt", "years of work");
  EXPECT_EQ(Hoplab(call).exit_code, 65);
  std::vector<std::string> forced = call;
  forced.emplace_back("--force");
  EXPECT_EQ(Hoplab(forced).exit_code, 65);
  EXPECT_EQ(ReadText(temp_.path() / "d" / "thesis.txt"), "years of work");
  WriteText(temp_.path() / "d" / "dataset.yaml", "old");
  EXPECT_EQ(Hoplab(call).exit_code, 65);
  EXPECT_EQ(Hoplab(forced).exit_code, 0);
  EXPECT_TRUE(
      ReadText(temp_.path() / "d" / "dataset.yaml").starts_with("format: hoplab-dataset/1"));
}

TEST_F(ImportCli, OptionsThatSayNothingSensibleAreWrongUse) {
  const std::vector<std::vector<std::string>> calls = {
      {"--map", "y"},     {"--cut", "0.5"},         {"--cut", "a:b"},    {"--cut", "2:1"},
      {"--role", "test"}, {"--role", "drop.csv=1"}, {"--shift", "y"},    {"--shift", "y=a"},
      {"--set", "E"},     {"--rate", "-3"},         {"--type", "wheel"}, {"--format", "xls"}};
  for (const std::vector<std::string>& call : calls) {
    std::vector<std::string> arguments = {"import", "drop.csv", "--out", "d"};
    arguments.insert(arguments.end(), call.begin(), call.end());
    const ProcessResult run = Hoplab(arguments);
    EXPECT_EQ(run.exit_code, 64) << call[0] << " " << call[1] << ": " << run.err;
    EXPECT_TRUE(Says(run.err, "hoplab import --help"));
  }
  EXPECT_EQ(CountEntries(temp_.path()), 1);
}

TEST_F(ImportCli, OptionsThatNameWhatIsNotThereAreBadInput) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> calls = {
      {{"--map", "height=Z"}, "height; is no channel"},
      {{"--role", "dorp.csv=test"}, "dorp.csv; is none of the files to import. Did you mean drop"},
      {{"--cut", "9:10"}, "no row lies within the cut 9:10. The log spans 0 to 1.136 s"},
      {{"--map", "x=Z:mm", "--map", "y=Z:mm"},
       "column Z; is taken for body_y_m and for body_x_m. Name another column"},
      {{"--shift", "leg_angle=1:deg"}, "leg_angle; no column is taken for it. There are: t, y, x"},
      {{"--shift", "y=1", "--shift", "body_y=2"}, "--shift: body_y_m; is given twice"},
      {{"--shift", "y=3:kg"}, "body_y_m is a length. Units: m, mm"},
      {{"--set", "mechanism.leg.E_GPa=3"}, "Did you mean mechanism.leg.E_Pa?"},
      {{"--set", "mechanism.leg.E_Pa=3 GPa"}, "is not a number"},
      {{"--set", "mechanism.leg.E_Pa=-3"}, "must be in (0, 1e13] Pa"}};
  for (const auto& [call, says] : calls) {
    std::vector<std::string> arguments = {"import", "drop.csv", "--accept-guesses", "--out", "d"};
    arguments.insert(arguments.end(), call.begin(), call.end());
    const ProcessResult run = Hoplab(arguments);
    EXPECT_EQ(run.exit_code, 65) << run.err;
    EXPECT_TRUE(Says(run.err, says)) << run.err;
  }
  EXPECT_EQ(CountEntries(temp_.path()), 1);
}

// An option that messages tell of, and pages.
TEST_F(ImportCli, StampsAreMendedWhereThatIsAsked) {
  std::string text = ReadText(temp_.path() / "drop.csv");
  const std::size_t row = text.find('\n', text.find('\n') + 1) + 1;
  text.insert(row, text.substr(row, text.find('\n', row) + 1 - row));  // a row written twice
  WriteText(temp_.path() / "drop.csv", text);
  std::vector<std::string> call = {"import", "drop.csv", "--accept-guesses", "--out", "d"};
  call.insert(call.end(), {"--map", "t=Time:ms", "--map", "x=X:mm", "--map", "y=Z:mm"});
  const ProcessResult refused = Hoplab(call);
  EXPECT_EQ(refused.exit_code, 65);
  EXPECT_TRUE(Says(refused.err, "or say --mend-times")) << refused.err;
  call.emplace_back("--mend-times");
  const ProcessResult mended = Hoplab(call);
  EXPECT_EQ(mended.exit_code, 0) << mended.err;
  EXPECT_TRUE(Says(ReadText(temp_.path() / "d" / "dataset.yaml"), "mended")) << mended.err;
}

TEST_F(ImportCli, TheHelpFitsAScreen) {
  const ProcessResult help = Hoplab({"import", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_LE(std::count(help.out.begin(), help.out.end(), '\n'), 40);
  std::istringstream lines(help.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 110u) << line;
  EXPECT_TRUE(Says(help.out, "Examples:"));
}

}  // namespace
}  // namespace hoplab::testing
