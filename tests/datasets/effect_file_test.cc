#include "datasets/effect_file.h"

#include <gtest/gtest.h>

#include "datasets/read_dataset.h"
#include "datasets/read_scenario.h"
#include "tests/support/input_error_of.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

using testing::InputErrorOf;

const std::string kCable =
    "format: hoplab-effect/1\n"
    "name: cable\n"
    "acts_as: body_force_x\n"
    "formula: \"-k * max(x - x_end, 0)\"\n"
    "parameters:\n"
    "  k: {unit: N/m, null: 0, lower: 0, upper: 200, typical: 2}\n"
    "  x_end: {unit: m, value: 0.5, lower: -10, upper: 10}\n"
    "sentence: a cable pulls the body back\n";

std::string Changed(const std::string& from, const std::string& to) {
  std::string text = kCable;
  text.replace(text.find(from), from.size(), to);
  return text;
}

TEST(EffectFile, ReadsEveryKeyWithItsPlace) {
  const EffectFile file = ParseEffectFile(kCable, "cable.yaml");
  EXPECT_EQ(file.source.name, "cable");
  EXPECT_EQ(file.source.acts_as, "body_force_x");
  EXPECT_EQ(file.source.formula, "-k * max(x - x_end, 0)");
  EXPECT_EQ(file.formula_origin.place, "cable.yaml:4");
  EXPECT_EQ(file.acts_as_origin.place, "cable.yaml:3");
  ASSERT_EQ(file.source.parameters.size(), 2u);
  EXPECT_EQ(file.source.parameters[0].null, 0.0) << "the key null is the word";
  EXPECT_FALSE(file.source.parameters[0].value);
  EXPECT_EQ(file.source.parameters[0].typical, 2.0);
  EXPECT_EQ(file.source.parameters[1].value, 0.5);
  EXPECT_EQ(file.parameter_origins[1].place, "cable.yaml:7");
}

TEST(EffectFile, TellsWhatIsWrong) {
  const auto error = [](const std::string& text) {
    return InputErrorOf([&] { ParseEffectFile(text, "cable.yaml"); });
  };
  EXPECT_NE(error("").find("hoplab-effect/1"), std::string::npos);
  EXPECT_NE(error(Changed("effect/1", "dataset/1")).find("cable.yaml:1"), std::string::npos);
  EXPECT_NE(error(Changed("unit: N/m, ", "")).find("unit"), std::string::npos);
  EXPECT_NE(error(Changed("lower: 0", "lwoer: 0")).find("lower"), std::string::npos);
  EXPECT_NE(error(Changed("upper: 200", "upper: many")).find("cable.yaml:6"), std::string::npos);
  EXPECT_NE(error(Changed("formula:", "formul:")).find("formula"), std::string::npos);
  EXPECT_NE(error(kCable + std::string(1 << 20, '#')).find("bytes"), std::string::npos);
}

const std::string kScenario =
    "format: hoplab-scenario/1\nname: balls\n"
    "mechanism:\n  type: ball\n  body_mass_kg: 0.05\n  gravity_m_per_s2: 9.81\n"
    "  ball: {radius_m: 0.03, restitution: 0.7, tangential_loss: 0}\n";

TEST(EffectFile, StandsInAScenarioAsAFileABlockOrInAList) {
  const testing::TempFolder temp;
  testing::WriteText(temp.path() / "cable.yaml", kCable);
  const auto effects = [&](const std::string& text) {
    testing::WriteText(temp.path() / "s.yaml", kScenario + "effects: " + text + "\n");
    return ReadScenario(temp.path() / "s.yaml").effects;
  };
  const auto by_file = effects("{cable: {file: cable.yaml, k: 3}}");
  ASSERT_EQ(by_file.size(), 1u);
  EXPECT_EQ(by_file[0].formula->source.formula, "-k * max(x - x_end, 0)");
  EXPECT_EQ(by_file[0].parameters.at(0).value, 3.0);
  const auto by_list = effects("[air_drag, cable.yaml]");
  ASSERT_EQ(by_list.size(), 2u);
  EXPECT_TRUE(by_list[1].at_typical);
  EXPECT_EQ(by_list[1].name, "cable");
  const auto by_block = effects(
      "{pull: {k: 2, file: {format: hoplab-effect/1, name: pull, acts_as: body_force_x, formula: "
      "k, parameters: {k: {unit: N, null: 0, lower: 0, upper: 9}}}}}");
  EXPECT_EQ(by_block[0].formula->source.formula, "k");
  EXPECT_NE(InputErrorOf([&] { effects("{rope: {file: cable.yaml, k: 3}}"); }).find("cable"),
            std::string::npos);
}

TEST(EffectFile, ADatasetNamesFilesInItsFolder) {
  const std::string yaml =
      "format: hoplab-dataset/1\nname: a\nmechanism:\n  type: ball\n  body_mass_kg: 1\n"
      "  gravity_m_per_s2: 9.81\n  ball: {radius_m: 0.1, restitution: 0.7, tangential_loss: 0}\n"
      "channels: {body_y_m: {sigma: 0.01}}\neffects: [EFFECT]\n"
      "trials:\n  - {file: a.csv, role: train}\n";
  const auto read = [&](const std::string& effect) {
    std::string text = yaml;
    text.replace(text.find("EFFECT"), 6, effect);
    return ReadDatasetText(
        text, {{"a.csv", "time_s,body_y_m\n0,1\n0.1,0.9\n"}, {"cable.yaml", kCable}}, "");
  };
  EXPECT_EQ(read("cable.yaml").effects.at(0).source.name, "cable");
  EXPECT_NE(InputErrorOf([&] { read("../cable.yaml"); }).find("folder"), std::string::npos);
  EXPECT_NE(InputErrorOf([&] { read("air_drag"); }).find("hoplab-effect/1"), std::string::npos);
  EXPECT_NE(InputErrorOf([&] { read("rope.yaml"); }).find("no such file"), std::string::npos);
}

}  // namespace
}  // namespace hoplab
