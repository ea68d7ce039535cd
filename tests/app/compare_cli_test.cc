// `hoplab compare`: one dataset, every law of the leg.
#include <gtest/gtest.h>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

TEST(CompareCli, PrintsEveryLawAgainstTheTruth) {
  const TempFolder temp;
  const ProcessResult run =
      RunHoplab({"compare", ShippedDataset("rig-drops"), "--true", "E=21.991e9"}, temp.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* law : {"large_deflection", "consistent", "no_slip", "thesis"})
    EXPECT_NE(run.out.find(law), std::string::npos) << law;
  EXPECT_NE(run.out.find("(+4."), std::string::npos) << run.out;
}

TEST(CompareCli, ATruthOfWhatIsNotFittedIsRefused) {
  const TempFolder temp;
  const ProcessResult run = RunHoplab(
      {"compare", ShippedDataset("rig-drops"), "--variant", "consistent", "--true", "e_Pa=21e9"},
      temp.path());
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_NE(run.err.find("--true: e_Pa; is no value that is fitted"), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("fitting each model"), std::string::npos) << "after the fits: " << run.err;
}

// Laws and effects were told by --variant, so that is what a message names.
TEST(CompareCli, AVariantThatDoesNotExistIsToldAsOne) {
  const TempFolder temp;
  for (const auto& [variant, told] :
       {std::pair("nolaw", "--variant: law = nolaw; is not a law"),
        std::pair("consistent+air_darg", "--variant: effect air_darg; is not in the catalogue")}) {
    const ProcessResult run =
        RunHoplab({"compare", ShippedDataset("rig-drops"), "--variant", variant}, temp.path());
    EXPECT_EQ(run.exit_code, 65);
    EXPECT_NE(run.err.find(told), std::string::npos) << run.err;
  }
}

TEST(CompareCli, TheElasticaWithItsLegsDampingAndMassBringsTheModulusWithinOnePercent) {
  const TempFolder temp;
  const ProcessResult run = RunHoplab({"compare", ShippedDataset("rig-drops"), "--variant",
                                       "elastica+leg_material_damping+leg_mass", "--json"},
                                      temp.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json row = nlohmann::json::parse(run.out).at("rows").at(0);
  // E I of the rig, by its truth file: 2.69101 N m^2, with the dataset's section 21.991 GPa.
  EXPECT_NEAR(row.at("parameters").at("E").get<double>() / 21.991e9, 1.0, 0.01);
  for (const char* channel : {"body_x_m", "body_y_m"})
    EXPECT_LT(row.at("test_rmse").at(channel).get<double>(), 0.0006) << channel;
}

}  // namespace
}  // namespace hoplab::testing
