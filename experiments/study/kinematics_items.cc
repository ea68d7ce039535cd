#include "experiments/study/kinematics_items.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/units.h"
#include "experiments/kinematics/laser_scan.h"

namespace hoplab {
namespace {

constexpr double kWantedLow = DegToRad(5.0), kWantedHigh = DegToRad(10.0);
constexpr LegAngles kExample{DegToRad(45.0), DegToRad(75.0)};
constexpr int kCoarse = 7;    // 10 deg apart, as in figure 3.5
constexpr int kFine = 31;     // 2 deg apart
constexpr int kClaimed = 16;  // 4 deg apart
constexpr int kCurvePoints = 201;
constexpr double kLevel = 1e-9;  // rad: what rounding leaves of a level body

LaserScanRequest Request(const TwoLegs& legs, int count, int jobs) {
  return {legs, DegToRad(30.0), DegToRad(90.0), count, kWantedLow, kWantedHigh, jobs};
}
std::vector<ScanStart> InitialStates(const TwoLegs& legs, int count, int jobs) {
  return ScanInitialStates(Request(legs, count, jobs));
}

const StudyColumn kRearStart{"psi_rear_start_deg", "rear start angle", "deg"};
const StudyColumn kFrontStart{"psi_front_start_deg", "front start angle", "deg"};

void AddExample(const TwoLegs& legs, StudyFigure& figure) {
  const RollingPair pair(legs, kExample);
  const Travel travel = TravelOf(pair);
  const PitchRange range = PitchRangeOf(pair, travel);
  figure.numbers.insert(figure.numbers.end(), {{"example_lowest_pitch", range.lowest, "rad"},
                                               {"example_highest_pitch", range.highest, "rad"}});
}

StudyFigure Surfaces(const TwoLegs& legs, int jobs) {
  StudyFigure figure;
  figure.title = "Lowest and highest pitch that can be reached, over the start angles";
  figure.kind = StudyFigure::Kind::kSurface;
  figure.columns = {kRearStart,
                    kFrontStart,
                    {"pitch_lowest_deg", "lowest pitch", "deg"},
                    {"pitch_highest_deg", "highest pitch", "deg"}};
  StudyCurve surface;
  for (const ScanStart& start : InitialStates(legs, kCoarse, jobs))
    surface.rows.push_back({RadToDeg(start.angles.rear), RadToDeg(start.angles.front),
                            RadToDeg(start.range.lowest), RadToDeg(start.range.highest)});
  figure.curves = {std::move(surface)};
  AddExample(legs, figure);
  return figure;
}

StudyFigure FeasiblePairs(const TwoLegs& legs, int jobs) {
  StudyFigure figure;
  figure.title = "Start angles from which a pitch of 5 to 10 deg can be swept";
  figure.kind = StudyFigure::Kind::kSurface;
  figure.columns = {kRearStart, kFrontStart, {"feasible", "feasible", ""}};
  StudyCurve map;
  double feasible = 0.0;
  for (const ScanStart& start : InitialStates(legs, kFine, jobs)) {
    const double yes = start.feasible ? 1.0 : 0.0;
    feasible += yes;
    map.rows.push_back({RadToDeg(start.angles.rear), RadToDeg(start.angles.front), yes});
  }
  figure.numbers = {{"feasible_pairs", feasible, ""},
                    {"pairs", static_cast<double>(map.rows.size()), ""}};
  figure.curves = {std::move(map)};
  AddExample(legs, figure);
  return figure;
}

StudyFigure PitchCurve(const TwoLegs& legs, int) {
  StudyFigure figure;
  figure.title = "Pitch over the rear motor's angle, from 45 and 75 deg";
  figure.columns = {{"motor_rear_deg", "rear motor angle", "deg"},
                    {"pitch_deg", "body pitch", "deg"}};
  const RollingPair pair(legs, kExample);
  const Travel travel = TravelOf(pair);
  StudyCurve curve{"psi 45 and 75 deg", {}, {}, {}, {}};
  curve.outcome = fmt::format("{} to {}", NameOf(travel.low_stop), NameOf(travel.high_stop));
  for (const Pose& pose : PosesAlong(pair, travel, kCurvePoints))
    curve.rows.push_back({RadToDeg(pose.motor_rear), RadToDeg(pose.pitch)});
  figure.curves = {std::move(curve)};
  figure.numbers = {{"psi_rear_low", travel.low, "rad"}, {"psi_rear_high", travel.high, "rad"}};
  AddExample(legs, figure);
  return figure;
}

std::vector<StudyCheck> JudgeLevel(const TwoLegs& legs, int) {
  const LaserScanRequest request = Request(legs, kFine, 1);
  double worst = 0.0;
  bool reached = true;
  for (int i = 0; i < kFine; ++i) {
    const double angle = std::lerp(request.start_low, request.start_high, i / (kFine - 1.0));
    const ScanStart start = ScanFrom(request, {angle, angle});
    reached = reached && start.outcome == PoseOutcome::kReached;
    worst = std::max({worst, std::abs(start.range.lowest), std::abs(start.range.highest)});
  }
  return {{"from equal start angles the pitch stays below 1e-9 rad all the way",
           reached && worst < kLevel,
           {{"starts", static_cast<double>(kFine), ""}, {"largest_pitch", worst, "rad"}}}};
}

std::vector<StudyCheck> JudgeSign(const TwoLegs& legs, int jobs) {
  double turned = 0.0, reached = 0.0;
  for (const ScanStart& start : InitialStates(legs, kClaimed, jobs)) {
    if (start.outcome != PoseOutcome::kReached) continue;
    reached += 1.0;
    if ((start.start_pitch > kLevel && start.range.lowest < -kLevel) ||
        (start.start_pitch < -kLevel && start.range.highest > kLevel))
      turned += 1.0;
  }
  return {{"from no start does the pitch change its sign",
           reached > 0.0 && turned == 0.0,
           {{"starts", reached, ""}, {"changing_sign", turned, ""}}}};
}

struct FigurePlan {
  const char* name;
  StudyFigure (*run)(const TwoLegs&, int jobs);
};
const FigurePlan kFigures[] = {
    {"figure-3.5", Surfaces}, {"figure-3.6", FeasiblePairs}, {"figure-3.7", PitchCurve}};

struct ClaimPlan {
  const char* name;
  const char* statement;
  std::vector<StudyCheck> (*judge)(const TwoLegs&, int jobs);
};
const ClaimPlan kClaims[] = {
    {"claim-level", "Two legs put down at equal angles keep the body level", JudgeLevel},
    {"claim-sign", "The sign of the starting pitch never changes", JudgeSign}};

template <class Plans>
auto FindPlan(const Plans& plans, const std::string& name) {
  const auto plan = std::find_if(std::begin(plans), std::end(plans),
                                 [&](const auto& p) { return name == p.name; });
  HOPLAB_CHECK(plan != std::end(plans));
  return plan;
}

template <class Plans>
std::vector<std::string> NamesOf(const Plans& plans) {
  std::vector<std::string> names;
  for (const auto& plan : plans) names.emplace_back(plan.name);
  return names;
}

}  // namespace

std::vector<std::string> KinematicsFigureNames() { return NamesOf(kFigures); }

StudyFigure RunKinematicsFigure(const std::string& name, const TwoLegs& legs, int jobs) {
  StudyFigure figure = FindPlan(kFigures, name)->run(legs, jobs);
  figure.name = name;
  figure.numbers.push_back({"hip_distance", legs.hip_distance, "m"});
  figure.numbers.push_back({"leg_diameter", legs.leg_diameter, "m"});
  return figure;
}

std::vector<std::string> KinematicsClaimNames() { return NamesOf(kClaims); }

StudyClaim RunKinematicsClaim(const std::string& name, const TwoLegs& legs, int jobs) {
  const auto plan = FindPlan(kClaims, name);
  StudyClaim claim;
  claim.name = name;
  claim.statement = plan->statement;
  claim.checks = plan->judge(legs, jobs);
  TwoLegs circle = legs;
  circle.front_stops_upright = !legs.front_stops_upright;
  ClaimAlternative other{"front leg rolls on past upright, as a whole circle would", {}};
  for (const StudyCheck& check : plan->judge(circle, jobs)) other.holds.push_back(check.holds);
  const bool fails = std::find(other.holds.begin(), other.holds.end(), false) != other.holds.end();
  claim.alternatives = {other};
  claim.verdict = VerdictOf(claim.checks, claim.alternatives);
  if (claim.verdict == StudyVerdict::kReproduced && fails) {
    claim.verdict = StudyVerdict::kOnlyUnderSettings;
    claim.remark =
        "holds because a half circle ends: the front leg, too, stops upright. With a limit on the "
        "rear angle alone the front one passes 90 deg and the pitch turns over";
  }
  return claim;
}

}  // namespace hoplab
