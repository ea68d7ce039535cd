#include "experiments/kinematics/two_legs.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/units.h"

namespace hoplab {
namespace {

constexpr double kRightAngle = 0.5 * std::numbers::pi;
// Roundings of a sum of terms of size b/d_leg: a root this close to an end lies on it.
constexpr double kRoundoff = 1e-13;
// Below this determinant psi_f turns more than a thousand times as fast as the input.
constexpr double kSingularDeterminant = 1e-6;
constexpr int kRootBits = 52;
constexpr double kUpended = 1e-6;   // cosine of the pitch of a body that stands on end
constexpr double kTouching = 1e-6;  // of a leg's diameter above the ground
constexpr double kBeyond = 0.01;    // past a limit, to be stopped by it

double Square(double x) { return x * x; }

// Of the rear motor's angle by psi_r, M22.
double MotorRate(const Pose& pose) { return 2.0 + pose.pitch_rate; }

// The root of a function that changes sign in [low, high].
template <class F>
double Root(const F& f, double low, double high) {
  const double f_low = f(low), f_high = f(high);
  if (f_low == 0.0) return low;
  if (f_high == 0.0) return high;
  std::uintmax_t iterations = 200;
  const auto [a, b] = boost::math::tools::toms748_solve(
      f, low, high, f_low, f_high, boost::math::tools::eps_tolerance<double>(kRootBits),
      iterations);
  return std::midpoint(a, b);
}

}  // namespace

std::string_view NameOf(PoseOutcome outcome) {
  switch (outcome) {
    case PoseOutcome::kReached:
      return "reached";
    case PoseOutcome::kRearUpright:
      return "rear_upright";
    case PoseOutcome::kFrontUpright:
      return "front_upright";
    case PoseOutcome::kBodyOnGround:
      return "body_on_ground";
    case PoseOutcome::kSingular:
      return "singular";
    case PoseOutcome::kMotorTurns:
      return "motor_turns";
    case PoseOutcome::kCannotClose:
      return "cannot_close";
  }
  return "";  // unreachable: every enumerator is listed above
}

RollingPair::RollingPair(const TwoLegs& legs, LegAngles start)
    : legs_(legs), ratio_(legs.hip_distance / legs.leg_diameter), start_{} {
  const double sine = (Square(std::sin(start.front)) - Square(std::sin(start.rear))) / ratio_;
  if (std::abs(sine) >= 1.0) {
    start_.outcome = PoseOutcome::kCannotClose;
    return;
  }
  start_closure_ = Closure(start.rear, start.front);
  start_.pose = PoseOf(start.rear, start.front);
  start_.outcome = start.rear > kRightAngle + kRoundoff ? PoseOutcome::kRearUpright
                   : legs_.front_stops_upright && start.front > kRightAngle + kRoundoff
                       ? PoseOutcome::kFrontUpright
                       : OutcomeOf(start_.pose);
}

double RollingPair::PitchOf(double psi_rear, double psi_front) const {
  const double sine = (Square(std::sin(psi_front)) - Square(std::sin(psi_rear))) / ratio_;
  return std::asin(std::clamp(sine, -1.0, 1.0));
}

// (l_g - d_leg (psi_f - psi_r))/d_leg, which rolling keeps at its start value.
double RollingPair::Closure(double psi_rear, double psi_front) const {
  const double pitch = PitchOf(psi_rear, psi_front);
  return ratio_ * std::cos(pitch) + 0.5 * (std::sin(2.0 * psi_front) - std::sin(2.0 * psi_rear)) -
         (psi_front - psi_rear) - start_closure_;
}

double RollingPair::SingularEnd(double psi_rear) const {
  const double excess = Square(std::sin(psi_rear)) - ratio_;  // > 0: the body stands on end
  const double low = excess > 0.0 ? std::asin(std::sqrt(excess)) : 0.0;
  return Root([&](double psi_front) { return psi_front + PitchOf(psi_rear, psi_front); }, low,
              psi_rear);
}

double RollingPair::MaxFront(double psi_rear, PoseOutcome* end) const {
  const double sine_squared = Square(std::sin(psi_rear)) + ratio_;
  if (sine_squared < 1.0) {
    *end = PoseOutcome::kCannotClose;
    return std::asin(std::sqrt(sine_squared));
  }
  *end = legs_.front_stops_upright ? PoseOutcome::kFrontUpright : PoseOutcome::kBodyOnGround;
  return legs_.front_stops_upright ? kRightAngle : std::numbers::pi;
}

Pose RollingPair::PoseOf(double psi_rear, double psi_front) const {
  Pose pose{};
  pose.psi_rear = psi_rear;
  pose.psi_front = psi_front;
  pose.pitch = PitchOf(psi_rear, psi_front);
  pose.contact_distance =
      legs_.leg_diameter * (Closure(psi_rear, psi_front) + start_closure_ + psi_front - psi_rear);
  pose.motor_rear = 2.0 * psi_rear + pose.pitch;
  pose.motor_front = 2.0 * psi_front + pose.pitch;
  pose.determinant = std::sin(psi_front) * std::sin(psi_front + pose.pitch);
  const double front_rate = std::sin(psi_rear) * std::sin(psi_rear + pose.pitch) / pose.determinant;
  pose.pitch_rate = (std::sin(2.0 * psi_front) * front_rate - std::sin(2.0 * psi_rear)) /
                    (ratio_ * std::cos(pose.pitch));
  return pose;
}

PoseOutcome RollingPair::OutcomeOf(const Pose& pose) const {
  const double lower_hip =
      legs_.leg_diameter * Square(std::min(std::sin(pose.psi_rear), std::sin(pose.psi_front)));
  const double clearance = lower_hip - legs_.body_depth * std::cos(pose.pitch);
  if (clearance < kTouching * legs_.leg_diameter) return PoseOutcome::kBodyOnGround;
  if (pose.determinant < kSingularDeterminant) return PoseOutcome::kSingular;
  if (std::cos(pose.pitch) < kUpended) return PoseOutcome::kCannotClose;
  if (MotorRate(pose) * MotorRate(start_.pose) <= 0.0) return PoseOutcome::kMotorTurns;
  return PoseOutcome::kReached;
}

PoseResult RollingPair::At(double psi_rear) const {
  PoseResult result = start_;
  if (start_.outcome != PoseOutcome::kReached) return result;
  result.outcome = psi_rear > kRightAngle + kRoundoff ? PoseOutcome::kRearUpright
                   : psi_rear <= 0.0                  ? PoseOutcome::kBodyOnGround
                                                      : PoseOutcome::kReached;
  if (result.outcome != PoseOutcome::kReached) return result;
  PoseOutcome above{};
  const double low = SingularEnd(psi_rear), high = MaxFront(psi_rear, &above);
  const double at_low = Closure(psi_rear, low), at_high = Closure(psi_rear, high);
  const double roundoff = kRoundoff * (1.0 + ratio_);
  if (at_low <= 0.0) return {PoseOutcome::kSingular, {}};
  if (at_high > roundoff) return {above, {}};
  const double front =
      at_high > -roundoff
          ? high
          : Root([&](double psi_front) { return Closure(psi_rear, psi_front); }, low, high);
  result.pose = PoseOf(psi_rear, front);
  result.outcome = OutcomeOf(result.pose);
  return result;
}

namespace {

// The last rear angle at which the pose is reached, from the start on in one direction; `bound` is
// beyond every pose there can be.
double LastReached(const RollingPair& pair, bool upward, double bound, PoseOutcome* stop) {
  constexpr double kStep = DegToRad(0.5);
  const double step = upward ? kStep : -kStep;
  double good = pair.start().pose.psi_rear;
  for (;;) {
    const double next = upward ? std::min(good + step, bound) : std::max(good + step, bound);
    *stop = pair.At(next).outcome;
    if (*stop == PoseOutcome::kReached) {
      good = next;
      continue;
    }
    const auto failed = [&](double psi) {
      return pair.At(psi).outcome == PoseOutcome::kReached ? -1.0 : 1.0;
    };
    const auto [a, b] =
        boost::math::tools::bisect(failed, std::min(good, next), std::max(good, next),
                                   [](double low, double high) { return high - low < kRoundoff; });
    *stop = pair.At(upward ? b : a).outcome;  // what lies right behind the end
    return upward ? a : b;
  }
}

}  // namespace

Travel TravelOf(const RollingPair& pair) {
  Travel travel{};
  travel.low_stop = travel.high_stop = pair.start().outcome;
  travel.low = travel.high = pair.start().pose.psi_rear;
  if (pair.start().outcome != PoseOutcome::kReached) return travel;
  travel.low = LastReached(pair, false, 0.0, &travel.low_stop);
  travel.high = LastReached(pair, true, kRightAngle + kBeyond, &travel.high_stop);
  return travel;
}

PitchRange PitchRangeOf(const RollingPair& pair, const Travel& travel) {
  PitchRange range;
  if (pair.start().outcome != PoseOutcome::kReached) return range;
  constexpr int kSamples = 90;
  constexpr int kMinimumBits = 26;  // half the digits: all that a minimum's place has
  const auto psi_at = [&](int i) {
    return std::min(travel.low + (travel.high - travel.low) * i / kSamples, travel.high);
  };
  // Missing where an end of the travel is not reached by a rounding.
  const auto pitch_at = [&](double psi) {
    const PoseResult at = pair.At(psi);
    return at.outcome == PoseOutcome::kReached ? at.pose.pitch
                                               : std::numeric_limits<double>::quiet_NaN();
  };
  // The start is tried by itself: where it stands at a limit it is all there is.
  range.lowest = range.highest = pair.start().pose.pitch;
  int lowest = 0, highest = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const double pitch = pitch_at(psi_at(i));
    if (pitch < range.lowest) lowest = i;
    if (pitch > range.highest) highest = i;
    range.lowest = std::fmin(range.lowest, pitch);
    range.highest = std::fmax(range.highest, pitch);
  }
  const auto refined = [&](int place, double sign) {
    const auto value = [&](double psi) {
      const double pitch = pitch_at(psi);
      return std::isnan(pitch) ? std::numeric_limits<double>::infinity() : sign * pitch;
    };
    return sign * boost::math::tools::brent_find_minima(value, psi_at(std::max(place - 1, 0)),
                                                        psi_at(std::min(place + 1, kSamples)),
                                                        kMinimumBits)
                      .second;
  };
  range.lowest = std::fmin(range.lowest, refined(lowest, 1.0));
  range.highest = std::fmax(range.highest, refined(highest, -1.0));
  return range;
}

}  // namespace hoplab
