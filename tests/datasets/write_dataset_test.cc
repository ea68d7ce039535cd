#include "datasets/write_dataset.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "base/units.h"
#include "datasets/read_dataset.h"
#include "tests/datasets/small_dataset.h"
#include "tests/support/input_error_of.h"
#include "tests/support/temp_folder.h"

namespace hoplab {
namespace {

using testing::kYaml;
using testing::Read;
using testing::Replace;

Dataset RoundTrip(const Dataset& dataset) {
  std::map<std::string, std::string> files = FormatDataset(dataset);
  const std::string yaml = files["dataset.yaml"];
  files.erase("dataset.yaml");
  return ReadDatasetText(yaml, files, "again");
}

// Any positive number, all bits of it.
double Any(RandomStream* random) { return std::exp(random->Uniform(-8, 1.5)); }

StateSpec AnyState(RandomStream* random) {
  return {random->Normal(), Any(random), random->Normal(), random->Normal()};
}

MechanismSpec AnyMechanism(MechanismKind type, RandomStream* random) {
  MechanismSpec mechanism;
  mechanism.type = type;
  mechanism.body_mass_kg = Any(random);
  mechanism.gravity_m_per_s2 = Any(random);
  if (type == MechanismKind::kBall) {
    mechanism.ball = {Any(random), random->Uniform(0, 1), random->Uniform(0, 1), 1.1};
    return mechanism;
  }
  if (random->Normal() > 0) mechanism.liftoff = LiftoffRule::kRestLength;
  if (random->Normal() > 0) mechanism.fall_height_m = Any(random);
  if (random->Normal() > 0 && mechanism.liftoff == LiftoffRule::kZeroForce)
    mechanism.toe_mass_kg = Any(random);
  if (mechanism.toe_mass_kg && random->Normal() > 0)
    mechanism.placement = PlacementSpec{Any(random), Any(random)};
  for (const ReadingKey& key : ReadingKeys()) {
    const bool known = type == MechanismKind::kCLeg || key.key == "torque_sign";
    if (known && random->Normal() > 0)
      key.set(mechanism.reading, static_cast<int>(key.words.size()) - 1);
  }
  if (type == MechanismKind::kStraightLeg) {
    mechanism.straight_leg = {Any(random), Any(random), Any(random)};
    return mechanism;
  }
  CLegSpec& leg = mechanism.c_leg;
  leg = {Any(random), Any(random), Any(random), Any(random), Any(random),
         Any(random), Any(random), {},          {}};
  if (random->Normal() > 0) {
    leg.width_m = Any(random);
    leg.thickness_m = Any(random);
    const double h = *leg.thickness_m;
    leg.second_moment_m4 = *leg.width_m * h * h * h / 12;
    leg.area_m2 = *leg.width_m * h;
  }
  return mechanism;
}

std::optional<ControllerSpec> AnyController(RandomStream* random) {
  if (random->Normal() > 0) return std::nullopt;
  ControllerSpec controller = {Any(random), random->Normal(), {}};
  if (random->Normal() > 0) controller.torque_limit_N_m = Any(random);
  return controller;
}

Dataset AnyDataset(std::uint64_t seed) {
  RandomStream random(seed, 0);
  Dataset dataset;
  dataset.name = "any: \"name\" # of {a} \\ dataset, ä";
  dataset.title = seed % 2 == 0 ? "" : "two\nlines\tand a tab";
  if (seed % 3 == 0) dataset.source = {SourceKind::kSimulated, "hoplab", "CC0-1.0", ""};
  const auto type = static_cast<MechanismKind>(seed % 3);
  dataset.mechanism = AnyMechanism(type, &random);
  dataset.controller = AnyController(&random);
  dataset.channels = {{Channel::kBodyY, Any(&random)}, {Channel::kBodyX, std::nullopt}};
  for (int i = 0; i < 4; ++i) {
    Trial trial;
    trial.file = "run " + std::to_string(i) + ".csv";
    trial.role = i < 2 ? TrialRole::kTrain : TrialRole::kTest;
    trial.touchdown_angle_rad = DegToRad(random.Uniform(-89, 89));
    if (random.Normal() > 0) trial.initial = AnyState(&random);
    if (random.Normal() > 0)
      trial.initial_sigma = StateSpec{Any(&random), kFreeSigma, Any(&random), kFreeSigma};
    trial.mechanism = i % 2 == 0 ? dataset.mechanism : AnyMechanism(type, &random);
    trial.controller = i % 2 == 0 ? dataset.controller : AnyController(&random);
    trial.trace.columns = {{"body_y_m", {}}, {"extra", {}}, {"body_x_m", {}}};
    for (int k = 0; k < 20; ++k) {
      trial.trace.time_s.push_back(k * 0.01 + 0.001 * random.Uniform(0, 1));
      for (TraceColumn& column : trial.trace.columns)
        column.values.push_back(k == 3 ? std::nan("") : random.Normal());
    }
    dataset.trials.push_back(trial);
  }
  return dataset;
}

TEST(WriteDataset, WhatIsReadBackIsEqualNumberByNumber) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Dataset dataset = AnyDataset(seed);
    ASSERT_EQ(RoundTrip(dataset), dataset) << "seed " << seed << "\n"
                                           << FormatDataset(dataset)["dataset.yaml"];
  }
}

TEST(WriteDataset, WritesTheDegreesThatStoodThere) {
  const std::string yaml = FormatDataset(Read(kYaml))["dataset.yaml"];
  EXPECT_NE(yaml.find("touchdown_angle_deg: 25\n"), yaml.npos) << yaml;
}

TEST(WriteDataset, WritesOnlyWhatATrialHasOfItsOwn) {
  const std::string yaml = FormatDataset(
      Read(Replace(kYaml, "    role: test\n",
                   "    role: test\n    mechanism: {leg: {E_Pa: 21e9}}\n")))["dataset.yaml"];
  EXPECT_NE(yaml.find("    mechanism: {leg: {E_Pa: 2.1e10}}\n"), yaml.npos) << yaml;
}

TEST(WriteDataset, WritesNoSigmaOfAContactThatHasNone) {
  Dataset dataset = Read(kYaml);
  dataset.channels.push_back({Channel::kContact, std::nullopt});
  EXPECT_NE(FormatDataset(dataset)["dataset.yaml"].find("  contact: {}\n"), std::string::npos);
}

TEST(WriteDataset, WritesAFolderThatReadsBack) {
  const testing::TempFolder temp;
  const Dataset dataset = Read(kYaml);
  WriteDataset(dataset, temp.path() / "hops");
  EXPECT_EQ(ReadDataset(temp.path() / "hops"), dataset);
}

TEST(WriteDataset, RefusesToOverwrite) {
  const testing::TempFolder temp;
  const auto folder = temp.path() / "hops";
  WriteDataset(Read(kYaml), folder);
  EXPECT_EQ(testing::InputErrorOf([&] { WriteDataset(Read(kYaml), folder); }),
            folder.string() +
                ": exists already and is not overwritten. Choose another name or use --force.");
}

TEST(WriteDataset, ReplacesADatasetWithForce) {
  const testing::TempFolder temp;
  Dataset dataset = Read(kYaml);
  WriteDataset(dataset, temp.path() / "hops");
  dataset.name = "other";
  WriteDataset(dataset, temp.path() / "hops", {true});
  EXPECT_EQ(ReadDataset(temp.path() / "hops").name, "other");
}

TEST(WriteDataset, DoesNotReplaceAFolderThatIsNoDataset) {
  const testing::TempFolder temp;
  testing::WriteText(temp.path() / "home" / "thesis.tex", "x");
  EXPECT_NE(testing::InputErrorOf([&] { WriteDataset(Read(kYaml), temp.path() / "home", {true}); }),
            "(no error)");
  EXPECT_TRUE(std::filesystem::exists(temp.path() / "home" / "thesis.tex"));
}

}  // namespace
}  // namespace hoplab
