#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// A trial somebody could record: one of the train trials with some settings changed.
struct TrialDesign {
  std::string like;              // file of the train trial it is modelled on
  double touchdown_angle = 0.0;  // rad; NaN: it has none to set
  double height = 0.0;           // of the start [m]
  double speed = 0.0;            // vx of the start [m/s]; negative: it hops back
  std::optional<double> kp;      // N s; absent without a controller
  double added_mass = 0.0;       // on the body, beside what that trial had [kg]
  double throw_speed = 0.0;      // vy of the start [m/s], up
  // Of a robot: pitch of the start, angles its motors are held at [rad]; NaN where it has none.
  double pitch = std::numeric_limits<double>::quiet_NaN();
  std::array<double, kMaxLegs> leg_angle = NoAngles();

  static std::array<double, kMaxLegs> NoAngles() {
    std::array<double, kMaxLegs> none;
    none.fill(std::numeric_limits<double>::quiet_NaN());
    return none;
  }
};

/// "drop from 0.35 m at 1.2 m/s with a touch-down angle of 40 deg": a design in words.
std::string Describe(const TrialDesign& design);

/// What may be set for a trial to come.
enum class DesignSetting {
  kAngle,
  kHeight,
  kSpeed,
  kMass,
  kThrow,
  kGain,
  kPitch,
  kLeg1,
  kLeg2,
  kLeg3,
  kLeg4
};
inline constexpr int kDesignSettings = 11;

struct DesignSettingInfo {
  std::string_view name;    // on the command line: "angle"
  std::string_view column;  // "angle_deg"
  std::string_view unit;    // of the column
  double si;                // SI value of one such unit
};
const DesignSettingInfo& InfoOf(DesignSetting setting);
std::optional<DesignSetting> FindDesignSetting(std::string_view name);

/// A setting and the closed range it may be set in, SI; low == high: it is held there.
struct DesignRange {
  DesignSetting setting = DesignSetting::kAngle;
  double low = 0.0, high = 0.0;
  bool searched() const { return low < high; }
};

/// The trials that may be recorded next.
struct DesignSpace {
  TrialProblem like;  // the train trial whose other settings they have
  std::vector<DesignRange> ranges;

  std::vector<DesignRange> Searched() const;
  /// The design at a point of the searched ranges, each coordinate in 0..1.
  TrialDesign At(std::span<const double> point) const;
};

/// Value of a setting of a design, SI.
double ValueOf(const TrialDesign& design, DesignSetting setting);

/// Settings of the trials that were recorded, and somewhat beyond: angles by 15 deg, heights by 15
/// % down and 60 % up, speeds from half the greatest backwards to one and a half times it, up to
/// half of the body's mass added, a throw of up to 1 m/s, gains up to twice the greatest; of a
/// robot pitches by 10 deg, and angles of each motor that is held by 15 deg. What the set-up has
/// not (the angle of a ball, the speed on a guide, the mass where it is fitted) is not among them.
DesignSpace DefaultSpace(const FitProblem& problem, const std::vector<TrialProblem>& train);

/// The same without what asks for more than another drop: mass, throw, hop back.
DesignSpace PlainSpace(const FitProblem& problem, const std::vector<TrialProblem>& train);

/// `space` with ranges put over its own. Throws InputError (place `place`) for a setting it has
/// not, or a range beyond what can be simulated.
void SetRanges(DesignSpace& space, std::span<const DesignRange> ranges, const std::string& place);

/// The trial of a design, without data: rows and channels as in the trial it is like, its start
/// known as well as that one's.
TrialProblem TrialOf(const TrialDesign& design, const TrialProblem& like);

}  // namespace hoplab
