#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "experiments/identification/study_data.h"
#include "model/simulate.h"
#include "optimize/convergence_time.h"

namespace hoplab {

/// One reading of the study's law: what its text leaves open, without numbers.
struct StudyReading {
  ThesisVariant variant;
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
  kToeMass
};
inline constexpr int kStudyConstantCount = 8;
using StudyConstants = std::array<double, kStudyConstantCount>;

struct StudyConstantInfo {
  std::string_view name, unit, sentence;
  double low, high;  // where it is searched
};
const StudyConstantInfo& InfoOf(StudyConstant constant);

inline double& At(StudyConstants& constants, StudyConstant which) {
  return constants[static_cast<std::size_t>(which)];
}
inline double At(const StudyConstants& constants, StudyConstant which) {
  return constants[static_cast<std::size_t>(which)];
}

/// The strip the bending stiffness stands for: with its width taken as 30 mm, thickness [m], second
/// moment [m^4] and area [m^2] at the study's modulus of 22 GPa. G is taken as 4 GPa; axial and
/// shear deformation are below a hundredth of the bending.
struct StudySection {
  double width_m, thickness_m, second_moment_m4, area_m2;
};
StudySection SectionOf(double bending_stiffness_N_m2);

/// Flight placement of a leg with a toe mass, which the study describes without numbers: torque
/// coefficients [N m/rad, N m s/rad] that bring the leg to its angle like a damped oscillator of
/// 60 rad/s, well within a flight of 0.3 s.
struct StudyPlacement {
  double kp_N_m_per_rad, kd_N_m_s_per_rad;
};
StudyPlacement PlacementOf(double toe_mass_kg, double rest_radius_m);

/// The study's hopper: what a run of it needs.
struct StudyHopper {
  StudyReading reading;
  StudyConstants constants{};
  IntegratorOptions integrator;
};

/// Derivatives with respect to the logarithms of the constants.
using StudySlopes = std::array<double, kStudyConstantCount>;

/// Energy left after the jump of a cell of table 6.5, in percent; its slopes from the simulator's
/// sensitivities where `slopes` is given. Nothing where the jump ends in a fall.
std::optional<double> EnergyPercent(const StudyHopper& hopper, const EnergyCell& cell,
                                    StudySlopes* slopes = nullptr);

/// 15 s of controlled hopping (40 deg, v_des 1.8 m/s).
struct ControlledRun {
  Outcome outcome = Outcome::kCompleted;
  double end_time_s = 0.0;
  ConvergenceTime convergence;  // none where the run ended early
  /// Least and greatest chord stiffness over the last five hops [N/m]; NaN without them.
  double k_min_N_per_m, k_max_N_per_m;
};
struct ControlledSettings {
  double modulus_Pa = 22e9, damping_N_s_per_m = 0.0;
  double speed_m_per_s = 1.0, height_m = 0.3;  // of the start
  bool with_stiffness = true;
};
ControlledRun RunControlled(const StudyHopper& hopper, const ControlledSettings& settings);

}  // namespace hoplab
