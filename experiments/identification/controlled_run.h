#pragma once

#include <limits>
#include <optional>

#include "experiments/identification/study_model.h"

namespace hoplab {

struct ControlledSettings {
  double modulus_Pa = kStudyModulus, damping_N_s_per_m = 0.0;
  double speed_m_per_s = 1.0, height_m = kStudyHeight;  // of the start
};

/// What of a controlled run is looked at besides its speeds.
struct RunWants {
  bool stiffness = false;
  bool instants = false;     // speeds in stance and flight
  bool fixed_speed = false;  // the speed of the steady hop itself
};

/// 15 s of controlled hopping (40 deg), or what of it a steady hop predicts.
struct ControlledRun {
  Outcome outcome = Outcome::kCompleted;
  double end_time_s = 0.0;
  SpeedHistory speeds;
  double fixed_speed_m_per_s = std::numeric_limits<double>::quiet_NaN();
  /// Least and greatest chord stiffness over the last five hops [N/m]; NaN without them.
  double k_min_N_per_m = std::numeric_limits<double>::quiet_NaN();
  double k_max_N_per_m = std::numeric_limits<double>::quiet_NaN();

  ConvergenceTime TimeBy(const ConvergenceReading& reading) const {
    return IsComplete(outcome) ? ConvergenceTimeOf(speeds, reading, fixed_speed_m_per_s)
                               : ConvergenceTime{};
  }
};

/// Length of the study's controlled runs [s].
inline constexpr double kControlledTime = 15.0;

/// The controlled run before it is run.
SimulationRequest ControlledRequest(const StudyHopper& hopper, const ControlledSettings& settings);

ControlledRun RunControlled(const StudyHopper& hopper, const ControlledSettings& settings,
                            const RunWants& wants = {});

/// Least and greatest chord stiffness over `hops` hops from the apex (vx, y), placed as after a
/// lift-off; of a massless leg. Nothing where they cannot be made.
struct StiffnessRangeOfHops {
  double low, high;
};
std::optional<StiffnessRangeOfHops> StiffnessFromApex(SimulationRequest request, double vx,
                                                      double y, int hops);

}  // namespace hoplab
