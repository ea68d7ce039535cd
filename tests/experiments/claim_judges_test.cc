// Every claim judged on made-up runs: one that shows all of it, and for each check one that does
// not.
#include "experiments/study/claim_judges.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/nan.h"

namespace hoplab::testing {
namespace {

std::vector<bool> Holds(const std::vector<StudyCheck>& checks) {
  std::vector<bool> holds;
  for (const StudyCheck& check : checks) holds.push_back(check.holds);
  return holds;
}

// All true but at `place`.
std::vector<bool> AllBut(std::size_t count, std::size_t place) {
  std::vector<bool> holds(count, true);
  holds.at(place) = false;
  return holds;
}

// A jump whose stance has these lengths and stiffnesses, a millisecond apart.
HoppingRun Jump(double next_apex, const std::vector<double>& lengths,
                const std::vector<double>& stiffness) {
  HoppingRun run;
  run.outcome = Outcome::kHopLimit;
  run.hops = 1;
  run.apexes = {{0.0, 0.0, 0.3, 0.0, 1.0}, {0.5, 0.0, next_apex, 0.0, 1.0}};
  const auto add = [&](double length, double k, bool contact) {
    run.samples.push_back({1e-3 * static_cast<double>(run.samples.size()), 0.0, 0.2, 0.0, 1.0, 0.0,
                           length, k, contact});
  };
  add(lengths.front(), kNaN, false);
  for (std::size_t i = 0; i < lengths.size(); ++i) add(lengths[i], stiffness[i], true);
  add(lengths.back(), kNaN, false);
  return run;
}

SingleJumps GoodJumps() {
  const std::vector<double> there_and_back = {0.18, 0.16, 0.14, 0.16, 0.18};
  const std::vector<double> rolling = {0.17, 0.15, 0.16, 0.175};
  const std::vector<double> softer = {5000, 6000, 5500, 4000};
  return {Jump(0.30, there_and_back, {4000, 6000, 5000, 4500, 4700}),
          Jump(0.27, there_and_back, {4000, 6000, 5000, 4500, 4700}), Jump(0.31, rolling, softer),
          Jump(0.28, rolling, softer)};
}

TEST(ClaimJudges, SingleJumps) {
  EXPECT_EQ(Holds(JudgeSingleJumps(GoodJumps())), std::vector<bool>(5, true));
  SingleJumps jumps = GoodJumps();
  jumps.rolling_damped.apexes[1].height_m = 0.32;
  EXPECT_EQ(Holds(JudgeSingleJumps(jumps)), AllBut(5, 0));
  jumps = GoodJumps();
  jumps.upright_damped.samples[3].leg_length_m = 0.165;  // longer, then shorter, then longer
  EXPECT_EQ(Holds(JudgeSingleJumps(jumps)), AllBut(5, 1));
  jumps = GoodJumps();
  jumps.rolling_undamped = Jump(0.31, {0.17, 0.15, 0.16, 0.169}, {5000, 6000, 5500, 4000});
  EXPECT_EQ(Holds(JudgeSingleJumps(jumps)), AllBut(5, 2));
  jumps = GoodJumps();
  jumps.rolling_damped = Jump(0.28, {0.17, 0.15, 0.16, 0.175}, {5000, 6000, 5500, 5100});
  EXPECT_EQ(Holds(JudgeSingleJumps(jumps)), AllBut(5, 3));
  jumps = GoodJumps();
  jumps.upright_undamped =
      Jump(0.30, {0.18, 0.16, 0.14, 0.16, 0.18}, {4000, 5000, 6000, 5000, 4000});
  EXPECT_EQ(Holds(JudgeSingleJumps(jumps)), AllBut(5, 4));
}

TEST(ClaimJudges, JumpsThatNeverStandShowNothing) {
  const std::vector<bool> holds = Holds(JudgeSingleJumps({}));
  EXPECT_EQ(holds, std::vector<bool>(5, false));
}

// Apexes half a second apart; the run ends half a second after the last.
HoppingRun Hops(const std::vector<double>& speeds, const std::vector<double>& heights,
                Outcome outcome) {
  HoppingRun run;
  run.outcome = outcome;
  for (std::size_t i = 0; i < speeds.size(); ++i)
    run.apexes.push_back({0.5 * static_cast<double>(i), 0.0, heights[i], speeds[i],
                          0.5 * speeds[i] * speeds[i] + 9.81 * heights[i]});
  run.end_time_s = 0.5 * static_cast<double>(speeds.size());
  run.hops = static_cast<int>(speeds.size()) - 1;
  run.final_speed_m_per_s = speeds.back();
  for (std::size_t i = 1; i < run.apexes.size(); ++i)
    run.speeds.flight.push_back({run.apexes[i].time_s, run.apexes[i].speed_m_per_s});
  run.speeds.apex = run.speeds.flight;
  return run;
}
HoppingRun Hops(const std::vector<double>& speeds, Outcome outcome) {
  return Hops(speeds, std::vector<double>(speeds.size(), 0.3), outcome);
}

constexpr Outcome kFell = Outcome::kFellNoReturn;

HoppingFromRest GoodFromRest() {
  return {Hops({0, 0.01, -0.02, -0.05, -0.4, -1.0}, kFell), Hops({0, -0.05, -0.6}, kFell),
          Hops({0, 0.2, 0.6}, kFell), Hops({0, -0.3, -0.8}, kFell)};
}

TEST(ClaimJudges, HoppingFromRest) {
  EXPECT_EQ(Holds(JudgeFromRest(GoodFromRest())), std::vector<bool>(5, true));
  HoppingFromRest runs = GoodFromRest();
  runs.undamped = Hops({0, 0.01, -0.2, -0.05, -0.4, -1.0}, kFell);
  EXPECT_EQ(Holds(JudgeFromRest(runs)), AllBut(5, 0));
  runs.undamped = Hops({0, 0.01, 0.02, 0.05, 0.4, 1.0}, kFell);
  EXPECT_EQ(Holds(JudgeFromRest(runs)), AllBut(5, 1));
  runs = GoodFromRest();
  runs.undamped.outcome = Outcome::kCompleted;
  EXPECT_EQ(Holds(JudgeFromRest(runs)), AllBut(5, 2));
  runs = GoodFromRest();
  runs.smaller_angle = Hops({0, -0.1}, kFell);
  EXPECT_EQ(Holds(JudgeFromRest(runs)), AllBut(5, 3));
  runs = GoodFromRest();
  runs.damped.end_time_s = 10.0;
  EXPECT_EQ(Holds(JudgeFromRest(runs)), AllBut(5, 4));
}

TEST(ClaimJudges, HoppingForward) {
  const HoppingRun good = Hops({1.0, 1.3, 1.7}, {0.3, 0.27, 0.2}, kFell);
  const HoppingRun damped = Hops({1.0, 1.1, 1.2, 1.3, 1.4}, {0.3, 0.28, 0.26, 0.24, 0.2}, kFell);
  EXPECT_EQ(Holds(JudgeForward(good, damped)), std::vector<bool>(4, true));
  EXPECT_EQ(Holds(JudgeForward(Hops({1.0, 1.8, 1.7}, {0.3, 0.27, 0.2}, kFell), damped)),
            AllBut(4, 0));
  EXPECT_EQ(Holds(JudgeForward(Hops({1.0, 1.3, 1.7}, {0.3, 0.31, 0.2}, kFell), damped)),
            AllBut(4, 1));
  EXPECT_EQ(Holds(JudgeForward(good, Hops({1.0, 1.5, 2.0, 2.5, 3.0}, kFell))), AllBut(4, 2));
  EXPECT_EQ(Holds(JudgeForward(good, Hops({1.0, 1.1, 1.2}, kFell))), AllBut(4, 3));
}

// Speeds that settle at `steady` after `transient` apexes, ten apexes more.
HoppingRun Settling(double steady, int transient, double height) {
  std::vector<double> speeds;
  for (int i = 0; i < transient; ++i) speeds.push_back(steady - 0.5);
  speeds.insert(speeds.end(), 10, steady);
  return Hops(speeds, std::vector<double>(speeds.size(), height), Outcome::kCompleted);
}

TEST(ClaimJudges, ControlledHopping) {
  const HoppingRun undamped = Settling(1.4, 9, 0.30), damped = Settling(1.5, 3, 0.25);
  const auto judge = [](const HoppingRun& a, const HoppingRun& b) {
    return Holds(JudgeControlled(a, b, 1.8));
  };
  EXPECT_EQ(judge(undamped, damped), std::vector<bool>(5, true));
  HoppingRun unsteady = undamped;
  unsteady.apexes.back().height_m = 0.4;
  EXPECT_EQ(judge(unsteady, damped), AllBut(5, 0));
  HoppingRun unsteady_damped = damped;
  unsteady_damped.apexes.back().height_m = 0.2;
  EXPECT_EQ(judge(undamped, unsteady_damped), AllBut(5, 1));
  EXPECT_EQ(judge(undamped, Settling(1.79, 3, 0.25)), AllBut(5, 2));
  EXPECT_EQ(judge(undamped, Settling(1.5, 12, 0.25)), AllBut(5, 3));
  EXPECT_EQ(judge(undamped, Settling(1.5, 3, 0.35)), AllBut(5, 4));
  HoppingRun fallen = undamped;
  fallen.outcome = kFell;
  EXPECT_FALSE(judge(fallen, damped)[0]) << "a run that falls has not settled";
}

TEST(ClaimJudges, StraightLeg) {
  std::vector<double> speeds(20, 1.8), rising;
  for (int i = 0; i < 20; ++i) rising.push_back(0.3 + 0.01 * i);
  const HoppingRun good = Hops(speeds, rising, Outcome::kCompleted);
  EXPECT_EQ(Holds(JudgeStraightLeg(good, 1.8)), std::vector<bool>(4, true));
  EXPECT_EQ(Holds(JudgeStraightLeg(Hops(speeds, rising, kFell), 1.8)), std::vector<bool>(4, false));
  EXPECT_EQ(Holds(JudgeStraightLeg(good, 2.4)), AllBut(4, 1));
  const std::vector<bool> level =
      Holds(JudgeStraightLeg(Hops(speeds, std::vector<double>(20, 0.3), Outcome::kCompleted), 1.8));
  EXPECT_EQ(level, (std::vector<bool>{true, true, false, false}));
  // Grows first and has stopped by half time.
  std::vector<double> saturating(20, 0.4);
  for (int i = 0; i < 9; ++i) saturating[i] = 0.3 + 0.01 * i;
  EXPECT_FALSE(Holds(JudgeStraightLeg(Hops(speeds, saturating, Outcome::kCompleted), 1.8))[2]);
}

TEST(ClaimJudges, InitialStates) {
  EXPECT_EQ(Holds(JudgeInitialStates({9, 8, 7}, {2, 3, 1})), std::vector<bool>(3, true));
  EXPECT_EQ(Holds(JudgeInitialStates({9, kNaN, 7}, {2, 3, 1})),
            (std::vector<bool>{false, true, false}));
  EXPECT_EQ(Holds(JudgeInitialStates({9, 8, 7}, {2, kNaN, 1})),
            (std::vector<bool>{true, false, false}));
  EXPECT_EQ(Holds(JudgeInitialStates({9, 8, 7}, {2, 8.5, 1})), AllBut(3, 2));
  EXPECT_EQ(Holds(JudgeInitialStates({}, {})), std::vector<bool>(3, false));
}

ModulusSweep Sweep(const std::vector<double>& times) {
  ModulusSweep sweep;
  sweep.time = times;
  for (std::size_t i = 0; i < times.size(); ++i) {
    sweep.modulus_GPa.push_back(21.0 + 0.1 * static_cast<double>(i));
    sweep.stiffness_min.push_back(3400.0 + 20.0 * static_cast<double>(i));
    sweep.stiffness_max.push_back(6300.0 + 40.0 * static_cast<double>(i));
  }
  return sweep;
}

TEST(ClaimJudges, Modulus) {
  const ModulusSweep scattered = Sweep({10, 6, 9, 12, 7, 11, 8, 10});
  const ModulusSweep falling = Sweep({1.4, 1.4, 1.4, 1.3, 1.2, 1.0, 1.0, 1.0});
  EXPECT_EQ(Holds(JudgeModulus(scattered, falling)), std::vector<bool>(3, true));
  EXPECT_EQ(Holds(JudgeModulus(falling, falling)), AllBut(3, 0));
  EXPECT_EQ(Holds(JudgeModulus(scattered, scattered)), AllBut(3, 1));
  ModulusSweep softening = falling;
  std::reverse(softening.stiffness_max.begin(), softening.stiffness_max.end());
  EXPECT_EQ(Holds(JudgeModulus(scattered, softening)), AllBut(3, 2));
  const ModulusSweep none = Sweep(std::vector<double>(8, kNaN));
  EXPECT_EQ(Holds(JudgeModulus(none, none)), (std::vector<bool>{false, false, true}))
      << "no convergence at all is no absence of a trend";
}

TEST(ClaimJudges, EnergyGain) {
  EXPECT_EQ(Holds(JudgeEnergyGain({103, 102.5, 102})), std::vector<bool>(2, true));
  EXPECT_EQ(Holds(JudgeEnergyGain({103, 101, 99.9})), AllBut(2, 0));
  EXPECT_EQ(Holds(JudgeEnergyGain({103, 103.1, 102})), AllBut(2, 1));
  EXPECT_EQ(Holds(JudgeEnergyGain({103, 103 - 1e-6, 102})), AllBut(2, 1))
      << "rounding is no gain that shrinks";
  EXPECT_EQ(Holds(JudgeEnergyGain({103, kNaN, 102})), std::vector<bool>(2, false));
  EXPECT_EQ(Holds(JudgeEnergyGain({})), std::vector<bool>(2, false));
}

TEST(StudyVerdict, NeedsEveryCheckOrOneSettingThatHoldsThemAll) {
  const std::vector<StudyCheck> checks = {{"a", true, {}}, {"b", false, {}}};
  EXPECT_EQ(VerdictOf({{"a", true, {}}}, {}), StudyVerdict::kReproduced);
  EXPECT_EQ(VerdictOf(checks, {}), StudyVerdict::kNotReproduced);
  EXPECT_EQ(VerdictOf(checks, {{"law x", {false, true}}, {"law y", {true, false}}}),
            StudyVerdict::kNotReproduced)
      << "two settings that hold one half each do not make a whole";
  EXPECT_EQ(VerdictOf(checks, {{"law x", {true, true}}}), StudyVerdict::kOnlyUnderSettings);
}

TEST(ComparedNumber, AgreesWithinItsToleranceAndWhereBothAreMissing) {
  ComparedNumber number{{}, "time", "s", 10.0, 10.4, 0.5};
  EXPECT_TRUE(number.agrees());
  number.ours = 9.4;
  EXPECT_FALSE(number.agrees());
  number.ours = kNaN;
  EXPECT_FALSE(number.agrees());
  number.published = kNaN;
  EXPECT_TRUE(number.agrees());
}

}  // namespace
}  // namespace hoplab::testing
