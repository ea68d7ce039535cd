// The whole published study with the shipped constants.
#include <gtest/gtest.h>

#include "tests/app/hoplab_process.h"

namespace hoplab::testing {
namespace {

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
  EXPECT_LT(record.at("comparison")
                .at("statistics")
                .at("table-6.5")
                .at("energy_rms_difference")
                .at("value")
                .get<double>(),
            0.65);
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

}  // namespace
}  // namespace hoplab::testing
