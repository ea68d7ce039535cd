// The whole published study with the shipped constants.
#include <gtest/gtest.h>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

// "energy_rms_difference" of "table-6.5", ...
double Statistic(const nlohmann::json& record, const char* table, const char* name) {
  const nlohmann::json& statistics = record.at("comparison").at("statistics").at(table);
  return statistics.at(name).at("value").get<double>();
}
// Percentage points.
double EnergyRms(const nlohmann::json& record) {
  return Statistic(record, "table-6.5", "energy_rms_difference");
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
  // The constants do best on all tables together; the figures of
  // docs/decisions/0005-study-constants.md, bounds that they miss among them.
  EXPECT_EQ(record.at("tables")[0].at("name"), "table-6.1");
  EXPECT_EQ(record.at("tables")[0].at("verdict"), "reproduced");
  EXPECT_NEAR(Statistic(record, "table-6.1", "convergence_time_rank_correlation"), 0.75, 0.05);
  EXPECT_NEAR(Statistic(record, "table-6.2", "convergence_time_rms_difference"), 0.93, 0.05);
  EXPECT_NEAR(Statistic(record, "table-6.2", "convergence_time_rank_correlation"), 0.70, 0.05);
  EXPECT_NEAR(Statistic(record, "table-6.4", "convergence_time_rms_difference"), 0.27, 0.05);
  EXPECT_NEAR(EnergyRms(record), 0.406, 0.001);
  for (const nlohmann::json& claim : record.at("claims")) {
    if (claim.at("name") == "claim-level" || claim.at("name") == "claim-f") {
      EXPECT_EQ(claim.at("verdict"), "reproduced");
    } else if (claim.at("name") == "claim-sign") {
      EXPECT_EQ(claim.at("verdict"), "only under stated settings");
    }
  }
}

// The figure of docs/decisions/0005-study-constants.md.
TEST(ReproduceStudy, TheConstantsOfTheEnergyTableAloneComeWithin0234Points) {
  const TempFolder temp;
  const ProcessResult run =
      RunHoplab({"reproduce", "table-6.5", "--constants",
                 std::string(HOPLAB_SOURCE_DIR) + "/experiments/published-energy.yaml", "--json"},
                temp.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NEAR(EnergyRms(nlohmann::json::parse(run.out)), 0.2340, 0.0001);
}

// With every landing at the printed angle the damped times are out of reach.
TEST(ReproduceStudy, LandingsAsPrintedComeSecondsLate) {
  const TempFolder temp;
  const ProcessResult run = RunHoplab(
      {"reproduce", "table-6.2", "table-6.4", "--constants",
       std::string(HOPLAB_SOURCE_DIR) + "/experiments/published-as-printed.yaml", "--json"},
      temp.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json record = nlohmann::json::parse(run.out);
  EXPECT_NEAR(Statistic(record, "table-6.2", "convergence_time_rms_difference"), 3.94, 0.05);
  EXPECT_NEAR(Statistic(record, "table-6.4", "convergence_time_rms_difference"), 4.75, 0.05);
}

}  // namespace
}  // namespace hoplab::testing
