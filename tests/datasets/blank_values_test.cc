#include "datasets/blank_values.h"

#include <gtest/gtest.h>

#include "tests/datasets/small_dataset.h"
#include "tests/support/input_error_of.h"

namespace hoplab {
namespace {

using testing::InputErrorOf;
using testing::kYaml;
using testing::Read;
using testing::Replace;

TEST(BlankValues, AllThatAFitNeedsAreListedAtOnceWithTheirLines) {
  std::string yaml = Replace(kYaml, "body_mass_kg: 1.0", "body_mass_kg:");
  yaml = Replace(yaml, "E_Pa: 22e9", "E_Pa: null  # ask");
  yaml = Replace(yaml, "touchdown_angle_deg: 30", "touchdown_angle_deg: ~");
  EXPECT_EQ(InputErrorOf([&] { Read(yaml); }),
            "hops/dataset.yaml: 3 values are still blank, and a fit needs them. "
            "Write each behind its key:\n"
            "  line 5  mechanism.body_mass_kg  (all that the leg carries, itself included: weigh "
            "it)\n"
            "  line 9  mechanism.leg.E_Pa  (Young's modulus, the start of the fit: a data sheet "
            "will do)\n"
            "  line 24  trials[1].touchdown_angle_deg  (toe ahead positive: from the set-up or a "
            "still of the film)");
}

TEST(BlankValues, WhatAllTrialsWantIsToldOnce) {
  std::string yaml = Replace(kYaml, "touchdown_angle_deg: 25", "touchdown_angle_deg:");
  yaml = Replace(yaml, "touchdown_angle_deg: 30", "touchdown_angle_deg:");
  EXPECT_EQ(InputErrorOf([&] { Read(yaml); }),
            "hops/dataset.yaml: 2 values are still blank, and a fit needs them. "
            "Write each behind its key:\n"
            "  line 20  trials[0].touchdown_angle_deg  (toe ahead positive: from the set-up or a "
            "still of the film), likewise line 24");
}

TEST(BlankValues, NoneAreFoundInAFilledDatasetOrInWhatIsNone) {
  EXPECT_TRUE(FindBlankValues(ParseYaml(kYaml, "dataset.yaml")).empty());
  EXPECT_TRUE(FindBlankValues(ParseYaml("mechanism: {type: wheel}\n", "x.yaml")).empty());
  EXPECT_TRUE(FindBlankValues(ParseYaml("[1, 2]\n", "x.yaml")).empty());
}

TEST(BlankValues, EveryNeededValueIsOneThatTheReaderAsksFor) {
  // Each key left out of a complete block must be missed by the reader, so none is on the list in
  // vain.
  for (const NeededValue& needed : NeededValues(MechanismKind::kCLeg)) {
    const std::string key = needed.key.substr(needed.key.find('.') + 1);
    std::string yaml = kYaml;
    const std::size_t at = yaml.find(" " + key + ":") + 1;
    yaml.erase(at, yaml.find('\n', at) - at);
    EXPECT_NE(InputErrorOf([&] { Read(yaml); }).find(key), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace hoplab
