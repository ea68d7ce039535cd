#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "experiments/study/convergence_reading.h"
#include "model/simulate.h"

namespace hoplab {

/// One reading of the study's law: what its text leaves open, without numbers.
struct StudyReading {
  ThesisReading law;
  LiftoffRule liftoff = LiftoffRule::kZeroForce;
  bool operator==(const StudyReading&) const = default;
};

/// The numbers the study does not print.
enum class StudyConstant {
  kMass,
  kRadius,
  kBendingStiffness,
  kGain,
  kStartSpeed,
  kDampingScale,
  kRollingBlend,
  kToeMass,
  kPlacementRate,
  kPlacementDamping,
  kPlacedShare,
  kDesiredSpeed
};
inline constexpr int kStudyConstantCount = 12;
using StudyConstants = std::array<double, kStudyConstantCount>;

struct StudyConstantInfo {
  std::string_view name, unit, sentence;
  double low, high;   // where it is searched
  double if_printed;  // value where it is not searched
};
const StudyConstantInfo& InfoOf(StudyConstant constant);

inline double& At(StudyConstants& constants, StudyConstant which) {
  return constants[static_cast<std::size_t>(which)];
}
inline double At(const StudyConstants& constants, StudyConstant which) {
  return constants[static_cast<std::size_t>(which)];
}
/// All at `if_printed`.
StudyConstants ConstantsAsPrinted();

/// Whether a constant has a say in the jumps of table 6.5 of a massless leg, where no torque acts
/// in stance and no second landing comes.
bool IsInEnergy(StudyConstant constant);
/// Whether it says something only with a mass at the toe.
bool NeedsToeMass(StudyConstant constant);

/// The strip the bending stiffness stands for: with its width taken as 30 mm, thickness [m], second
/// moment [m^4] and area [m^2] at the study's modulus of 22 GPa. G is taken as 4 GPa; axial and
/// shear deformation are below a hundredth of the bending.
struct StudySection {
  double width_m, thickness_m, second_moment_m4, area_m2;
};
StudySection SectionOf(double bending_stiffness_N_m2);

/// Flight placement of a leg with a toe mass, as a torque [N m/rad, N m s/rad]: the leg is brought
/// to its angle like a damped oscillator of a rate and a share of critical damping.
struct StudyPlacement {
  double kp_N_m_per_rad, kd_N_m_s_per_rad;
};
StudyPlacement PlacementOf(const StudyConstants& constants);

/// The study's hopper: what a run of it needs.
struct StudyHopper {
  StudyReading reading;
  StudyConstants constants{};
  IntegratorOptions integrator;
};
/// Whether its leg has a mass at the toe.
inline bool HasToeMass(const StudyHopper& hopper) {
  return At(hopper.constants, StudyConstant::kToeMass) > 0.0;
}

/// The study's modulus where nothing else is printed [Pa].
inline constexpr double kStudyModulus = 22e9;
/// Height its runs start from where nothing else is printed [m].
inline constexpr double kStudyHeight = 0.3;

/// A run of the hopper without start, stop and torque, its leg set to `leg_angle_rad` and placed
/// from the first lift-off on at the placed share of that (M47).
SimulationRequest RequestOf(const StudyHopper& hopper, double modulus_Pa, double damping_N_s_per_m,
                            double leg_angle_rad);
/// The effect by which it rolls between M7 and M8; none where the blend is 0.
std::vector<EffectSetting> EffectsOf(const StudyHopper& hopper);

}  // namespace hoplab
