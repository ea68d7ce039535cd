#include "experiments/study/claim_judges.h"

#include <algorithm>
#include <cmath>

#include "base/nan.h"
#include "experiments/study/agreement.h"

namespace hoplab {
namespace {

// What the study's adjectives are taken to mean.
constexpr double kStandstill = 0.1;     // m/s: "nearly vertical"
constexpr int kSeveral = 3;             // hops
constexpr double kSettled = 0.02;       // of the mean of the last five
constexpr double kConsiderable = 0.05;  // of the desired speed: a steady error
constexpr double kReached = 0.05;       // of the desired speed
constexpr double kSignificance = 0.05;
constexpr double kVisibleRise = 1e-3;  // of the stiffness
constexpr double kPrintedStep = 0.01;  // percentage points: what a printed number can show
constexpr std::size_t kSteadyApexes = 5;

using Column = double ApexPoint::*;

double Number(bool value) { return value ? 1.0 : 0.0; }

double NextApexHeight(const HoppingRun& run) {
  return run.apexes.size() > 1 ? run.apexes[1].height_m : kNaN;
}

// The first stance's samples.
std::vector<HoppingSample> FirstStance(const HoppingRun& run) {
  const std::vector<StanceRange> stances = StancesOf(run);
  if (stances.empty()) return {};
  const auto begin = run.samples.begin();
  return {begin + static_cast<std::ptrdiff_t>(stances[0].begin),
          begin + static_cast<std::ptrdiff_t>(stances[0].end)};
}

bool FallsThenRises(const std::vector<HoppingSample>& stance) {
  const auto shorter = [](const HoppingSample& a, const HoppingSample& b) {
    return a.leg_length_m < b.leg_length_m;
  };
  const auto least = std::min_element(stance.begin(), stance.end(), shorter);
  return stance.size() > 2 && least != stance.begin() && least + 1 != stance.end() &&
         std::is_sorted(stance.begin(), least + 1,
                        [&](const auto& a, const auto& b) { return shorter(b, a); }) &&
         std::is_sorted(least, stance.end(), shorter);
}

// How much stiffer the leg is at its last sample than at its softest one after its stiffest, over
// the latter; NaN without a stance.
double RiseBeforeLiftoff(const std::vector<HoppingSample>& stance) {
  if (stance.empty()) return kNaN;
  const auto softer = [](const HoppingSample& a, const HoppingSample& b) {
    return a.stiffness_N_per_m < b.stiffness_N_per_m;
  };
  const auto stiffest = std::max_element(stance.begin(), stance.end(), softer);
  const auto softest = std::min_element(stiffest, stance.end(), softer);
  return stance.back().stiffness_N_per_m / softest->stiffness_N_per_m - 1.0;
}

bool Strictly(const std::vector<ApexPoint>& apexes, Column column, double sign) {
  for (std::size_t i = 1; i < apexes.size(); ++i) {
    if (sign * (apexes[i].*column - apexes[i - 1].*column) <= 0.0) return false;
  }
  return apexes.size() > 2;
}

double GainPerHop(const HoppingRun& run) {
  if (run.apexes.size() < 2) return kNaN;
  return (run.apexes.back().speed_m_per_s - run.apexes.front().speed_m_per_s) /
         static_cast<double>(run.apexes.size() - 1);
}

// Mean of the last five apexes; NaN for fewer.
double LastMean(const HoppingRun& run, Column column) {
  if (run.apexes.size() < kSteadyApexes + 1) return kNaN;
  double sum = 0.0;
  for (std::size_t i = run.apexes.size() - kSteadyApexes; i < run.apexes.size(); ++i)
    sum += run.apexes[i].*column;
  return sum / kSteadyApexes;
}

// Largest deviation of the last five from their mean, over the mean.
double LastSpread(const HoppingRun& run, Column column) {
  const double mean = LastMean(run, column);
  if (std::isnan(mean)) return kNaN;
  double spread = 0.0;
  for (std::size_t i = run.apexes.size() - kSteadyApexes; i < run.apexes.size(); ++i)
    spread = std::max(spread, std::abs(run.apexes[i].*column / mean - 1.0));
  return spread;
}

Trend TrendOfSecondHalf(const HoppingRun& run, Column column) {
  std::vector<double> times, values;
  for (const ApexPoint& apex : run.apexes) {
    if (apex.time_s < 0.5 * run.end_time_s) continue;
    times.push_back(apex.time_s);
    values.push_back(apex.*column);
  }
  return TrendOf(times, values);
}

double ConvergedCount(const std::vector<double>& times) {
  return static_cast<double>(
      std::count_if(times.begin(), times.end(), [](double t) { return std::isfinite(t); }));
}

bool Rises(const Trend& trend) { return trend.tau > 0.0 && trend.p_value < kSignificance; }
bool Falls(const Trend& trend) { return trend.tau < 0.0 && trend.p_value < kSignificance; }

std::vector<StudyNumber> NumbersOf(const Trend& trend) {
  return {{"tau", trend.tau, ""}, {"p_value", trend.p_value, ""}};
}

}  // namespace

std::vector<StudyCheck> JudgeSingleJumps(const SingleJumps& runs) {
  const double upright = NextApexHeight(runs.upright_undamped);
  const double upright_damped = NextApexHeight(runs.upright_damped);
  const double rolling = NextApexHeight(runs.rolling_undamped);
  const double rolling_damped = NextApexHeight(runs.rolling_damped);
  std::vector<StudyCheck> checks = {{"the next apex is lower with damping, upright and rolling",
                                     upright_damped < upright && rolling_damped < rolling,
                                     {{"upright", upright, "m"},
                                      {"upright_damped", upright_damped, "m"},
                                      {"rolling", rolling, "m"},
                                      {"rolling_damped", rolling_damped, "m"}}}};
  double unimodal = 0.0;
  for (const HoppingRun* run :
       {&runs.upright_undamped, &runs.upright_damped, &runs.rolling_undamped, &runs.rolling_damped})
    unimodal += Number(FallsThenRises(FirstStance(*run)));
  checks.push_back({"in stance the leg gets shorter, then longer, in all four jumps",
                    unimodal == 4.0,
                    {{"jumps", unimodal, ""}}});
  StudyCheck longer{"rolling, the leg is longer at lift-off than at touch-down", true, {}};
  StudyCheck softer{"rolling, the leg is softer at lift-off than at touch-down", true, {}};
  for (const HoppingRun* run : {&runs.rolling_undamped, &runs.rolling_damped}) {
    const std::vector<HoppingSample> stance = FirstStance(*run);
    if (stance.empty()) {
      longer.holds = softer.holds = false;
      continue;
    }
    const HoppingSample &first = stance.front(), &last = stance.back();
    longer.holds = longer.holds && last.leg_length_m > first.leg_length_m;
    softer.holds = softer.holds && last.stiffness_N_per_m < first.stiffness_N_per_m;
    const char* suffix = run == &runs.rolling_undamped ? "" : "_damped";
    longer.numbers.push_back({std::string("touchdown") + suffix, first.leg_length_m, "m"});
    longer.numbers.push_back({std::string("liftoff") + suffix, last.leg_length_m, "m"});
    softer.numbers.push_back({std::string("touchdown") + suffix, first.stiffness_N_per_m, "N/m"});
    softer.numbers.push_back({std::string("liftoff") + suffix, last.stiffness_N_per_m, "N/m"});
  }
  checks.push_back(longer);
  checks.push_back(softer);
  const double rise = RiseBeforeLiftoff(FirstStance(runs.upright_undamped));
  checks.push_back({"upright and at rest, the stiffness rises again before lift-off",
                    rise > kVisibleRise,
                    {{"rise", 100.0 * rise, "%"}}});
  return checks;
}

std::vector<StudyCheck> JudgeFromRest(const HoppingFromRest& runs) {
  int vertical = 0;
  for (std::size_t i = 1; i < runs.undamped.apexes.size(); ++i) {
    if (std::abs(runs.undamped.apexes[i].speed_m_per_s) >= kStandstill) break;
    ++vertical;
  }
  const auto last_speed = [](const HoppingRun& run) {
    return run.apexes.size() > 1 ? run.apexes.back().speed_m_per_s : run.final_speed_m_per_s;
  };
  const double end = last_speed(runs.undamped);
  const double below = last_speed(runs.smaller_angle), above = last_speed(runs.larger_angle);
  return {{"at least three nearly vertical hops (below 0.1 m/s) come first",
           vertical >= kSeveral,
           {{"hops", static_cast<double>(vertical), ""}}},
          {"then the speed is backward (below -0.1 m/s)",
           end < -kStandstill,
           {{"last_apex_speed", end, "m/s"}}},
          {"then it falls", runs.undamped.fell(), {{"end_time", runs.undamped.end_time_s, "s"}}},
          {"at a smaller angle it drifts forward, at a larger one backward",
           below > 0.0 && above < 0.0,
           {{"smaller_angle", below, "m/s"}, {"larger_angle", above, "m/s"}}},
          {"with damping it falls sooner",
           runs.damped.fell() && runs.damped.end_time_s < runs.undamped.end_time_s,
           {{"undamped", runs.undamped.end_time_s, "s"}, {"damped", runs.damped.end_time_s, "s"}}}};
}

std::vector<StudyCheck> JudgeForward(const HoppingRun& undamped, const HoppingRun& damped) {
  const double gain = GainPerHop(undamped), damped_gain = GainPerHop(damped);
  return {{"the speed rises every hop",
           Strictly(undamped.apexes, &ApexPoint::speed_m_per_s, 1.0),
           {{"start", undamped.apexes.front().speed_m_per_s, "m/s"},
            {"last_apex", undamped.apexes.back().speed_m_per_s, "m/s"}}},
          {"the apex falls every hop",
           Strictly(undamped.apexes, &ApexPoint::height_m, -1.0),
           {{"start", undamped.apexes.front().height_m, "m"},
            {"last_apex", undamped.apexes.back().height_m, "m"}}},
          {"with damping the speed rises more slowly",
           damped_gain < gain,
           {{"undamped", gain, "m/s a hop"}, {"damped", damped_gain, "m/s a hop"}}},
          {"with damping there are more hops",
           damped.hops > undamped.hops,
           {{"undamped", static_cast<double>(undamped.hops), ""},
            {"damped", static_cast<double>(damped.hops), ""}}}};
}

std::vector<StudyCheck> JudgeControlled(const HoppingRun& undamped, const HoppingRun& damped,
                                        double v_des_m_per_s) {
  std::vector<StudyCheck> checks;
  for (const HoppingRun* run : {&undamped, &damped}) {
    const ConvergenceTime convergence = ConvergenceOf(*run);
    const double spread = LastSpread(*run, &ApexPoint::height_m);
    checks.push_back(
        {std::string("speed and height settle, ") + (run == &undamped ? "undamped" : "damped"),
         convergence.converged() && spread <= kSettled,
         {{"convergence_time", convergence.time, "s"}, {"height_spread", 100.0 * spread, "%"}}});
  }
  const auto error = [&](const HoppingRun& run) {
    return 1.0 - LastMean(run, &ApexPoint::speed_m_per_s) / v_des_m_per_s;
  };
  const double e = error(undamped), e_damped = error(damped);
  checks.push_back({"a considerable steady error (at least 5 % of the desired speed) stays",
                    std::abs(e) >= kConsiderable && std::abs(e_damped) >= kConsiderable,
                    {{"undamped", 100.0 * e, "%"}, {"damped", 100.0 * e_damped, "%"}}});
  const double t = ConvergenceOf(undamped).time, t_damped = ConvergenceOf(damped).time;
  checks.push_back({"with damping it settles sooner",
                    t_damped < t,
                    {{"undamped", t, "s"}, {"damped", t_damped, "s"}}});
  const double h = LastMean(undamped, &ApexPoint::height_m);
  const double h_damped = LastMean(damped, &ApexPoint::height_m);
  checks.push_back({"with damping it settles lower",
                    h_damped < h,
                    {{"undamped", h, "m"}, {"damped", h_damped, "m"}}});
  return checks;
}

std::vector<StudyCheck> JudgeStraightLeg(const HoppingRun& undamped, double v_des_m_per_s) {
  const double speed = LastMean(undamped, &ApexPoint::speed_m_per_s);
  const bool complete = IsComplete(undamped.outcome);
  const Trend height = TrendOfSecondHalf(undamped, &ApexPoint::height_m);
  const Trend energy = TrendOfSecondHalf(undamped, &ApexPoint::energy_J);
  return {{"it hops to the end of the run", complete, {{"end_time", undamped.end_time_s, "s"}}},
          {"it reaches the desired speed within 5 %",
           complete && std::abs(speed / v_des_m_per_s - 1.0) <= kReached,
           {{"speed", speed, "m/s"}, {"desired", v_des_m_per_s, "m/s"}}},
          {"apex height still grows in the second half of the run (Kendall's tau, p below 0.05)",
           complete && Rises(height), NumbersOf(height)},
          {"energy still grows in the second half of the run (Kendall's tau, p below 0.05)",
           complete && Rises(energy), NumbersOf(energy)}};
}

std::vector<StudyCheck> JudgeInitialStates(const std::vector<double>& undamped,
                                           const std::vector<double>& damped) {
  const auto all = static_cast<double>(undamped.size());
  double sooner = 0.0;
  for (std::size_t i = 0; i < undamped.size(); ++i) sooner += Number(damped[i] < undamped[i]);
  const double converged = ConvergedCount(undamped), converged_damped = ConvergedCount(damped);
  return {{"every start converges, undamped",
           all > 0.0 && converged == all,
           {{"converged", converged, ""}, {"of", all, ""}}},
          {"every start converges, damped",
           all > 0.0 && converged_damped == all,
           {{"converged", converged_damped, ""}, {"of", all, ""}}},
          {"with damping every start converges sooner",
           all > 0.0 && sooner == all,
           {{"sooner", sooner, ""}, {"of", all, ""}}}};
}

std::vector<StudyCheck> JudgeModulus(const ModulusSweep& undamped, const ModulusSweep& damped) {
  const Trend free = TrendOf(undamped.modulus_GPa, undamped.time);
  const Trend held = TrendOf(damped.modulus_GPa, damped.time);
  StudyCheck grows{
      "least and greatest stiffness grow with E, undamped and damped (p below 0.05)", true, {}};
  for (const ModulusSweep* sweep : {&undamped, &damped}) {
    for (const auto* stiffness : {&sweep->stiffness_min, &sweep->stiffness_max}) {
      const Trend trend = TrendOf(sweep->modulus_GPa, *stiffness);
      grows.holds = grows.holds && Rises(trend);
      grows.numbers.push_back({std::string(sweep == &undamped ? "undamped" : "damped") +
                                   (stiffness == &sweep->stiffness_min ? "_min_tau" : "_max_tau"),
                               trend.tau, ""});
    }
  }
  return {{"undamped, convergence time shows no trend with E (p at least 0.05)",
           free.p_value >= kSignificance, NumbersOf(free)},
          {"damped, convergence time falls with E (p below 0.05)", Falls(held), NumbersOf(held)},
          grows};
}

std::vector<StudyCheck> JudgeEnergyGain(const std::vector<double>& percent) {
  const bool gains =
      std::all_of(percent.begin(), percent.end(), [](double p) { return p > 100.0; });
  bool shrinks = percent.size() > 1;
  for (std::size_t i = 1; i < percent.size(); ++i)
    shrinks = shrinks && percent[i] < percent[i - 1] - kPrintedStep;
  const std::vector<StudyNumber> ends = {
      {"smallest_angle", percent.empty() ? kNaN : percent.front(), "%"},
      {"largest_angle", percent.empty() ? kNaN : percent.back(), "%"}};
  return {{"without damping every jump gains energy", !percent.empty() && gains, ends},
          {"the gain shrinks with the touch-down angle, step by step", shrinks, ends}};
}

}  // namespace hoplab
