// Noise that is not what the dataset says: no crash, and how often a cause is seen in it.
// ctest -L statistics

#include <gtest/gtest.h>

#include "tests/fitting/diagnosis/study.h"

namespace hoplab::testing {
namespace {

struct LyingNoise {
  const char* name;
  NoiseModel model;
  bool level_holds;  // the nominal level is claimed for it
};

const std::vector<LyingNoise>& Noises() {
  using Kind = NoiseModel::Kind;
  static const std::vector<LyingNoise> noises = {
      {"white, as stated", {}, true},
      {"20 % of the samples dropped", {.dropped = 0.2}, true},
      {"stated sigma twice the true one", {.stated = 2.0}, true},
      {"stated sigma half the true one", {.stated = 0.5}, false},
      {"AR(1), 0.5", {.kind = Kind::kAutoregressive}, false},
      {"Student t3 of the same variance", {.kind = Kind::kStudent}, false},
      {"rounded to 1 sigma", {.kind = Kind::kQuantised}, false}};
  return noises;
}

TEST(DiagnosisStatistics, NoiseThatLiesDoesNotCrashAndItsFalseAlarmsArePrinted) {
  const int seeds = SeedCount(34);  // 204 over the laws
  std::vector<Truth> truths;
  for (std::size_t n = 0; n < Noises().size(); ++n) {
    for (std::size_t l = 0; l < kAllLaws.size(); ++l) {
      for (int i = 0; i < seeds; ++i) {
        truths.push_back({.law = kAllLaws[l],
                          .seed = NoiseSeed(Table::kNoise, static_cast<int>(1000 * l) + i),
                          .noise = Noises()[n].model});
      }
    }
  }
  const std::vector<Outcome> outcomes = RunAll(truths);
  const int each = seeds * static_cast<int>(kAllLaws.size());
  const auto [low, high] = Band99(each, kDetectionLevel);
  Report report("7-noise", "Noise that is not as stated");
  report.Say(
      "Datasets without an effect, %d a row, all laws. Nominal level 1 %%: 99 %% band of the "
      "count with p <= 0.01 %d to %d.",
      each, low, high);
  report.Head({"noise", "p <= 0.01", "not adequate", "one name", "refused"});
  for (std::size_t n = 0; n < Noises().size(); ++n) {
    int seen = 0, alarms = 0, named = 0, refused = 0;
    for (int i = 0; i < each; ++i) {
      const Outcome& o = outcomes[n * static_cast<std::size_t>(each) + static_cast<std::size_t>(i)];
      seen += o.global_p <= kDetectionLevel;
      alarms += o.verdict != Verdict::kAdequate;
      named += o.verdict == Verdict::kNamed;
      refused += !o.refusal.empty();
    }
    const auto cell = [&](int count) { return Cell("%d (%.1f %%)", count, PerCent(count, each)); };
    report.Row({Noises()[n].name, cell(seen), cell(alarms), cell(named), Cell("%d", refused)});
    if (Noises()[n].level_holds) {
      EXPECT_LE(alarms, high) << Noises()[n].name;
    }
  }
}

}  // namespace
}  // namespace hoplab::testing
