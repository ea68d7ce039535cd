// `hoplab export` and `hoplab report` of several runs, as a user types them.
#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

class ExportCli : public ::testing::Test {
 protected:
  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }
  // A run that every law has, by a scenario of a second.
  void Simulate(const std::string& out, const std::vector<std::string>& more = {}) {
    const std::string file = WriteScenario(temp_.path());
    std::vector<std::string> words = {"simulate", file, "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    const ProcessResult run = Hoplab(words);
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  void Refused(const std::vector<std::string>& words, const std::vector<std::string>& parts,
               int exit_code = 65) {
    const ProcessResult run = Hoplab(words);
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    for (const std::string& part : parts)
      EXPECT_NE(run.err.find(part), std::string::npos) << part << "\n" << run.err;
  }
  // The run's record with a part of it replaced.
  void Change(const std::string& run, const std::string& pointer, const nlohmann::json& value) {
    nlohmann::json record = ReadRecord(temp_.path() / run);
    record[nlohmann::json::json_pointer(pointer)] = value;
    WriteText(temp_.path() / run / "run.json", record.dump());
  }
  TempFolder temp_;
};

TEST_F(ExportCli, WritesWhatIsAskedForAndNothingOverAnother) {
  Simulate("run");
  const ProcessResult both = Hoplab({"export", "run", "--c", "leg.c", "--mujoco", "leg.xml"});
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_EQ(both.out, "leg.c\nleg.xml\n");
  EXPECT_EQ(ReadText(temp_.path() / "leg.c").find("/* The compliant leg of "), 0u);
  EXPECT_NE(ReadText(temp_.path() / "leg.xml").find("<mujoco"), std::string::npos);
  Refused({"export", "run", "--c", "leg.c"}, {"leg.c"});
  Refused({"export", "run", "--c", "new.c", "--mujoco", "leg.xml"}, {"leg.xml"});
  EXPECT_FALSE(std::filesystem::exists(temp_.path() / "new.c")) << "one of two is none";
  Refused({"export", "run", "--c", "both", "--mujoco", "both"}, {"the same file"}, 64);
  const ProcessResult again =
      Hoplab({"export", "run/", "--c", "leg.c", "--force", "--json", "--quiet"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  const nlohmann::json record = nlohmann::json::parse(again.out);
  EXPECT_EQ(record["command"], "export");
  EXPECT_EQ(record["law"], "elastica");
  EXPECT_EQ(record["files"], nlohmann::json::array({"leg.c"}));
}

TEST_F(ExportCli, AFitsValuesAreInTheFiles) {
  ASSERT_EQ(
      Hoplab({"fit", ShippedDataset("rig-drops"), "--law", "consistent", "--quiet", "--out", "fit"})
          .exit_code,
      0);
  ASSERT_EQ(Hoplab({"export", "fit", "--c", "leg.c", "--mujoco", "leg.xml"}).exit_code, 0);
  const nlohmann::json record = ReadRecord(temp_.path() / "fit");
  const double E = record["parameters"][0]["value"], d = record["parameters"][1]["value"];
  const double I = record["mechanism"]["parameters"]["I"];
  const std::string text = ReadText(temp_.path() / "leg.c");
  const auto defined = [&](const std::string& name) {
    const std::size_t at = text.find("#define " + name + " ");
    EXPECT_NE(at, std::string::npos) << name;
    return std::stod(text.substr(at + 9 + name.size()));
  };
  EXPECT_DOUBLE_EQ(defined("LEG_EI"), E * I);
  EXPECT_EQ(defined("LEG_D"), d);
  const std::string model = ReadText(temp_.path() / "leg.xml");
  EXPECT_NE(model.find("fitted under the law consistent"), std::string::npos);
  for (const nlohmann::json& trial : record["trials"])
    EXPECT_NE(model.find("<key name=\"" + trial["file"].get<std::string>() + "\""),
              std::string::npos);
}

TEST_F(ExportCli, WhatCannotBeExportedIsRefusedWithPlaceAndRemedy) {
  Simulate("run");
  Refused({"export", "run"}, {"--c leg.c"}, 64);
  Refused({"export", "absent", "--c", "leg.c"}, {"absent", "has no run.json"});
  Refused({"export", "run", "--mujoco", "leg.xml", "--arcs", "2"}, {"--arcs"}, 64);
  Simulate("sinking", {"--with", "ground_compliance:c_g=1e-5"});
  for (const char* option : {"--c", "--mujoco"})
    Refused({"export", "sinking", option, "leg"},
            {"sinking/run.json: effects: ground_compliance (c_g = ", "Fit without it"});
  const std::string shipped = std::string(HOPLAB_SOURCE_DIR) + "/experiments/";
  ASSERT_EQ(Hoplab({"sweep", shipped + "modulus.yaml", "--quiet", "--out", "sweep"}).exit_code, 0);
  Refused({"export", "sweep", "--c", "leg.c"}, {"command = sweep; must be a run with a model"});
  ASSERT_EQ(Hoplab({"simulate", shipped + "toe-mass.yaml", "--out", "toe"}).exit_code, 0);
  Refused({"export", "toe", "--c", "leg.c"}, {"m_toe = ", "leg_mass"});
  Change("run", "/command", "fit");
  Change("run", "/status", "stuck");
  Refused({"export", "run", "--c", "leg.c"}, {"status = stuck", "its values are no estimate"});
  Change("run", "/command", "simulate");
  Change("run", "/mechanism/law", "elastika");
  Refused({"export", "run", "--c", "leg.c"}, {"law = elastika; is no law of this hoplab"});
  Change("run", "/mechanism/law", "elastica");
  Change("run", "/mechanism/parameters/E", "stiff");
  Refused({"export", "run", "--c", "leg.c"}, {"E = \"stiff\"; must be a number", "anew"});
  nlohmann::json old = ReadRecord(temp_.path() / "run");
  old["mechanism"].erase("law");
  WriteText(temp_.path() / "run" / "run.json", old.dump());
  Refused({"export", "run", "--c", "leg.c"}, {"an earlier hoplab wrote this run"});
  EXPECT_FALSE(std::filesystem::exists(temp_.path() / "leg.c"));
}

// The program of docs/export.md, as it stands there: it hops as the simulation did.
TEST_F(ExportCli, TheExampleOfTheDocumentHopsAsTheSimulation) {
  const std::filesystem::path source = HOPLAB_SOURCE_DIR;
  const std::string scenario = (source / "experiments/three-drops.yaml").string();
  ASSERT_EQ(Hoplab({"simulate", scenario, "--out", "run"}).exit_code, 0);
  ASSERT_EQ(Hoplab({"export", "run", "--c", "leg.c"}).exit_code, 0);
  const std::string page = ReadText(source / "docs/export.md"), fence = "```";
  const std::size_t begin = page.find(fence + "c\n") + 5, end = page.find(fence, begin);
  WriteText(temp_.path() / "hop.c", page.substr(begin, end - begin));
  const ProcessResult compiled =
      RunProcess({.command = {"/usr/bin/env", "cc", "-std=c99", "-Wall", "-Wextra", "-Werror",
                              "-pedantic", "-O1", "hop.c", "-o", "hop", "-lm"},
                  .folder = temp_.path()});
  ASSERT_EQ(compiled.exit_code, 0) << compiled.err;
  const ProcessResult run = RunProcess({.command = {(temp_.path() / "hop").string()}});
  ASSERT_EQ(run.exit_code, 0);
  double x = 0.0, y = 0.0;
  ASSERT_EQ(std::sscanf(run.out.c_str(), "%lf %lf", &x, &y), 2) << run.out;
  std::istringstream rows(ReadText(temp_.path() / "run" / "trajectory.csv"));
  bool met = false;
  for (std::string row; std::getline(rows, row);) {
    double t = 0.0, at_x = 0.0, at_y = 0.0;
    if (std::sscanf(row.c_str(), "%lf,%lf,%lf", &t, &at_x, &at_y) != 3 || t != 0.4) continue;
    EXPECT_NEAR(x, at_x, 2e-5);  // its steps are of first order
    EXPECT_NEAR(y, at_y, 2e-5);
    met = true;
  }
  EXPECT_TRUE(met);
}

// The same rig before and after: half the damping.
TEST_F(ExportCli, ReportTellsWhatANewBearingChanged) {
  for (const auto& [name, damping, seed] :
       std::vector<std::array<std::string, 3>>{{"old", "4", "1"}, {"new", "2", "2"}}) {
    const std::string scenario = std::string(HOPLAB_SOURCE_DIR) + "/experiments/three-drops.yaml";
    ASSERT_EQ(Hoplab({"generate", scenario, "--set", "mechanism.leg.damping_N_s_per_m=" + damping,
                      "--seed", seed, "--out", name})
                  .exit_code,
              0);
    ASSERT_EQ(Hoplab({"fit", name, "--quiet", "--out", name + "-fit"}).exit_code, 0);
  }
  const ProcessResult run = Hoplab({"report", "old-fit", "new-fit", "--out", "both"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("From old-fit to new-fit: d fell from"), std::string::npos) << run.out;
  const nlohmann::json record = ReadRecord(temp_.path() / "both");
  EXPECT_EQ(record["clear_changes"], 1);
  const nlohmann::json& E = record["values"][0]["runs"][1];
  const nlohmann::json& d = record["values"][1]["runs"][1];
  EXPECT_EQ(E["clear"], false);
  EXPECT_LT(d["difference_ci95"][0].get<double>(), -2.0);
  EXPECT_GT(d["difference_ci95"][1].get<double>(), -2.0);
  EXPECT_NE(
      ReadText(temp_.path() / "both" / "report.html").find("Comparison of old-fit and new-fit"),
      std::string::npos);
  EXPECT_NE(ReadText(temp_.path() / "both" / "values.csv").find("d,N s/m,new-fit,"),
            std::string::npos);
  // The page again, and the record alone.
  EXPECT_EQ(Hoplab({"report", "both"}).exit_code, 0);
  const ProcessResult json = Hoplab({"report", "old-fit", "new-fit", "--json"});
  EXPECT_EQ(nlohmann::json::parse(json.out)["clear_changes"], 1);
  EXPECT_TRUE(std::filesystem::exists(temp_.path() / "runs" / "old-fit-comparison-001"));
  Refused({"report", "old-fit", "new-fit", "--out", "both"}, {"both"});
  Refused({"report", "old-fit", "--out", "one"}, {"two or more runs"}, 64);
  Simulate("hops");
  Refused({"report", "old-fit", "hops"}, {"hops/run.json: command = simulate", "fit or diagnose"});
}

}  // namespace
}  // namespace hoplab::testing
