#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fitting/diagnosis/diagnosis.h"
#include "tests/fitting/diagnosis/study_report.h"
#include "tests/support/effect_cases.h"

namespace hoplab::testing {

/// One sealed case diagnosed, with what the seal said.
struct Outcome {
  Truth truth;
  std::string refusal;  // the gate's; empty if there is a diagnosis
  Verdict verdict = Verdict::kAdequate;
  double global_p = 1.0;
  /// One a found effect: names that explain it as well as each other ("air_drag", "air_drag in
  /// train-2.csv"), the accepted one first. Of verdicts that name something; else empty.
  std::vector<std::vector<std::string>> groups;
  std::string first;  // the cause that gains most; empty where nothing is named
  /// Score of each planted effect beside the accepted extension: chance of it under noise. 1 for
  /// those in the extension.
  std::vector<double> left_p;
  bool in_doubt = false;       // some misfit is or may be left beside the accepted extension
  bool claims_gain = false;    // the interval of the held-out gain lies above zero
  std::optional<double> gain;  // nats a held-out sample
  /// Distance of the leading stiffness from the truth without and with the extension, and its
  /// standard error without.
  double error_before = 0.0, error_after = 0.0, std_error = 0.0;
  double cpu_seconds = 0.0;
  /// Each cause of the extension, what was seen of it, and whether a planted effect is in its
  /// group.
  struct Seen {
    std::string name;
    bool main = false, each_trial = false;
    double probability = 0.0;        // told
    double group_probability = 0.0;  // that a name of its group is right
    double evidence = 0.0;           // of the evidence alone
    NameFeatures features;
    bool group_right = false, right = false;
  };
  std::vector<Seen> seen;
  double unlisted_probability = 0.0;
  double left_share = 0.0;
  bool at_bound = false;  // a told size lies on a physical bound

  bool Names() const { return !groups.empty(); }
  bool Holds(std::string_view name) const;  // in some group
  bool HoldsAll() const;                    // every planted effect is
  /// Names causes that stand alone, none of them planted.
  bool NamesWrongly() const;
  /// Members over all groups.
  int SetSize() const;
};

/// Writes the dataset and its seal into a folder of its own, diagnoses from the dataset folder
/// alone, then opens the seal. `without`: effects taken out of the catalogue.
Outcome RunSealed(const Truth& truth, std::vector<std::string> without = {});

/// The same for many, spread over the cores, in order. What throws fails the test, and its outcome
/// is refused.
std::vector<Outcome> RunAll(
    const std::vector<Truth>& truths,
    const std::function<std::vector<std::string>(const Truth&)>& without = nullptr);

/// Numbered draws of the suite: one stream a case.
inline constexpr std::uint64_t kSuiteSeed = 20'240;
/// Seeds of noise differ between tables.
enum class Table : std::uint64_t {
  kFalseAlarms = 1,
  kPower,
  kNaming,
  kLeftOut,
  kTwoEffects,
  kRules,
  kNoise,
  kPowerLost,
  kOwnSizes
};
std::uint64_t NoiseSeed(Table table, int number);

/// Only every n-th effect is planted: 9 with HOPLAB_STATISTICS_QUICK, else 1.
int EveryNth();

/// `seeds` cases of each effect of the catalogue at `size`, one effect after the other; law, sign
/// (direction) and noise are drawn. Effects no law allows at that size are not among them.
std::vector<Truth> PlantEach(Table table, double size, int seeds);

/// The same of effects with one parameter and no threshold, with a size in each trial of its own.
std::vector<Truth> PlantOwnSizes(double size, int seeds);

/// How an effect can be planted under a law; null: it is in no catalogue of that law.
const EffectCase* CaseOf(Law law, std::string_view name);

/// Pairs of effects that are planted together.
inline constexpr int kPairCount = 10;
std::string PairName(int pair);  // "air_drag + touchdown_angle_bias"
/// Both effects of a pair at `size` delta80 each under a drawn law; absent if no law carries both.
std::optional<Truth> PlantPair(int pair, int seed, double size);
/// `seeds` cases of each pair.
std::vector<Truth> PlantPairs(double size, int seeds);
/// The same with a third effect of `third` delta80, the last of the truth's: a detail of the real
/// leg that is small beside the pair.
std::vector<Truth> PlantTriples(double size, double third, int seeds);

}  // namespace hoplab::testing
