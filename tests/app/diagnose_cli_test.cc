// hoplab diagnose, on generated data whose cause is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

constexpr double kTrueDrag = 0.05;  // N s^2/m^2
// Few candidates keep these tests quick; the statistics suite tries the whole catalogue.
constexpr const char* kFew = "air_drag,touchdown_loss,sensor_delay";

class DiagnoseCli : public ::testing::Test {
 protected:
  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }
  // A dataset of drops in `name`, with effects as the command line writes them.
  void Generate(const std::string& name, const std::vector<std::string>& with) {
    // A second held-out trial: an interval of the gain takes four hops.
    const std::filesystem::path drops =
        std::filesystem::path(HOPLAB_SOURCE_DIR) / "experiments/three-drops.yaml";
    WriteText(
        temp_.path() / "drops.yaml",
        ReadText(drops) + "    - {role: test, touchdown_angle_deg: 27, initial: {y_m: 0.29}}\n");
    std::vector<std::string> arguments = {"generate", "drops.yaml", "--seed", "7", "--out", name};
    for (const std::string& effect : with) {
      arguments.emplace_back("--with");
      arguments.push_back(effect);
    }
    const ProcessResult run = Hoplab(arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  void GenerateWindy() { Generate("windy", {"air_drag:c_drag=0.05"}); }
  TempFolder temp_;
};

// No NaN, no infinity: JSON has neither, and a text in their place would be one.
void ExpectNoTextForANumber(const nlohmann::json& value) {
  if (value.is_string()) {
    EXPECT_NE(value, "nan");
    EXPECT_NE(value, "inf");
  }
  if (value.is_structured()) {
    for (const auto& element : value) ExpectNoTextForANumber(element);
  }
}

// Where nothing is seen nothing is refitted.
TEST_F(DiagnoseCli, SaysWhyACauseWithAThresholdWasNotTried) {
  Generate("sound", {});
  const ProcessResult run =
      Hoplab({"diagnose", "sound", "--effects", "leg_mass,foot_coulomb_friction", "--out", "run",
              "--quiet", "--plain"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("not tried"), std::string::npos) << run.out;
  EXPECT_EQ(run.out.find("no simulation ran"), std::string::npos) << run.out;
  const auto diagnosis = nlohmann::json::parse(ReadText(temp_.path() / "run/run.json"));
  EXPECT_EQ(diagnosis.at("refits"), 0);
  EXPECT_EQ(diagnosis.at("left_share"), 1.0);
  EXPECT_TRUE(diagnosis.at("odd_channel").is_null());
}

// What changes nothing while it is small has no slope to follow: it is sought from several sizes.
TEST_F(DiagnoseCli, FindsASlipperyFloorThatNoSlopeTellsOf) {
  Generate("slippery", {"leg_mass:m_leg=0.03", "foot_coulomb_friction:inverse_mu=2.2"});
  const ProcessResult run =
      Hoplab({"diagnose", "slippery", "--effects", "leg_mass,foot_coulomb_friction,touchdown_loss",
              "--out", "run", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out.find("not tried"), std::string::npos) << run.out;
  const auto diagnosis = nlohmann::json::parse(ReadText(temp_.path() / "run/run.json"));
  std::set<std::string> main;
  for (const auto& cause : diagnosis.at("causes")) {
    if (cause.at("main").get<bool>()) main.insert(cause.at("name"));
  }
  EXPECT_EQ(main, (std::set<std::string>{"leg_mass", "foot_coulomb_friction"}));
  EXPECT_TRUE(diagnosis.at("set_aside").empty());
  for (const auto& cause : diagnosis.at("causes")) EXPECT_FALSE(cause.at("stands_in").get<bool>());

  // A stand-in alone explains all that is explained, and not all of the misfit.
  const ProcessResult stand_in = Hoplab({"diagnose", "slippery", "--effects", "touchdown_loss",
                                         "--json", "--quiet", "--out", "stand-in"});
  const auto alone = nlohmann::json::parse(stand_in.out);
  ASSERT_EQ(alone.at("causes").size(), 1u) << stand_in.out;
  EXPECT_NEAR(alone.at("causes")[0].at("share").get<double>(), 1.0, 0.01);
  const double of_misfit = alone.at("causes")[0].at("share_of_misfit");
  EXPECT_LT(of_misfit, 0.9);
  EXPECT_NEAR(of_misfit, alone.at("extension").at("explained").get<double>(), 0.01);

  const ProcessResult fit = Hoplab({"fit", "slippery", "--with", "leg_mass,foot_coulomb_friction",
                                    "--json", "--quiet", "--out", "fit"});
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  const auto values = nlohmann::json::parse(fit.out).at("parameters");
  const auto friction = std::find_if(values.begin(), values.end(), [](const auto& p) {
    return p.at("name") == "foot_coulomb_friction.inverse_mu";
  });
  ASSERT_NE(friction, values.end());
  EXPECT_NEAR(friction->at("value").template get<double>(), 2.2, 0.25);
}

// A driven leg of another engine: 22 GPa, 10 g, a floor of friction 1. The floor hardly shows
// without the leg's mass, and the mass not without the floor.
TEST_F(DiagnoseCli, FindsWhatADrivenLegOfAnEngineHas) {
  // The whole catalogue takes a minute, beside other tests two.
  const ProcessResult run =
      RunHoplab({"diagnose", ShippedDataset("rig-controlled"), "--json", "--quiet"}, temp_.path(),
                std::chrono::seconds(400));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto diagnosis = nlohmann::json::parse(run.out);
  std::set<std::string> main;
  for (const auto& cause : diagnosis.at("causes")) {
    if (cause.at("main").get<bool>()) main.insert(cause.at("name"));
  }
  EXPECT_EQ(main,
            (std::set<std::string>{"leg_mass", "foot_coulomb_friction", "leg_material_damping"}));
  struct Truth {
    const char* name;
    double value, within;
    double beyond;  // how far it may be outside its interval
  };
  // Known, held where it is: how the damping is divided between the material (302 us, 151 to 385),
  // the chord and a quadratic one.
  for (const Truth& truth : {Truth{"E", 21.991e9, 0.006 * 21.991e9, 0.0},
                             {"leg_mass.m_leg", 0.010, 0.0015, 0.0},
                             {"foot_coulomb_friction.inverse_mu", 1.0, 0.1, 0.0},
                             {"leg_material_damping.tau", 400e-6, 110e-6, 20e-6}}) {
    const auto& all = diagnosis.at("extension").at("parameters");
    const auto p = std::find_if(all.begin(), all.end(),
                                [&](const auto& q) { return q.at("name") == truth.name; });
    ASSERT_NE(p, all.end()) << truth.name;
    EXPECT_NEAR(p->at("value"), truth.value, truth.within) << truth.name;
    const double low = p->at("ci95_between_trials").at(0),
                 high = p->at("ci95_between_trials").at(1);
    EXPECT_LT(low, truth.value + truth.beyond) << truth.name;
    EXPECT_GT(high, truth.value - truth.beyond) << truth.name;
  }
}

TEST_F(DiagnoseCli, NamesADragThatTheSimulationLacksWithEveryKeyOfTheContract) {
  GenerateWindy();
  const ProcessResult run =
      Hoplab({"diagnose", "windy", "--effects", kFew, "--out", "run", "--quiet"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out.find('\033'), std::string::npos) << "colours in a file";
  EXPECT_NE(run.out.find("The simulation lacks air_drag"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("outside the catalogue"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("run folder   run"), std::string::npos);
  EXPECT_EQ(run.out.find("nan"), std::string::npos) << run.out;

  const nlohmann::json record = ReadRecord(temp_.path() / "run");
  ExpectNoTextForANumber(record);
  EXPECT_EQ(record.at("schema"), "hoplab-run/1");
  EXPECT_EQ(record.at("command"), "diagnose");
  EXPECT_EQ(record.at("status"), "ok");
  EXPECT_EQ(record.at("dataset"), "three-drops");
  EXPECT_EQ(record.at("options").at("max_effects"), 5);
  EXPECT_EQ(record.at("verdict"), "named");
  EXPECT_EQ(record.at("cause"), "air_drag");
  EXPECT_EQ(record.at("group"), nlohmann::json::array({"air_drag"}));
  EXPECT_EQ(record.at("effects"), nlohmann::json::array({"air_drag"}));
  EXPECT_TRUE(record.at("only_in_trial").is_null());

  EXPECT_LT(record.at("detection").at("p_value"), 0.01);
  ASSERT_GT(record.at("detection").at("tests").size(), 3u) << "candidates, then probes";
  EXPECT_EQ(record.at("detection").at("tests")[0].at("name"), "air_drag");
  EXPECT_GT(record.at("detection").at("tests")[0].at("statistic"), 7.85);

  double share = 0.0;
  for (const auto& cell : record.at("localisation")) {
    share += cell.at("share").get<double>();
    EXPECT_TRUE(cell.at("mode").is_string() && cell.at("phase").is_string() &&
                cell.at("channel").is_string());
  }
  EXPECT_NEAR(share, 1.0, 1e-9);

  const auto& drag = record.at("candidates")[0];
  EXPECT_EQ(drag.at("effect"), "air_drag");
  EXPECT_EQ(drag.at("status"), "supported");
  EXPECT_TRUE(drag.at("score").is_number() && drag.at("predicted_gain").is_number());
  EXPECT_GT(drag.at("refit").at("heldout_gain"), 0.0);
  EXPECT_EQ(drag.at("refit").at("ci95").size(), 2u);
  EXPECT_EQ(drag.at("refit").at("parameters").back().at("name"), "air_drag.c_drag");

  const auto& extension = record.at("extension");
  const auto& parameter = extension.at("parameters").back();
  EXPECT_EQ(parameter.at("name"), "air_drag.c_drag");
  // Five standard errors: one seed in two million misses.
  EXPECT_NEAR(parameter.at("value").get<double>(), kTrueDrag,
              5.0 * parameter.at("std_error").get<double>());
  for (const char* when : {"test_before", "test_after"}) {
    EXPECT_GT(extension.at(when).at("rmse").at("body_x_m"), 0.0);
    EXPECT_TRUE(extension.at(when).at("nll_per_sample").is_number());
  }
  EXPECT_LT(extension.at("test_after").at("nll_per_sample"),
            extension.at("test_before").at("nll_per_sample"));
  EXPECT_GT(extension.at("heldout_gain").at("nats_per_sample"), 0.0);
  for (const char* when : {"base_parameters_before", "base_parameters_after"})
    EXPECT_GT(extension.at(when).at("E"), 1e9);
  EXPECT_TRUE(record.at("separating_experiment").is_null()) << "nothing to tell apart";
}

TEST_F(DiagnoseCli, CleanDataAreAdequate) {
  Generate("clean", {});
  const ProcessResult run = Hoplab({"diagnose", "clean", "--effects", kFew, "--out", "run"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("Nothing is missing that these data could show (p = "), std::string::npos)
      << run.out;
  const nlohmann::json record = ReadRecord(temp_.path() / "run");
  EXPECT_EQ(record.at("verdict"), "adequate");
  for (const char* key :
       {"cause", "extension", "separating_experiment", "free_forces", "probability_unlisted"})
    EXPECT_TRUE(record.at(key).is_null()) << key;
  EXPECT_TRUE(record.at("effects").empty());
  EXPECT_TRUE(record.at("group").empty());
  EXPECT_GT(record.at("detection").at("p_value"), 0.01);
  EXPECT_TRUE(record.at("candidates")[0].at("refit").is_null()) << "nothing was refitted";
}

TEST_F(DiagnoseCli, WithoutTheTrueCauseNoWrongOneIsNamed) {
  GenerateWindy();
  const ProcessResult run =
      Hoplab({"diagnose", "windy", "--effects", "touchdown_loss", "--json", "--out", "run"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("verdict"), "unexplained") << record.at("reason");
  EXPECT_TRUE(record.at("cause").is_null());
  EXPECT_TRUE(record.at("group").empty());
  EXPECT_FALSE(record.at("free_forces").empty());
  EXPECT_TRUE(std::filesystem::exists(temp_.path() / "run" / "forces.csv"));
}

TEST_F(DiagnoseCli, PointsToAFormulaUnlessItLooksForOne) {
  GenerateWindy();
  const std::vector<std::string> diagnose = {"diagnose", "windy", "--effects", "touchdown_loss"};
  const std::string pointer = "hoplab discover looks for one";
  const ProcessResult plain = Hoplab(diagnose);
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_NE(plain.out.find(pointer), std::string::npos) << plain.out;
  std::vector<std::string> with = diagnose;
  with.emplace_back("--discover");
  const ProcessResult sought = Hoplab(with);
  ASSERT_EQ(sought.exit_code, 0) << sought.err;
  EXPECT_EQ(sought.out.find(pointer), std::string::npos) << sought.out;
  EXPECT_NE(sought.out.find("A formula was found"), std::string::npos) << sought.out;
}

TEST_F(DiagnoseCli, TheTablesBehindThePlotsAreThere) {
  GenerateWindy();
  ASSERT_EQ(Hoplab({"diagnose", "windy", "--effects", kFew, "--out", "run"}).exit_code, 0);
  const auto header = [&](const std::string& file) {
    const std::string text = ReadText(temp_.path() / "run" / file);
    return text.substr(0, text.find('\n'));
  };
  EXPECT_EQ(header("candidates.csv").substr(0, 28), "effect,only_in_trial,status,");
  EXPECT_EQ(header("residuals.csv"), "trial,role,time_s,channel,measured,before,after,sigma");
  EXPECT_EQ(header("misfit.csv").substr(0, 22), "by,mode,phase,channel,");
  EXPECT_EQ(header("evidence.csv").substr(0, 23), "effect,parameter,trial,");
  EXPECT_EQ(header("energy.csv").substr(0, 28), "trial,hop,measured_begin_J,m");
}

// The running evidence adds up to the score it explains.
TEST_F(DiagnoseCli, TheEvidenceAddsUpToTheScore) {
  GenerateWindy();
  ASSERT_EQ(Hoplab({"diagnose", "windy", "--effects", "air_drag", "--out", "run"}).exit_code, 0);
  const std::string text = ReadText(temp_.path() / "run" / "evidence.csv");
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  double sum = 0.0;
  while (std::getline(lines, line)) sum += std::stod(line.substr(line.rfind(',') + 1));
  const double score = ReadRecord(temp_.path() / "run").at("candidates")[0].at("score");
  // What the priors on the initial states add is not listed.
  EXPECT_NEAR(sum / score, 1.0, 0.1);
}

TEST_F(DiagnoseCli, TheNumberOfThreadsChangesNothing) {
  GenerateWindy();
  std::vector<std::string> records;
  for (const char* jobs : {"1", "2"}) {
    ASSERT_EQ(
        Hoplab({"diagnose", "windy", "--effects", kFew, "--jobs", jobs, "--out", jobs}).exit_code,
        0);
    records.push_back(WithoutSeconds(ReadText(temp_.path() / jobs / "run.json")));
  }
  EXPECT_EQ(records[0], records[1]);
}

TEST_F(DiagnoseCli, AModelThatCannotBeFittedIsNotDiagnosed) {
  const ProcessResult run = Hoplab({"diagnose", ShippedDataset("rig-drops"), "--law", "thesis",
                                    "--span", "whole", "--out", "run"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.out.find("no verdict"), std::string::npos) << run.out;
  const nlohmann::json record = ReadRecord(temp_.path() / "run");
  EXPECT_EQ(record.at("status"), "failed");
  EXPECT_NE(record.at("message"), "");
  for (const char* key : {"verdict", "cause", "extension"})
    EXPECT_TRUE(record.at(key).is_null()) << key;
  EXPECT_TRUE(record.at("detection").at("p_value").is_null());
}

TEST_F(DiagnoseCli, WrongOptionsAreToldWithTheirRemedy) {
  Generate("clean", {});
  const ProcessResult both =
      Hoplab({"diagnose", "clean", "--effects", "air_drag", "--without", "sensor_delay"});
  EXPECT_EQ(both.exit_code, 64) << both.err;
  const ProcessResult unknown = Hoplab({"diagnose", "clean", "--effects", "air_drg"});
  EXPECT_EQ(unknown.exit_code, 65);
  EXPECT_NE(unknown.err.find("air_drag"), std::string::npos) << unknown.err;
  EXPECT_EQ(Hoplab({"diagnose", "nowhere", "--json"}).exit_code, 65);
  EXPECT_EQ(Hoplab({"diagnose", "clean", "--max-effects", "0"}).exit_code, 64);
}

TEST_F(DiagnoseCli, CtrlCKeepsWhatWasFinishedWithoutAVerdict) {
  GenerateWindy();
  const ProcessResult run =
      RunProcess({.command = {HOPLAB_BINARY, "diagnose", "windy", "--out", "run"},
                  .folder = temp_.path(),
                  .signal = SIGINT,
                  .signal_after = "refitting"});
  EXPECT_FALSE(run.timed_out);
  ASSERT_EQ(run.exit_code, 130) << run.err;
  EXPECT_NE(run.err.find("kept: run"), std::string::npos) << run.err;
  const nlohmann::json record = ReadRecord(temp_.path() / "run");
  EXPECT_EQ(record.at("status"), "failed");
  EXPECT_TRUE(record.at("verdict").is_null());
  EXPECT_TRUE(record.at("null").at("parameters")[0].at("value").is_number());
}

TEST(EffectsCli, ShowsTheCatalogueByKindAndOneInFull) {
  const TempFolder temp;
  const ProcessResult all = RunHoplab({"effects"}, temp.path());
  EXPECT_EQ(all.exit_code, 0);
  EXPECT_NE(all.out.find("What the sensors report"), std::string::npos);
  const ProcessResult one = RunHoplab({"effects", "air_drag"}, temp.path());
  EXPECT_EQ(one.exit_code, 0);
  EXPECT_NE(one.out.find("equation"), std::string::npos);
  EXPECT_EQ(one.out.find("sensor_delay"), std::string::npos);
  const ProcessResult unknown = RunHoplab({"effects", "air_drg"}, temp.path());
  EXPECT_EQ(unknown.exit_code, 65);
  EXPECT_NE(unknown.err.find("air_drag"), std::string::npos);
  const auto names = [&](const std::vector<std::string>& arguments) {
    const auto record = nlohmann::json::parse(RunHoplab(arguments, temp.path()).out);
    std::set<std::string> out;
    for (const auto& e : record.at("effects")) out.insert(e.at("name"));
    return out;
  };
  const std::set<std::string> every = names({"effects", "--json"});
  const std::set<std::string> ball = names({"effects", "--law", "ball", "--json"});
  EXPECT_TRUE(every.contains("leg_material_damping"));
  EXPECT_FALSE(ball.contains("leg_material_damping"));
  EXPECT_TRUE(ball.contains("air_drag"));
  EXPECT_EQ(RunHoplab({"effects", "--law", "nonsense"}, temp.path()).exit_code, 65);
}

}  // namespace
}  // namespace hoplab::testing
