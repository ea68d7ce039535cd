// The whole published study with the shipped constants.
#include <gtest/gtest.h>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

// Of table 6.5, percentage points.
double EnergyRms(const nlohmann::json& record) {
  const nlohmann::json& table = record.at("comparison").at("statistics").at("table-6.5");
  return table.at("energy_rms_difference").at("value").get<double>();
}

TEST(ReproduceStudy, EverythingComesOutWithTheShippedConstants) {
  const TempFolder temp;
  const ProcessResult run =
      RunHoplab({"reproduce", "all", "--constants",
                 std::string(HOPLAB_SOURCE_DIR) + "/experiments/published.yaml", "--json"},
                temp.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json record = nlohmann::json::parse(run.out);
  EXPECT_EQ(record.at("tables").size(), 5u);
  EXPECT_EQ(record.at("figures").size(), 35u);
  EXPECT_EQ(record.at("claims").size(), 10u);
  EXPECT_TRUE(record.at("left_out").empty());
  EXPECT_LT(record.at("seconds").get<double>(), 180.0);
  // The constants do best on all tables together; docs/decisions/0005-study-constants.md.
  EXPECT_LT(EnergyRms(record), 0.595);
  EXPECT_EQ(record.at("tables")[3].at("name"), "table-6.4");
  EXPECT_EQ(record.at("tables")[3].at("verdict"), "reproduced");
  for (const nlohmann::json& claim : record.at("claims")) {
    if (claim.at("name") == "claim-level" || claim.at("name") == "claim-f") {
      EXPECT_EQ(claim.at("verdict"), "reproduced");
    } else if (claim.at("name") == "claim-sign") {
      EXPECT_EQ(claim.at("verdict"), "only under stated settings");
    }
  }
}

// The figure of docs/decisions/0005-study-constants.md: the bound of 0.23 is missed.
TEST(ReproduceStudy, TheConstantsOfTheEnergyTableAloneComeWithin0234Points) {
  const TempFolder temp;
  const ProcessResult run =
      RunHoplab({"reproduce", "table-6.5", "--constants",
                 std::string(HOPLAB_SOURCE_DIR) + "/experiments/published-energy.yaml", "--json"},
                temp.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NEAR(EnergyRms(nlohmann::json::parse(run.out)), 0.2340, 0.0001);
}

}  // namespace
}  // namespace hoplab::testing
