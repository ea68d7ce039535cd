// Data the model explains: how often something is seen that is not there.
// ctest -L statistics

#include <gtest/gtest.h>

#include "tests/fitting/diagnosis/study.h"

namespace hoplab::testing {
namespace {

TEST(DiagnosisStatistics, CleanDataRaiseFalseAlarmsAtTheNominalLevel) {
  const int seeds = SeedCount(200);
  std::vector<Truth> truths;
  for (std::size_t l = 0; l < kAllLaws.size(); ++l) {
    for (int i = 0; i < seeds; ++i)
      truths.push_back({.law = kAllLaws[l],
                        .seed = NoiseSeed(Table::kFalseAlarms, static_cast<int>(1000 * l) + i)});
  }
  const std::vector<Outcome> outcomes = RunAll(truths);

  Report report("1-false-alarms", "False alarms");
  const auto [low1, high1] = Band99(seeds, kDetectionLevel);
  const auto [low5, high5] = Band99(seeds, 0.05);
  report.Say(
      "Datasets without an effect, %d seeds each law. Nominal: global p <= 0.01 in 1 %% (99 %% "
      "band of the count %d to %d), p <= 0.05 in 5 %% (%d to %d). A verdict other than "
      "`adequate` needs p <= 0.01 and an effect or free force that pays.",
      seeds, low1, high1, low5, high5);
  report.Head({"law", "not adequate", "p <= 0.01", "p <= 0.05", "refused", "CPU s each"});
  int all_seen1 = 0, all_seen5 = 0, all = 0;
  for (std::size_t l = 0; l < kAllLaws.size(); ++l) {
    int alarms = 0, seen1 = 0, seen5 = 0, refused = 0;
    double cpu = 0.0;
    for (int i = 0; i < seeds; ++i) {
      const Outcome& o =
          outcomes[l * static_cast<std::size_t>(seeds) + static_cast<std::size_t>(i)];
      refused += !o.refusal.empty();
      alarms += o.verdict != Verdict::kAdequate;
      seen1 += o.global_p <= kDetectionLevel;
      seen5 += o.global_p <= 0.05;
      cpu += o.cpu_seconds / seeds;
    }
    const std::string law(NameOf(kAllLaws[l]));
    report.Row({law, Cell("%d", alarms), Cell("%d", seen1), Cell("%d", seen5), Cell("%d", refused),
                Cell("%.2f", cpu)});
    EXPECT_LE(alarms, high1) << law;
    EXPECT_LE(seen5, high5) << law;
    EXPECT_GE(seen5, low5) << law;
    EXPECT_EQ(refused, 0) << law;
    all_seen1 += seen1;
    all_seen5 += seen5;
    all += seeds;
  }
  report.Row({"all", "", Cell("%d (%.1f %%)", all_seen1, PerCent(all_seen1, all)),
              Cell("%d (%.1f %%)", all_seen5, PerCent(all_seen5, all)), "", ""});
  const auto [low, high] = Band99(all, kDetectionLevel);
  EXPECT_GE(all_seen1, low);
  EXPECT_LE(all_seen1, high);
}

}  // namespace
}  // namespace hoplab::testing
