// Generated robots with one thing wrong: how often it is named, with which leg. Writes its table to
// HOPLAB_STATISTICS_DIR. ctest -L statistics

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <thread>

#include "base/parallel.h"
#include "fitting/diagnosis/verdict.h"
#include "fitting/generate.h"
#include "tests/fitting/diagnosis/study.h"
#include "tests/support/robot_drops.h"

namespace hoplab::testing {
namespace {

// What is wrong with a robot. A `%` in the name stands for the leg, 1 and 2 in turn.
struct Fault {
  const char* text;
  std::string effect, parameter;
  double size;  // own unit
};
const Fault kFaults[] = {
    {"one leg 20 % softer", "leg_stiffness_%", "loss", 0.2},
    {"centre of mass 8 mm ahead", "com_offset", "dx", 0.008},
    {"one motor at 0.9", "motor_gain_%", "gamma", -0.1},
    {"ground 1.5 deg uphill", "ground_slope", "slope", 1.5 * std::numbers::pi / 180.0},
    {"damping of one leg doubled", "leg_damping_%", "tau", 4e-4},
    {"pitch inertia +15 %", "pitch_inertia_scale", "gamma", 0.15},
    {"floor of friction 0.4, not 1", "foot_coulomb_friction", "inverse_mu", 1.5},
    {"dry friction of 0.3 N m in one hip", "hip_coulomb_friction_%", "tau_c", 0.3},
    {"viscous friction of 0.1 N m s in one hip", "hip_viscous_friction_%", "b_h", 0.1},
    {"motors 5 ms behind", "motor_lag", "t_lag", 0.005},
    {"play of 20 mrad in one gear", "backlash_%", "play", 0.02},
    {"feet that creep by 0.5 mm/s a newton", "foot_slip", "c_slip", 5e-4},
    {"a leg 20 mrad askew on its motor", "leg_zero_offset_%", "offset", 0.02},
    {"pitch read 10 mrad askew", "sensor_offset_pitch", "offset", 0.01},
    {"ground that sinks 30 um a newton", "ground_compliance", "c_g", 3e-5},
    {"0.3 N m more on one motor", "torque_bias_%", "tau_0", 0.3},
    {"a marker 8 mm above where it was said to be", "marker_offset", "dy", 0.008},
    {"the body's pose 4 ms late", "pose_delay", "tau", 0.004},
    {"pitch read 3 % too large", "sensor_scale_pitch", "gain", 0.03},
    {"hips 3 % further apart", "hip_spacing", "gain", 0.03},
    {"rotors half as heavy again", "rotor_inertia_scale", "gamma", 0.5},
    {"motors a fifth less stiff", "motor_kp_scale", "gamma", -0.2},
    {"motors damped by three tenths less", "motor_kd_scale", "gamma", -0.3},
    {"motors that give 6 N m at most, not 15", "torque_limit_loss", "loss", 0.6},
    {"hubs that hold 3 mm more of the legs", "hub_clamp", "length", 0.003},
    {"x read 3 % too large", "sensor_scale_x", "gain", 0.03},
    {"y read 1 % too large", "sensor_scale_y", "gain", 0.01},
    {"a clock 0.5 % fast", "clock_scale", "gamma_t", 0.005},
    {"a camera that hangs 20 mrad askew", "camera_roll", "roll", 0.02},
};

std::string NameFor(const Fault& fault, int seed) {
  std::string name = fault.effect;
  if (const auto at = name.find('%'); at != std::string::npos)
    name.replace(at, 1, std::to_string(1 + seed % 2));
  return name;
}

// `share` of each fault's size; of 0 a sound robot.
Dataset RobotWith(const std::vector<const Fault*>& faults, int seed, double share = 1.0) {
  Scenario scenario = RobotDrops();
  for (const Fault* fault : faults) {
    EffectSpec spec{NameFor(*fault, seed), {}, {"a planted effect"}};
    spec.parameters.push_back({fault->parameter, share * fault->size, {"a planted effect"}});
    if (share > 0.0) scenario.effects.push_back(spec);
  }
  GenerateOptions options;
  options.seed = NoiseSeed(Table::kNaming, 1000 + seed);
  return GenerateDataset(scenario, options).dataset;
}

// What a diagnosis said.
struct Answer {
  bool named = false;       // the fault itself, on its leg, with P >= kSure
  bool held = false;        // it is in a group, whatever its probability
  bool wrong_leg = false;   // the same fault of another leg is a main cause with P >= kSure
  bool wrong_name = false;  // any other main cause with P >= kSure
  std::string said;         // by a wrong answer
};

Answer AnswerOf(const Diagnosis& d, const Fault& fault, int seed) {
  Answer answer;
  const std::string right = NameFor(fault, seed), other = NameFor(fault, seed + 1);
  answer.said = d.refusal.empty() ? std::string(NameOf(d.verdict)) : d.refusal;
  for (const std::vector<int>& group : d.naming.groups) {
    for (const int i : group)
      answer.held =
          answer.held || d.naming.candidates[static_cast<std::size_t>(i)].candidate.Name() == right;
  }
  if (!d.extension) return answer;
  for (const CauseReport& c : d.extension->causes) {
    const bool sure = c.probability >= kSure && d.verdict == Verdict::kNamed;
    answer.said += ", " + c.cause.Name() + Cell(" %.3f", c.probability);
    answer.named = answer.named || (sure && c.cause.Name() == right);
    if (!sure || !c.main || c.cause.Name() == right) continue;
    (c.cause.Name() == other ? answer.wrong_leg : answer.wrong_name) = true;
  }
  return answer;
}

// Quickly: the first six and every third of the others.
std::vector<Fault> FaultsTried() {
  std::vector<Fault> tried;
  for (std::size_t i = 0; i < std::size(kFaults); ++i)
    if (!IsQuick() || i < 6 || i % 3 == 0) tried.push_back(kFaults[i]);
  return tried;
}

TEST(RobotStatistics, NamesWhatIsWrongAndWhichLeg) {
  const int seeds = SeedCount(20);
  const std::vector<Fault> tried = FaultsTried();
  const int faults = static_cast<int>(tried.size());
  std::vector<Answer> answers(static_cast<std::size_t>(faults * seeds));
  const int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  ParallelFor(faults * seeds, jobs, [&](int i) {
    // The first seed of every fault comes first.
    const int fault = i % faults, seed = i / faults;
    const Fault& planted = tried[static_cast<std::size_t>(fault)];
    DiagnosisOptions options;
    options.fit.jobs = 1;
    answers[static_cast<std::size_t>(fault * seeds + seed)] =
        AnswerOf(Diagnose(RobotWith({&planted}, seed), options), planted, seed);
  });

  Report report("9-robot", "Robots: what is wrong, and which leg");
  report.Say(
      "A robot of 3 kg on two legs, held and dropped three times, one drop held out; %d "
      "seeds a fault, all causes tried. Legs 1 and 2 in turn.",
      seeds);
  report.Head(
      {"what was changed", "named, P >= 0.95", "in the set", "the other leg", "wrong name"});
  long named = 0, wrong_leg = 0, wrong_name = 0;
  for (int f = 0; f < faults; ++f) {
    const char* text = tried[static_cast<std::size_t>(f)].text;
    const auto first = answers.begin() + f * seeds, last = first + seeds;
    const auto count = [&](bool Answer::*what) {
      return std::count_if(first, last, [&](const Answer& a) { return a.*what; });
    };
    report.Row({text, Cell("%ld of %d", count(&Answer::named), seeds),
                Cell("%ld", count(&Answer::held)), Cell("%ld", count(&Answer::wrong_leg)),
                Cell("%ld", count(&Answer::wrong_name))});
    EXPECT_TRUE(IsAtLeast(count(&Answer::named), seeds, 0.9)) << text;
    for (auto a = first; a != last; ++a)
      if (!a->named || a->wrong_leg || a->wrong_name)
        std::printf("%s, seed %ld: %s\n", text, static_cast<long>(a - first), a->said.c_str());
    named += count(&Answer::named);
    wrong_leg += count(&Answer::wrong_leg);
    wrong_name += count(&Answer::wrong_name);
  }
  const long all = static_cast<long>(faults) * seeds;
  report.Say(
      "Named with P >= 0.95 and on its leg in %.0f %% (bound 90 %% of each), the other leg "
      "in %.1f %% (bound 2 %%), another name in %.1f %%.",
      PerCent(named, all), PerCent(wrong_leg, all), PerCent(wrong_name, all));
  EXPECT_TRUE(IsAtMost(wrong_leg, all, 0.02));
}

// What was said of a robot with two things wrong, of the same leg where both are of one.
struct PairAnswer {
  std::string planted, said;
  int named = 0;  // of the two
  long main = 0;  // main causes with P >= kSure
  long planted_among_main = 0;
};

PairAnswer PairAnswerOf(int drawn) {
  std::mt19937 random(static_cast<unsigned>(drawn));
  std::uniform_int_distribution<std::size_t> any(0, std::size(kFaults) - 1);
  const Fault& first = kFaults[any(random)];
  const Fault* second = &first;
  while (second == &first) second = &kFaults[any(random)];
  PairAnswer answer;
  const std::string names[] = {NameFor(first, drawn), NameFor(*second, drawn)};
  answer.planted = names[0] + " and " + names[1];
  DiagnosisOptions options;
  options.fit.jobs = 1;
  const Diagnosis d = Diagnose(RobotWith({&first, second}, drawn), options);
  answer.said = d.refusal.empty() ? std::string(NameOf(d.verdict)) : d.refusal;
  if (!d.extension) return answer;
  for (const CauseReport& c : d.extension->causes) {
    const bool right = c.cause.Name() == names[0] || c.cause.Name() == names[1];
    answer.said += (c.main ? ", " : ", small ") + c.cause.Name() + Cell(" %.3f", c.probability);
    answer.named += right && c.probability >= kSure;
    if (!c.main || c.probability < kSure) continue;
    ++answer.main;
    answer.planted_among_main += right;
  }
  return answer;
}

TEST(RobotStatistics, NamesTwoThingsThatAreWrong) {
  const int cases = SeedCount(40);
  std::vector<PairAnswer> answers(static_cast<std::size_t>(cases));
  const int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  ParallelFor(cases, jobs, [&](int i) { answers[static_cast<std::size_t>(i)] = PairAnswerOf(i); });
  long named = 0, both = 0, main = 0, planted = 0;
  for (const PairAnswer& a : answers) {
    named += a.named;
    both += a.named == 2;
    main += a.main;
    planted += a.planted_among_main;
    std::printf("%s: %s\n", a.planted.c_str(), a.said.c_str());
  }
  Report report("9-robot-pairs", "Robots with two things wrong");
  report.Say(
      "The same robot with two of these faults, drawn at random, %d times: %ld of %d named with "
      "P >= 0.95, both in %ld; of %ld main causes with P >= 0.95 %ld are planted.",
      cases, named, 2 * cases, both, main, planted);
  EXPECT_TRUE(IsAtLeast(named, 2L * cases, 0.9));
  EXPECT_TRUE(IsAtLeast(planted, main, 0.95));
}

// What was said of a small fault, or of none.
struct SmallAnswer {
  double over_noise = 0.0;
  bool seen = false;
  std::vector<std::pair<double, bool>> told;  // P of a name, and whether it is right
  std::string said;
};

SmallAnswer SmallAnswerOf(const Fault& fault, int seed, double share) {
  DiagnosisOptions options;
  options.fit.jobs = 1;
  const Diagnosis d = Diagnose(RobotWith({&fault}, seed, share), options);
  SmallAnswer answer;
  answer.seen = d.refusal.empty() && d.detection.p_value <= kDetectionLevel;
  answer.over_noise = MisfitOverNoise(d.detection);
  answer.said = d.refusal.empty() ? std::string(NameOf(d.verdict)) : d.refusal;
  if (!d.extension) return answer;
  for (const CauseReport* c : d.extension->ToldCauses()) {
    const bool right = share > 0.0 && c->cause.Name() == NameFor(fault, seed);
    answer.told.emplace_back(c->probability, right);
    answer.said += ", " + c->cause.Name() + Cell(" %.3f", c->probability);
  }
  return answer;
}

// Of a robot a name in doubt is as often right as it says, and a sound robot has none.
TEST(RobotStatistics, SmallFaultsAndHowSureTheirNamesAre) {
  constexpr double kShares[] = {0.0, 0.1, 0.05, 0.02};
  constexpr double kSteps[] = {0.0, 0.2, 0.5, 0.8, 0.95, 1.01};
  constexpr int kBins = static_cast<int>(std::size(kSteps)) - 1;
  const int seeds = SeedCount(4);
  const int faults = IsQuick() ? 3 : static_cast<int>(std::size(kFaults));
  const int shares = IsQuick() ? 2 : static_cast<int>(std::size(kShares));
  const int cases = faults * seeds;
  std::vector<SmallAnswer> answers(static_cast<std::size_t>(shares * cases));
  const int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  ParallelFor(shares * cases, jobs, [&](int i) {
    const int share = i % shares, fault = i / shares % faults, seed = i / shares / faults;
    // Sound robots differ by their noise alone: a seed for each.
    const int drawn = share == 0 ? 100 + seed * faults + fault : seed;
    answers[static_cast<std::size_t>(share * cases + seed * faults + fault)] =
        SmallAnswerOf(kFaults[fault], drawn, kShares[share]);
  });

  Report report("9-robot-small", "Robots with small faults");
  report.Say("The same robot, %d seeds a fault, sizes that are so much smaller.", seeds);
  report.Head({"share of the size", "cases", "misfit over noise, median", "seen", "right name told",
               "wrong name told", "a wrong one with P >= 0.5"});
  struct Bin {
    long told = 0, right = 0;
    double sum = 0.0;
  } bins[kBins];
  for (int s = 0; s < shares; ++s) {
    std::vector<double> over;
    long seen = 0, right = 0, wrong = 0, likely = 0;
    for (int i = 0; i < cases; ++i) {
      const SmallAnswer& a = answers[static_cast<std::size_t>(s * cases + i)];
      over.push_back(a.over_noise);
      seen += a.seen;
      for (const auto& [P, is_right] : a.told) {
        (is_right ? right : wrong) += 1;
        likely += !is_right && P >= kLikely;
        int bin = 0;
        while (P >= kSteps[bin + 1]) ++bin;
        ++bins[bin].told;
        bins[bin].right += is_right;
        bins[bin].sum += P;
      }
      std::printf("%.2f %s %.2f: %s\n", kShares[s], kFaults[i % faults].effect.c_str(),
                  a.over_noise, a.said.c_str());
    }
    std::sort(over.begin(), over.end());
    report.Row({Cell("%g", kShares[s]), Cell("%d", cases), Cell("%.2f", over[over.size() / 2]),
                Cell("%ld", seen), Cell("%ld", right), Cell("%ld", wrong), Cell("%ld", likely)});
    if (kShares[s] == 0.0) {
      EXPECT_TRUE(IsAtMost(right + wrong, cases, 0.05)) << "false alarms";
    }
  }
  report.Say("How often a told name is right:");
  report.Head({"P of a told name", "told", "right", "mean P"});
  for (int b = 0; b < kBins; ++b)
    report.Row({Cell("%g ..", kSteps[b]), Cell("%ld", bins[b].told), Cell("%ld", bins[b].right),
                Cell("%.2f", bins[b].told ? bins[b].sum / bins[b].told : 0.0)});
  for (int b = 2; b < kBins; ++b)  // the likely ones
    EXPECT_TRUE(IsAtLeast(bins[b].right, bins[b].told, kSteps[b])) << "P from " << kSteps[b];
}

}  // namespace
}  // namespace hoplab::testing
