// `known` of a dataset: what the set-up says of causes.

#include "datasets/known_spec.h"

#include <gtest/gtest.h>

#include "datasets/write_dataset.h"
#include "tests/datasets/small_dataset.h"

namespace hoplab {
namespace {

using testing::ErrorWithYaml;
using testing::ReadWithYaml;

Dataset With(const std::string& known) {
  return ReadWithYaml("trials:\n", "known: " + known + "\ntrials:\n");
}
std::string KnownErrorWith(const std::string& known) {
  return ErrorWithYaml("trials:\n", "known: " + known + "\ntrials:\n");
}

TEST(Known, SaysNoneOrAtMostOfAnEffectOrOfItsParameters) {
  const Dataset dataset = With(
      "{gravity_scale: none, camera_roll: {at_most: 0.002}, boom_inertia: {mu_x: none, mu_y: "
      "{at_most: 0.1}}}");
  const std::vector<KnownSpec> expected = {{"gravity_scale", "", std::nullopt},
                                           {"camera_roll", "", 0.002},
                                           {"boom_inertia", "mu_x", std::nullopt},
                                           {"boom_inertia", "mu_y", 0.1}};
  EXPECT_EQ(dataset.known, expected);
  EXPECT_EQ(dataset.known[1].origin.place, "hops/dataset.yaml:17");
}

TEST(Known, IsWrittenAsItWasRead) {
  for (const char* known :
       {"{gravity_scale: none}", "{boom_inertia: {mu_x: none, mu_y: {at_most: 0.1}}}",
        "{air_drag: none, constant_force: {force_x: {at_most: 3}}, boom_inertia: {mu_x: none, "
        "mu_y: "
        "none}, camera_roll: {at_most: 0.002}}"}) {
    const Dataset dataset = With(known);
    std::map<std::string, std::string> files = FormatDataset(dataset);
    EXPECT_EQ(ReadDatasetText(files["dataset.yaml"], files), dataset) << files["dataset.yaml"];
  }
}

TEST(Known, NothingIsKnownWhereNothingIsSaid) {
  EXPECT_TRUE(testing::Read(testing::kYaml).known.empty());
  EXPECT_TRUE(With("{}").known.empty());
}

struct BadKnown {
  const char* known;
  const char* says;
};

void PrintTo(const BadKnown& bad, std::ostream* out) { *out << bad.known; }

class BadKnownTest : public ::testing::TestWithParam<BadKnown> {};

TEST_P(BadKnownTest, IsToldWithPlaceValueRuleAndRemedy) {
  EXPECT_EQ(KnownErrorWith(GetParam().known), GetParam().says);
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadKnownTest,
    ::testing::Values(
        BadKnown{"[gravity_scale]",
                 "hops/dataset.yaml:17: known = (a list); must be a block of keys and values. "
                 "Write `key: value` lines, or {key: value}."},
        BadKnown{"{gravity_scale: no}",
                 "hops/dataset.yaml:17: known.gravity_scale = no; must be none or {at_most: "
                 "NUMBER}. Write none if the set-up rules it out, {at_most: NUMBER} if it bounds "
                 "it."},
        BadKnown{"{gravity_scale: 0.01}",
                 "hops/dataset.yaml:17: known.gravity_scale = 0.01; must be none or {at_most: "
                 "NUMBER}. Write none if the set-up rules it out, {at_most: NUMBER} if it bounds "
                 "it."},
        BadKnown{"{gravity_scale:}",
                 "hops/dataset.yaml:17: known.gravity_scale = (nothing); must be a block of keys "
                 "and values. Write `key: value` lines, or {key: value}."},
        BadKnown{"{camera_roll: {at_most: -0.002}}",
                 "hops/dataset.yaml:17: known.camera_roll.at_most = -0.002; must be in (0, 1e15]. "
                 "Check the sign."},
        BadKnown{"{camera_roll: {at_most: 0}}",
                 "hops/dataset.yaml:17: known.camera_roll.at_most = 0; must be in (0, 1e15]. "
                 "Check the value."},
        BadKnown{"{camera_roll: {at_most: 2 mrad}}",
                 "hops/dataset.yaml:17: known.camera_roll.at_most = 2 mrad; is not a number; must "
                 "be in (0, 1e15]. Write a number such as 0.09 or 22e9, without unit."},
        BadKnown{"{camera_roll: {at_most: 0.1, at_least: 0}}",
                 "hops/dataset.yaml:17: known.camera_roll.at_least; unknown key. Known: "
                 "at_most."},
        BadKnown{"{boom_inertia: {mu_x: 0.1}}",
                 "hops/dataset.yaml:17: known.boom_inertia.mu_x = 0.1; must be none or {at_most: "
                 "NUMBER}. Write none if the set-up rules it out, {at_most: NUMBER} if it bounds "
                 "it."},
        BadKnown{"{boom_inertia: {}}",
                 "hops/dataset.yaml:17: known.boom_inertia = (a block of keys); must have at "
                 "least 1 key. Add what is missing."}));

}  // namespace
}  // namespace hoplab
