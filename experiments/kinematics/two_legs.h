#pragma once

#include <limits>
#include <string_view>

namespace hoplab {

// A body on two rigid half-circular legs that roll on flat ground without slip (section 6 of the
// equation sheet; thesis ch. 3). Angles in rad, lengths in m. psi is the angle between the ground
// and the virtual link from the contact up to the hip: 90 deg with the hip upright over the toe, 0
// with the hip on the ground. The pitch alpha_b is positive with the front hip up.

/// The mechanism. The study prints none of these: the leg is twice the rest radius of the other
/// experiments, hips are 0.4 m apart, and the body is the line through them. All of it scales: the
/// angles depend on hip_distance/leg_diameter alone.
struct TwoLegs {
  double hip_distance = 0.40;  // b
  double leg_diameter = 0.18;  // d_leg
  double body_depth = 0.0;     // of the body's underside below the line of the hips
  /// A half circle ends at its toe, at psi_f = 90 deg. Off: the front leg rolls on as a whole
  /// circle, as M18-M21 alone would have it.
  bool front_stops_upright = true;
};

struct LegAngles {
  double rear = 0.0, front = 0.0;  // psi_r, psi_f
};

/// Whether a pose exists, and what is in its way.
enum class PoseOutcome {
  kReached,
  kRearUpright,   // the rear leg would roll over its toe: psi_r > 90 deg
  kFrontUpright,  // the front leg would: psi_f > 90 deg
  kBodyOnGround,  // a hip, or the underside below it, would be in the ground
  kSingular,      // the front virtual link and the body are in line: the Jacobian is singular
  kMotorTurns,    // the rear motor's angle has its extreme on the way: it cannot drive through
  kCannotClose    // the body would have to stand on end: it is no longer than the hips' difference
                  // of height
};
std::string_view NameOf(PoseOutcome outcome);

struct Pose {
  double psi_rear, psi_front;
  double pitch;                    // alpha_b
  double contact_distance;         // l_g, M20 [m]
  double motor_rear, motor_front;  // M22
  /// Jacobian determinant of M19 and (M20 = M21) by (psi_f, alpha_b), over 2 b d_leg:
  /// sin psi_f sin(psi_f + alpha_b).
  double determinant;
  double pitch_rate;  // d alpha_b/d psi_r
};

struct PoseResult {
  PoseOutcome outcome;
  Pose pose;  // meaningful only if reached
};

/// The mechanism put down at two start angles, from then on with one degree of freedom.
///
/// M19 gives alpha_b from psi_f, which leaves M20 = M21 as one equation in psi_f. Its slope is - 2
/// d_leg sin psi_f sin(psi_f + alpha_b)/cos alpha_b: of one sign as long as the Jacobian of the two
/// equations is. So the branch that the start lies on is a bracket with one root in it, which TOMS
/// 748 finds without an initial guess, or there is none, and which end of the bracket the equation
/// points at says why.
class RollingPair {
 public:
  RollingPair(const TwoLegs& legs, LegAngles start);

  /// The pose the mechanism was put down in.
  const PoseResult& start() const { return start_; }
  /// The pose at a rear angle, if the mechanism gets there from its start. Not reached if the start
  /// is not.
  PoseResult At(double psi_rear) const;

 private:
  double PitchOf(double psi_rear, double psi_front) const;   // M19
  double Closure(double psi_rear, double psi_front) const;   // M20 - M21
  double SingularEnd(double psi_rear) const;                 // psi_f + alpha_b = 0
  Pose PoseOf(double psi_rear, double psi_front) const;      // all else
  PoseOutcome OutcomeOf(const Pose& pose) const;             // of a pose that closes
  double MaxFront(double psi_rear, PoseOutcome* end) const;  // upper end of the bracket

  TwoLegs legs_;
  double ratio_;                // b/d_leg
  double start_closure_ = 0.0;  // l_g(0) + d_leg (psi_r0 - psi_f0), over d_leg
  PoseResult start_;
};

/// How far the rear leg can be turned either way, and what stops it. Meaningful if the start is
/// reached.
struct Travel {
  double low, high;  // psi_r
  PoseOutcome low_stop, high_stop;
};
Travel TravelOf(const RollingPair& pair);

/// The lowest and highest pitch on the way; NaN if the start is not reached.
struct PitchRange {
  double lowest = std::numeric_limits<double>::quiet_NaN();
  double highest = std::numeric_limits<double>::quiet_NaN();
};
PitchRange PitchRangeOf(const RollingPair& pair, const Travel& travel);

}  // namespace hoplab
