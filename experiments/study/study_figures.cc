#include "experiments/study/study_figures.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/check.h"
#include "base/input_error.h"
#include "base/units.h"

namespace hoplab {
namespace {

constexpr double kJumpStep = 5e-4;        // s: a single jump takes half a second
constexpr double kHoppingStep = 4e-3;     // s: fifteen seconds
constexpr double kStanceMeanStep = 1e-3;  // s, for means over stances

// What is plotted: a column of the data and how it is read off a sample.
struct Quantity {
  StudyColumn column;
  double HoppingSample::*value;
};
const Quantity kTime{{"time_s", "time", "s"}, &HoppingSample::time_s};
const Quantity kPlace{{"x_m", "body position", "m"}, &HoppingSample::x_m};
const Quantity kHeight{{"y_m", "body height", "m"}, &HoppingSample::y_m};
const Quantity kSpeed{{"vx_m_per_s", "horizontal speed", "m/s"}, &HoppingSample::vx_m_per_s};
const Quantity kEnergy{{"energy_J", "kinetic and potential energy", "J"}, &HoppingSample::energy_J};
const Quantity kLength{{"leg_length_m", "leg length", "m"}, &HoppingSample::leg_length_m};
const Quantity kStiffness{{"stiffness_N_per_m", "leg stiffness", "N/m"},
                          &HoppingSample::stiffness_N_per_m};

enum class CurveSet {
  kFourJumps,    // figures 6.5 and 6.10
  kUprightJump,  // one jump each
  kRollingJump,
  kFromRest,
  kForward,
  kControlled,
  kBothLegs,  // controlled, C-leg and straight leg
  kStraightLeg
};

struct StudyFigurePlan {
  const char* number;
  const Quantity* across;
  const Quantity* up;
  CurveSet curves;
  double damping;  // N s/m; of a set with both, not used
};

const StudyFigurePlan kFigurePlans[] = {
    // Nothing is stated for 4.5 and 4.6; they settle, as the straight leg of 6.32 to 6.34 does.
    {"4.5", &kTime, &kHeight, CurveSet::kStraightLeg, 3},
    {"4.6", &kTime, &kSpeed, CurveSet::kStraightLeg, 3},
    {"6.5", &kPlace, &kHeight, CurveSet::kFourJumps, 0},
    {"6.6", &kTime, &kLength, CurveSet::kUprightJump, 0},
    {"6.7", &kTime, &kLength, CurveSet::kUprightJump, 3},
    {"6.8", &kTime, &kLength, CurveSet::kRollingJump, 0},
    {"6.9", &kTime, &kLength, CurveSet::kRollingJump, 3},
    {"6.10", &kTime, &kStiffness, CurveSet::kFourJumps, 0},
    {"6.11", &kPlace, &kHeight, CurveSet::kFromRest, 0},
    {"6.12", &kTime, &kSpeed, CurveSet::kFromRest, 0},
    {"6.13", &kTime, &kEnergy, CurveSet::kFromRest, 0},
    {"6.14", &kPlace, &kHeight, CurveSet::kFromRest, 3},
    {"6.15", &kTime, &kSpeed, CurveSet::kFromRest, 3},
    {"6.16", &kTime, &kEnergy, CurveSet::kFromRest, 3},
    {"6.17", &kPlace, &kHeight, CurveSet::kForward, 0},
    {"6.18", &kTime, &kSpeed, CurveSet::kForward, 0},
    {"6.19", &kTime, &kEnergy, CurveSet::kForward, 0},
    {"6.20", &kPlace, &kHeight, CurveSet::kForward, 3},
    {"6.21", &kTime, &kSpeed, CurveSet::kForward, 3},
    {"6.22", &kTime, &kEnergy, CurveSet::kForward, 3},
    {"6.23", &kTime, &kSpeed, CurveSet::kControlled, 0},
    {"6.24", &kTime, &kHeight, CurveSet::kControlled, 0},
    {"6.25", &kTime, &kEnergy, CurveSet::kControlled, 0},
    {"6.26", &kTime, &kSpeed, CurveSet::kControlled, 3},
    {"6.27", &kTime, &kHeight, CurveSet::kControlled, 3},
    {"6.28", &kTime, &kEnergy, CurveSet::kControlled, 3},
    {"6.29", &kTime, &kSpeed, CurveSet::kBothLegs, 0},
    {"6.30", &kTime, &kHeight, CurveSet::kBothLegs, 0},
    {"6.31", &kTime, &kEnergy, CurveSet::kBothLegs, 0},
    {"6.32", &kTime, &kSpeed, CurveSet::kBothLegs, 3},
    {"6.33", &kTime, &kHeight, CurveSet::kBothLegs, 3},
    {"6.34", &kTime, &kEnergy, CurveSet::kBothLegs, 3}};

std::string NameOfFigure(const StudyFigurePlan& plan) {
  return std::string("figure-") + plan.number;
}

const char* DampingText(double damping) { return damping == 0.0 ? "d = 0" : "d = 3 N s/m"; }

struct LabelledRun {
  std::string label;
  CaptionSettings settings;
};

std::vector<LabelledRun> RunsOf(const StudyFigurePlan& plan, const Study& study) {
  const double d = plan.damping;
  const std::string damping = DampingText(d);
  switch (plan.curves) {
    case CurveSet::kFourJumps: {
      std::vector<LabelledRun> runs;
      for (const bool rolling : {false, true}) {
        for (const double each : {0.0, 3.0})
          runs.push_back(
              {std::string(rolling ? "20 deg, 0.6 m/s, " : "0 deg, at rest, ") + DampingText(each),
               StudyCaptions::SingleJump(rolling, each)});
      }
      return runs;
    }
    case CurveSet::kUprightJump:
      return {{"0 deg, at rest, " + damping, StudyCaptions::SingleJump(false, d)}};
    case CurveSet::kRollingJump:
      return {{"20 deg, 0.6 m/s, " + damping, StudyCaptions::SingleJump(true, d)}};
    case CurveSet::kFromRest:
      return {{"15 deg, at rest, " + damping, StudyCaptions::FromRest(15.0, d)}};
    case CurveSet::kForward:
      return {{"20 deg, 1 m/s, " + damping, StudyCaptions::Forward(d)}};
    case CurveSet::kControlled:
      return {{"half-circular leg, " + damping, StudyCaptions::Controlled(d)}};
    case CurveSet::kBothLegs:
      return {{"half-circular leg, " + damping, StudyCaptions::Controlled(d)},
              {"straight leg, " + damping, StudyCaptions::Straight(study, d)}};
    case CurveSet::kStraightLeg:
      return {{"straight leg, " + damping, StudyCaptions::Straight(study, d)}};
  }
  return {};  // unreachable: every enumerator is listed above
}

const char* SubjectOf(CurveSet curves) {
  switch (curves) {
    case CurveSet::kFourJumps:
    case CurveSet::kUprightJump:
    case CurveSet::kRollingJump:
      return "single jump";
    case CurveSet::kFromRest:
      return "hopping without torque from rest";
    case CurveSet::kForward:
      return "hopping without torque from 1 m/s";
    case CurveSet::kControlled:
      return "hopping under the speed controller";
    case CurveSet::kBothLegs:
      return "half-circular and straight leg under the same controller";
    case CurveSet::kStraightLeg:
      return "straight leg under the speed controller";
  }
  return "";  // unreachable: every enumerator is listed above
}

}  // namespace

CaptionSettings StudyCaptions::SingleJump(bool rolling, double damping) {
  return {.start_speed_m_per_s = rolling ? 0.6 : 0.0,
          .touchdown_angle_rad = DegToRad(rolling ? 20.0 : 0.0),
          .damping_N_s_per_m = damping,
          .time_limit_s = 5.0,
          .hops = 1};
}

CaptionSettings StudyCaptions::FromRest(double touchdown_angle_deg, double damping) {
  return {.start_speed_m_per_s = 0.0,
          .touchdown_angle_rad = DegToRad(touchdown_angle_deg),
          .damping_N_s_per_m = damping};
}

CaptionSettings StudyCaptions::Forward(double damping) {
  return {.touchdown_angle_rad = DegToRad(20.0), .damping_N_s_per_m = damping};
}

CaptionSettings StudyCaptions::Controlled(double damping) {
  return {.touchdown_angle_rad = DegToRad(40.0), .damping_N_s_per_m = damping, .controlled = true};
}

CaptionSettings StudyCaptions::Straight(const Study& study, double damping) {
  CaptionSettings settings = Controlled(damping);
  const StraightSpringLeg leg =
      MeanLeg(RunHopping(HopperOfCaption(study, settings), kStanceMeanStep));
  if (std::isnan(leg.rest_length_m))
    throw InputError(
        {study.constants.origin.place, "",
         "its half-circular leg never stands on the ground under the controller",
         "The straight leg of figures 6.29 to 6.34 is the mean of that leg in stance."});
  settings.straight = leg;
  return settings;
}

std::vector<std::string> StudyFigureNames() {
  std::vector<std::string> names;
  for (const StudyFigurePlan& plan : kFigurePlans) names.push_back(NameOfFigure(plan));
  return names;
}

StudyFigure RunStudyFigure(const std::string& name, const Study& study) {
  const auto plan = std::find_if(std::begin(kFigurePlans), std::end(kFigurePlans),
                                 [&](const StudyFigurePlan& p) { return NameOfFigure(p) == name; });
  HOPLAB_CHECK(plan != std::end(kFigurePlans));
  StudyFigure figure;
  figure.name = name;
  figure.title = plan->up->column.label + ": " + SubjectOf(plan->curves);
  figure.title.front() = static_cast<char>(std::toupper(figure.title.front()));
  figure.columns = {plan->across->column, plan->up->column};
  for (const LabelledRun& labelled : RunsOf(*plan, study)) {
    const CaptionSettings& settings = labelled.settings;
    StudyCurve curve{labelled.label, settings, {}, {}, {}};
    const HoppingRun run =
        RunHopping(HopperOfCaption(study, settings), settings.hops ? kJumpStep : kHoppingStep);
    curve.outcome = NameOf(run.outcome);
    curve.end_time_s = run.end_time_s;
    for (const HoppingSample& sample : run.samples)
      curve.rows.push_back({sample.*plan->across->value, sample.*plan->up->value});
    figure.curves.push_back(std::move(curve));
  }
  return figure;
}

}  // namespace hoplab
