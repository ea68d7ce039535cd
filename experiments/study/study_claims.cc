#include "experiments/study/study_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/units.h"
#include "experiments/study/claim_judges.h"
#include "experiments/study/energy_causes.h"
#include "experiments/study/study_figures.h"

namespace hoplab {
namespace {

constexpr double kStanceEndStep = 1e-4;  // s: first and last sample of a stance stand for its ends
constexpr double kAngles[] = {25.0, 30.0, 35.0, 40.0, 45.0};  // deg, of table 6.5
constexpr double kFromRestAngle = 15.0;                       // deg, of claim (b)
constexpr double kAside = 5.0;       // deg: its smaller and its larger angle
constexpr double kOffNeutral = 0.5;  // deg: near enough to the neutral angle to stay there a while

using Checks = std::vector<StudyCheck>;

HoppingRun Run(const Study& study, const CaptionSettings& settings, double step = 0.0) {
  return RunHopping(HopperOfCaption(study, settings), step);
}

Checks JudgeA(const Study& study) {
  const auto jump = [&](bool rolling, double d) {
    return Run(study, StudyCaptions::SingleJump(rolling, d), kStanceEndStep);
  };
  return JudgeSingleJumps({jump(false, 0), jump(false, 3), jump(true, 0), jump(true, 3)});
}

// From rest at `angle` deg, and at a smaller and a larger one.
Checks JudgeFromRestAt(const Study& study, double angle) {
  const auto from_rest = [&](double at, double d) {
    return Run(study, StudyCaptions::FromRest(at, d));
  };
  return JudgeFromRest({from_rest(angle, 0), from_rest(angle, 3), from_rest(angle - kAside, 0),
                        from_rest(angle + kAside, 0)});
}

Checks JudgeB(const Study& study) { return JudgeFromRestAt(study, kFromRestAngle); }

Checks JudgeC(const Study& study) {
  return JudgeForward(Run(study, StudyCaptions::Forward(0)), Run(study, StudyCaptions::Forward(3)));
}

Checks JudgeD(const Study& study) {
  const CaptionSettings settings = StudyCaptions::Controlled(0);
  return JudgeControlled(Run(study, settings), Run(study, StudyCaptions::Controlled(3)),
                         settings.v_des_m_per_s);
}

Checks JudgeE(const Study& study) {
  const CaptionSettings settings = StudyCaptions::Straight(study, 0);
  return JudgeStraightLeg(Run(study, settings), settings.v_des_m_per_s);
}

// The straight leg at the whole angle of the caption.
Checks JudgeObliqueStraightLeg(const Study& study) {
  CaptionSettings settings = StudyCaptions::Straight(study, 0);
  settings.straight->touchdown_angle_rad = settings.touchdown_angle_rad;
  return JudgeStraightLeg(Run(study, settings), settings.v_des_m_per_s);
}

Checks JudgeF(const Study& study) {
  return JudgeInitialStates(RunStartGrid(study, 0).time, RunStartGrid(study, 6).time);
}

Checks JudgeG(const Study& study) {
  return JudgeModulus(RunModulusSweep(study, 0), RunModulusSweep(study, 6));
}

Checks JudgeH(const Study& study) {
  std::vector<double> percent;
  for (const double angle : kAngles) percent.push_back(EnergyPercent(study, DegToRad(angle), 0));
  return JudgeEnergyGain(percent);
}

std::vector<bool> Holds(const Checks& checks) {
  std::vector<bool> holds;
  for (const StudyCheck& check : checks) holds.push_back(check.holds);
  return holds;
}

std::vector<std::pair<std::string, Study>> OtherSettings(const Study& study) {
  std::vector<std::pair<std::string, Study>> others;
  const MechanismSpec& own = study.constants.mechanism;
  const std::string own_law = study.constants.law.value_or("");
  for (const Law law : {Law::kThesis, Law::kNoSlip, Law::kConsistent, Law::kLargeDeflection}) {
    Study other = WithLaw(study, law);
    const bool same = NameOf(law) == own_law && other.constants.mechanism == own;
    if (!same) others.emplace_back(fmt::format("law {}", NameOf(law)), std::move(other));
  }
  const bool by_force = own.liftoff == LiftoffRule::kZeroForce;
  Study other = study;
  other.constants.mechanism.liftoff = by_force ? LiftoffRule::kRestLength : LiftoffRule::kZeroForce;
  others.emplace_back(by_force ? "lift-off at rest length" : "lift-off at zero force",
                      std::move(other));
  if (study.PlacedShare() != 1.0) {
    other = study;
    other.constants.start_angle_rad.reset();
    others.emplace_back("every landing at the printed angle", other);
    other = study;
    other.places_first_landing = true;
    others.emplace_back("the first landing placed like the later ones", std::move(other));
  }
  return others;
}

// The touch-down angle at which a first hop from rest gains no speed [deg]; NaN where the speed
// does not turn from forward to backward between -20 and 40 deg.
double NeutralAngle(const Study& study) {
  const auto speed = [&](double angle) {
    CaptionSettings settings = StudyCaptions::FromRest(angle, 0);
    settings.hops = 1;
    const HoppingRun run = Run(study, settings);
    return run.apexes.size() > 1 ? run.apexes[1].speed_m_per_s : run.final_speed_m_per_s;
  };
  constexpr double kResolution = 1e-6;  // deg
  double low = -20.0, high = 40.0;
  if (!(speed(low) > 0.0) || !(speed(high) < 0.0)) return std::nan("");
  while (high - low > kResolution) {
    const double middle = 0.5 * (low + high);
    (speed(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void AddNeutralAngle(const Study& study, StudyClaim& claim) {
  const double angle = NeutralAngle(study);
  claim.numbers.push_back({"neutral_angle", DegToRad(angle), "rad"});
  if (std::isnan(angle)) return;
  claim.remark = fmt::format(
      "a first hop from rest gains no speed at {:.1f} deg here, at 15 deg in the study", angle);
  claim.alternatives.push_back(
      {fmt::format("{:.1f} deg in place of 15, half a degree above the neutral angle",
                   angle + kOffNeutral),
       Holds(JudgeFromRestAt(study, angle + kOffNeutral))});
}

void AddObliqueLeg(const Study& study, StudyClaim& claim) {
  claim.alternatives.push_back({"straight leg put down at 40 deg from the vertical, not at 20",
                                Holds(JudgeObliqueStraightLeg(study))});
}

void AddSofteningRemark(const Study&, StudyClaim& claim) {
  claim.remark =
      "on the toe the contact arc is pi, so that k depends on the deformed radius alone (M3) and "
      "falls as that grows; the study explains the rise by the growing radius, which its own "
      "stiffness contradicts";
}

void AddCauses(const Study& study, StudyClaim& claim) {
  claim.columns = {{"touchdown_angle_deg", "touch-down angle", "deg"},
                   {"study_percent", "as the study reads its law", "%"},
                   {"thesis_percent", "thesis (M5 to M7)", "%"},
                   {"rolling_percent", "contact by arc laid down (M8) alone", "%"},
                   {"tip_percent", "tip rotation (M10) alone", "%"},
                   {"both_percent", "both", "%"},
                   {"consistent_percent", "consistent", "%"},
                   {"removed_by_rolling", "removed by the rolling law", "% points"},
                   {"removed_by_tip", "removed by tip rotation", "% points"},
                   {"integration_error", "change with finer integration", "% points"}};
  double read = 0.0, gain = 0.0, rolling = 0.0, tip = 0.0, worst_error = 0.0,
         worst_consistent = 0.0;
  constexpr double kCount = std::size(kAngles);
  for (const double angle : kAngles) {
    const EnergyCauses c = EnergyCausesAt(study, DegToRad(angle));
    claim.rows.push_back({angle, c.study, c.thesis, c.with_rolling, c.with_tip, c.with_both,
                          c.consistent, c.removed_by_rolling, c.removed_by_tip,
                          c.integration_error});
    read += (c.study - 100.0) / kCount;
    gain += (c.thesis - c.with_both) / kCount;
    rolling += c.removed_by_rolling / kCount;
    tip += c.removed_by_tip / kCount;
    worst_error = std::max(worst_error, std::abs(c.integration_error));
    worst_consistent = std::max(worst_consistent, std::abs(c.consistent - 100.0));
  }
  claim.numbers = {{"mean_gain_as_read", read, "% points"},
                   {"mean_gain", gain, "% points"},
                   {"mean_removed_by_rolling", rolling, "% points"},
                   {"mean_removed_by_tip", tip, "% points"},
                   {"largest_integration_error", worst_error, "% points"},
                   {"largest_consistent_error", worst_consistent, "% points"}};
  if (std::isnan(gain)) {
    claim.remark = "not every jump on the way from thesis to consistent reaches its next apex";
    return;
  }
  claim.remark = fmt::format(
      "the study blames integration along the arc. The law consistent integrates the same arc and "
      "keeps the energy to {:.1e} percentage points, and finer steps change thesis by {:.1e}. Two "
      "terms of the law make or lose energy: means over the angles, the rolling law (M7 in place "
      "of "
      "the arc laid down) makes {:+.2f} percentage points and the tip that does not rotate (M10) "
      "{:+.2f}, together {:+.2f} in the plain law; as the constants read it, it gains {:+.2f}",
      worst_consistent, worst_error, rolling, tip, gain, read);
}

struct StudyClaimPlan {
  const char* name;
  const char* statement;
  Checks (*judge)(const Study&);
  void (*add)(const Study&, StudyClaim&) = nullptr;  // more alternatives, what explains it
};

const StudyClaimPlan kClaimPlans[] = {
    {"claim-a",
     "Single jump: a lower apex with damping, a leg that shortens and lengthens again and leaves "
     "the ground longer and softer than it came; upright, it stiffens again before lift-off",
     JudgeA, AddSofteningRemark},
    {"claim-b",
     "Without torque, from rest at 15 deg: nearly vertical hops, then backward speed and a fall, "
     "sooner with damping; forward at smaller angles, backward at larger ones",
     JudgeB, AddNeutralAngle},
    {"claim-c",
     "Without torque, from 1 m/s at 20 deg: faster and lower every hop; with damping slower, and "
     "more hops",
     JudgeC},
    {"claim-d",
     "Under the speed controller speed and height settle with a considerable error; with damping "
     "sooner and lower",
     JudgeD},
    {"claim-e",
     "A straight leg under the same controller reaches the speed, but without damping its height "
     "and energy grow for 15 s",
     JudgeE, AddObliqueLeg},
    {"claim-f", "All 25 starts converge, with damping sooner", JudgeF},
    {"claim-g",
     "Convergence time has no trend with E without damping and falls with E with damping; the "
     "range of stiffness rises with E",
     JudgeG},
    {"claim-h", "Without damping energy is gained, the less the larger the touch-down angle",
     JudgeH, AddCauses}};

}  // namespace

std::vector<std::string> StudyClaimNames() {
  std::vector<std::string> names;
  for (const StudyClaimPlan& plan : kClaimPlans) names.emplace_back(plan.name);
  return names;
}

StudyClaim RunStudyClaim(const std::string& name, const Study& study) {
  const auto plan = std::find_if(std::begin(kClaimPlans), std::end(kClaimPlans),
                                 [&](const StudyClaimPlan& p) { return name == p.name; });
  HOPLAB_CHECK(plan != std::end(kClaimPlans));
  StudyClaim claim;
  claim.name = name;
  claim.statement = plan->statement;
  claim.checks = plan->judge(study);
  for (const auto& [setting, other] : OtherSettings(study))
    claim.alternatives.push_back({setting, Holds(plan->judge(other))});
  if (plan->add) plan->add(study, claim);
  claim.verdict = VerdictOf(claim.checks, claim.alternatives);
  return claim;
}

}  // namespace hoplab
