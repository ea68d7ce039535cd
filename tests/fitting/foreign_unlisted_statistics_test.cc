// Rigs and robots of a physics engine with something that no list of causes holds: what diagnose
// names instead. HOPLAB_UNLISTED: how many of them, HOPLAB_UNLISTED_FROM: from which one on;
// HOPLAB_UNLISTED_FOLDER keeps their traces. ctest -L statistics -R ForeignUnlisted

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "datasets/read_dataset.h"
#include "fitting/diagnosis/diagnosis.h"
#include "tests/support/beam_rig.h"
#include "tests/support/beam_robot.h"
#include "tests/support/robot_requests.h"
#include "tests/support/temp_folder.h"

namespace hoplab::testing {
namespace {

// `share` of its size; `akin`: causes of the catalogue that are a part of it.
struct Unlisted {
  const char* text;
  BeamExtras (*of)(double share);
  std::vector<std::string> akin = {};
};

BeamExtras Pushing(std::function<void(bool, const mjModel&, mjData&)> push) {
  BeamExtras extras;
  extras.push = std::move(push);
  return extras;
}
BeamExtras Seen(std::function<void(double, double&, double&, double&)> seen) {
  BeamExtras extras;
  extras.seen = std::move(seen);
  return extras;
}

BeamExtras Tether(double stiffness, double from) {
  return Pushing([=](bool, const mjModel&, mjData& data) {
    data.qfrc_applied[kX] -= stiffness * std::max(0.0, data.qpos[kX] - from);
  });
}
BeamExtras DryHinges(double friction) {
  BeamExtras extras;
  extras.joint_friction = friction;
  return extras;
}
// Of 8 Hz, damped by a tenth.
BeamExtras LoadOf(double mass) {
  const double omega = 2.0 * std::numbers::pi * 8.0;
  BeamExtras extras;
  extras.load = mass;
  extras.load_stiffness = mass * omega * omega;
  extras.load_damping = 0.2 * mass * omega;
  return extras;
}
BeamExtras Imbalance(double force) {
  return Pushing([=](bool, const mjModel&, mjData& data) {
    data.qfrc_applied[kY] += force * std::sin(2.0 * std::numbers::pi * 9.0 * data.time);
  });
}
BeamExtras Sticky(double force) {
  return Pushing(
      [=](bool, const mjModel& model, mjData& data) { StickToFloor(force, model, data); });
}
BeamExtras Lens(double share) {
  return Seen([=](double, double& x, double& y, double&) {
    const double from = x - 0.5, up = y - 0.25, far = from * from + up * up;
    x += share * far * from;
    y += share * far * up;
  });
}
BeamExtras ShakenCamera(double amplitude) {
  return Seen([=](double t, double&, double& y, double&) {
    y += amplitude * std::sin(2.0 * std::numbers::pi * 12.0 * t);
  });
}

const std::vector<Unlisted> kOfRigs = {
    {"a cable that pulls back", [](double s) { return Tether(8.0 * s, 0.4); }},
    {"head wind",
     [](double s) {
       return Pushing([=](bool, const mjModel&, mjData& data) {
         const double vx = data.qvel[kX] + 2.0, vy = data.qvel[kY];
         const double drag = 0.05 * s * std::hypot(vx, vy);
         data.qfrc_applied[kX] -= drag * vx;
         data.qfrc_applied[kY] -= drag * vy;
       });
     },
     {"air_drag", "constant_force"}},
    {"dry friction in the leg", [](double s) { return DryHinges(0.02 * s); }, {"leg_hysteresis"}},
    {"a load on a spring", [](double s) { return LoadOf(0.1 * s); }},
    {"an imbalance that turns", [](double s) { return Imbalance(2.0 * s); }},
    {"thrust while the leg lengthens",
     [](double s) {
       return Pushing([=](bool stands, const mjModel&, mjData& data) {
         if (stands && data.qvel[kY] > 0.0) data.qfrc_applied[kY] += 2.0 * s;
       });
     }},
    {"a spring at the hip in stance",
     [](double s) {
       return Pushing([=](bool stands, const mjModel&, mjData& data) {
         if (stands) data.qfrc_applied[kThird] -= 0.2 * s * data.qpos[kThird];
       });
     }},
    {"a sole that sticks", [](double s) { return Sticky(3.0 * s); }},
    {"a lens that bends the picture", [](double s) { return Lens(0.02 * s); }},
    {"a camera that shakes", [](double s) { return ShakenCamera(0.002 * s); }},
};

const std::vector<Unlisted> kOfRobots = {
    {"a cable that pulls back", [](double s) { return Tether(100.0 * s, 0.01); }},
    {"a pitch that a cable damps",
     [](double s) {
       return Pushing([=](bool, const mjModel&, mjData& data) {
         data.qfrc_applied[kThird] -= 0.1 * s * data.qvel[kThird];
       });
     }},
    {"dry friction in the legs", [](double s) { return DryHinges(0.03 * s); }},
    {"a load on a spring", [](double s) { return LoadOf(0.3 * s); }},
    {"an imbalance that turns", [](double s) { return Imbalance(6.0 * s); }},
    {"soles that stick", [](double s) { return Sticky(8.0 * s); }},
    {"a lens that bends the picture", [](double s) { return Lens(0.2 * s); }},
    {"a camera that shakes", [](double s) { return ShakenCamera(0.002 * s); }},
    {"a pitch that drifts",
     [](double s) {
       return Seen([=](double t, double&, double&, double& pitch) { pitch += 0.05 * s * t; });
     }},
};

constexpr double kShares[] = {1.0, 0.4};

int FromEnvironment(const char* name, int value) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : value;
}

struct UnlistedCount {
  int cases = 0, seen = 0, said = 0, unexplained = 0, sure = 0, sure_wrong = 0,
      cases_sure_wrong = 0, told_wrong = 0, E_covered = 0;
};

void JudgeUnlisted(const Diagnosis& d, const Unlisted& what, double share,
                   const std::vector<std::string>& there, double E, UnlistedCount& count) {
  ++count.cases;
  std::string said;
  bool wrong = false;
  double likeliest = 0.0;
  if (d.extension) {
    for (const CauseReport* c : d.extension->ToldCauses()) {
      const std::string name = c->cause.Name();
      const bool right = std::find(there.begin(), there.end(), name) != there.end();
      said += fmt::format("; {}{}{} P {:.2f} ({:.0f} %)", c->main ? "" : "small ",
                          right ? "" : "WRONG ", name, c->probability,
                          100.0 * d.extension->OfMisfit(c->share));
      if (!c->main) continue;
      if (!right) likeliest = std::max(likeliest, c->probability);
      const bool sure = c->probability >= kSure && d.verdict == Verdict::kNamed;
      count.sure += sure;
      count.sure_wrong += sure && !right;
      count.told_wrong += !right;
      wrong = wrong || (sure && !right);
    }
  }
  count.cases_sure_wrong += wrong;
  count.seen += d.refusal.empty() && d.verdict != Verdict::kAdequate;
  count.unexplained += d.verdict == Verdict::kUnexplained;
  const double unlisted = d.naming.unlisted_probability;
  count.said += d.verdict == Verdict::kUnexplained || unlisted > std::max(likeliest, kLikely);
  const Uncertainty& u = d.extension ? d.extension->uncertainty : d.uncertainty;
  const FittedModel& told = d.extension ? d.naming.best : d.null;
  bool covered = false;
  double off = 0.0;
  if (d.refusal.empty()) {
    const auto& interval = u.parameters[0].Wider();
    covered = interval && interval->first <= E && interval->second >= E;
    off = told.shared[0] / E - 1.0;
  }
  count.E_covered += covered;
  std::printf("%.1f x %-30s %s%s%s; unlisted P %.2f; E %+.2f %%%s\n", share, what.text,
              d.refusal.empty() ? std::string(NameOf(d.verdict)).c_str() : d.refusal.c_str(),
              said.c_str(), wrong ? " (SURE)" : "", unlisted, 100.0 * off,
              covered ? "" : " (not in its interval)");
  std::fflush(stdout);
}

template <typename Record>
void DiagnoseUnlisted(const std::vector<Unlisted>& causes, std::vector<std::string> there, double E,
                      const Record& record) {
  const int all = static_cast<int>(causes.size() * std::size(kShares));
  const int first = FromEnvironment("HOPLAB_UNLISTED_FROM", 0);
  const int last = std::min(all, first + FromEnvironment("HOPLAB_UNLISTED", all));
  const char* kept = std::getenv("HOPLAB_UNLISTED_FOLDER");
  UnlistedCount count;
  for (int i = first; i < last; ++i) {
    const Unlisted& what = causes[static_cast<std::size_t>(i) % causes.size()];
    const double share = kShares[static_cast<std::size_t>(i) / causes.size()];
    const TempFolder temp;
    const auto folder =
        (kept != nullptr ? std::filesystem::path(kept) : temp.path()) / std::to_string(i);
    record(what.of(share), i + 1, folder);
    if (::testing::Test::HasFatalFailure()) return;
    DiagnosisOptions options;
    options.fit.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    std::vector<std::string> right = there;
    right.insert(right.end(), what.akin.begin(), what.akin.end());
    JudgeUnlisted(Diagnose(ReadDataset(folder), options), what, share, right, E, count);
  }
  std::printf(
      "%d cases, %d seen, something unlisted told in %d, verdict unexplained in %d; of %d main "
      "causes named with P >= %.2f %d are not there, in %d cases; main causes told that are not "
      "there, whatever their P: %d; E in its interval in %d\n",
      count.cases, count.seen, count.said, count.unexplained, count.sure, kSure, count.sure_wrong,
      count.cases_sure_wrong, count.told_wrong, count.E_covered);
  EXPECT_GE(count.said, 0.6 * count.cases);
  EXPECT_LE(count.cases_sure_wrong, 0.03 * count.cases);
}

TEST(ForeignUnlisted, OfRigs) {
  BeamRig rig;
  rig.relaxation = 300e-6;
  DiagnoseUnlisted(kOfRigs, {"leg_material_damping", "leg_mass", "foot_coulomb_friction"},
                   rig.bending_stiffness / StatedSecondMoment(),
                   [&](const BeamExtras& extras, int seed, const std::filesystem::path& folder) {
                     BeamRig with = rig;
                     with.seed = seed;
                     with.extras = extras;
                     RecordRig(with, folder);
                   });
}

TEST(ForeignUnlisted, OfRobots) {
  Parameters<double> robot = RobotParametersFor(2);
  robot.E = 21.991e9;
  robot.I = 1.8355e-10;
  robot.robot->friction = 1.0;
  robot.robot->torque_limit = 15.0;
  robot.robot->damping = 4e-4;
  robot.robot->leg_mass = 0.010;
  robot.robot->clamp = robot.r * std::numbers::pi / 48.0;
  Parameters<double> told = robot;
  told.E = 24e9;
  told.robot->damping = 3e-4;
  DiagnoseUnlisted(kOfRobots, {}, robot.E,
                   [&](const BeamExtras& extras, int seed, const std::filesystem::path& folder) {
                     RecordRobot(robot, told, seed, false, folder, extras);
                   });
}

}  // namespace
}  // namespace hoplab::testing
