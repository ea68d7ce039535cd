// What a log of a real machine brings along: what is known of its set-up, from the command line.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

class RecordsCli : public ::testing::Test {
 protected:
  ProcessResult Hoplab(const std::vector<std::string>& arguments) {
    return RunHoplab(arguments, temp_.path());
  }
  // Three drops, generated; `more` at the end of their dataset.yaml.
  void Generate(const std::string& name, const std::string& more) {
    const ProcessResult run =
        Hoplab({"generate", std::string(HOPLAB_SOURCE_DIR) + "/experiments/three-drops.yaml",
                "--seed", "7", "--out", name});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::filesystem::path yaml = temp_.path() / name / "dataset.yaml";
    WriteText(yaml, ReadText(yaml) + more);
  }
  TempFolder temp_;
};

bool Contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(RecordsCli, WhatIsKnownIsToldByCheckFitAndDiagnose) {
  Generate("drops", "known: {gravity_scale: none, camera_roll: {at_most: 0.002}}\n");
  const std::string told = "gravity_scale none, camera_roll.";
  const auto known = [](const nlohmann::json& record) { return record.at("known"); };
  const ProcessResult check = Hoplab({"check", "drops", "--out", "checked"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_TRUE(Contains(check.out, told)) << check.out;
  const ProcessResult fit = Hoplab({"fit", "drops", "--out", "fitted", "--quiet"});
  EXPECT_EQ(fit.exit_code, 0) << fit.err;
  EXPECT_TRUE(Contains(fit.out, told)) << fit.out;
  EXPECT_TRUE(Contains(ReadText(temp_.path() / "fitted/report.html"), told));
  const ProcessResult diagnosis =
      Hoplab({"diagnose", "drops", "--without", "air_drag", "--out", "diagnosed", "--quiet"});
  EXPECT_EQ(diagnosis.exit_code, 0) << diagnosis.err;
  EXPECT_TRUE(Contains(diagnosis.out, told)) << diagnosis.out;
  for (const char* folder : {"checked", "fitted", "diagnosed"}) {
    const nlohmann::json said = known(ReadRecord(temp_.path() / folder));
    ASSERT_EQ(said.size(), 2u) << folder;
    EXPECT_EQ(said[0].at("effect"), "gravity_scale");
    EXPECT_EQ(said[0].at("at_most"), 0.0);
    EXPECT_EQ(said[1].at("at_most"), 0.002);
    EXPECT_EQ(said[1].at("unit"), "rad");
  }
  const nlohmann::json candidates = ReadRecord(temp_.path() / "diagnosed").at("candidates");
  EXPECT_TRUE(std::none_of(candidates.begin(), candidates.end(),
                           [](const auto& c) { return c.at("effect") == "gravity_scale"; }));
}

TEST_F(RecordsCli, CheckTellsTheReadingOfTheLaw) {
  Generate("drops", "");
  const std::filesystem::path yaml = temp_.path() / "drops" / "dataset.yaml";
  std::string text = ReadText(yaml);
  const std::size_t leg = text.find("E_Pa:");
  ASSERT_NE(leg, text.npos) << text;
  WriteText(yaml, text.insert(leg, "variant: {torque_sign: printed}, "));
  const ProcessResult check = Hoplab({"check", "drops", "--law", "thesis", "--json"});
  ASSERT_EQ(check.exit_code, 0) << check.err;
  EXPECT_EQ(nlohmann::json::parse(check.out).at("law_variant").at("torque_sign"), "printed");
}

TEST_F(RecordsCli, WhatIsRuledOutIsRefusedWithTheReason) {
  Generate("drops", "known: {air_drag: none}\n");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"fit", "drops", "--with", "air_drag"},
        {"diagnose", "drops", "--effects", "air_drag"},
        {"check", "drops", "--free", "E,air_drag.c_drag"}}) {
    const ProcessResult run = Hoplab(command);
    EXPECT_EQ(run.exit_code, 65) << command[0];
    EXPECT_TRUE(Contains(run.err, "air_drag: none") || Contains(run.err, "air_drag none"))
        << run.err;
    EXPECT_FALSE(std::filesystem::exists(temp_.path() / "runs"));
  }
}

TEST_F(RecordsCli, SomethingKnownOfNoEffectIsBadInput) {
  Generate("drops", "known: {gravity: none}\n");
  const ProcessResult run = Hoplab({"fit", "drops"});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_TRUE(Contains(run.err, "drops/dataset.yaml:")) << run.err;
  EXPECT_TRUE(Contains(run.err, "Did you mean gravity_scale?")) << run.err;
}

}  // namespace
}  // namespace hoplab::testing
