#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "experiments/scenario_hopper.h"
#include "experiments/study/convergence_reading.h"

namespace hoplab {

/// The study as a set of runs: its constants (mass, radius, section, gain, law, all that no caption
/// states), which the settings of a caption are set over. The start of `constants` is that of table
/// 6.5, the only one whose speed is not printed.
struct Study {
  Scenario constants;
  IntegratorOptions integrator;
  /// Whether a run's first landing is placed as well, and not at the caption's angle.
  bool places_first_landing = false;

  /// Leg angle of a landing the leg is placed for, over the one of the caption: that of
  /// `touchdown_angle_deg` over `start_angle_deg` of the constants (M47); 1 without the latter.
  double PlacedShare() const;
};

/// Throws InputError for a scenario that cannot stand for the study: no half-circular leg, no
/// start, no speed controller.
Study StudyOfScenario(const Scenario& scenario, const IntegratorOptions& integrator);

/// A straight leg in place of the half-circular one (thesis 6.3.4).
struct StraightSpringLeg {
  double stiffness_N_per_m;
  double rest_length_m;
  /// From the vertical. By default half the leg angle of the caption: the chord of a half-circular
  /// leg stands at that, so that both have the same virtual leg.
  std::optional<double> touchdown_angle_rad = std::nullopt;
};

/// What a caption states; SI, radians.
struct CaptionSettings {
  double start_height_m = 0.3;
  double start_speed_m_per_s = 1.0;
  double touchdown_angle_rad = 0.0;
  double damping_N_s_per_m = 0.0;
  double modulus_Pa = 22e9;
  bool controlled = false;  // to v_des_m_per_s, with the gain of the constants
  double v_des_m_per_s = 1.8;
  double time_limit_s = 15.0;
  std::optional<int> hops;  // 1: a single jump, to its apex
  std::optional<StraightSpringLeg> straight;
};

/// The study under another law. What else a scenario may say about the reading of the study's own
/// law is left behind: it means nothing there.
Study WithLaw(const Study& study, Law law);

/// The hopper of a caption. Throws InputError for constants that cannot be run.
Hopper HopperOfCaption(const Study& study, const CaptionSettings& settings);

/// One instant of a run. Stiffness is NaN in flight; energy is that of the body, kinetic and
/// potential, without what the leg holds, as the study plots it.
struct HoppingSample {
  double time_s;
  double x_m, y_m, vx_m_per_s;
  double energy_J;
  double leg_angle_rad, leg_length_m;
  double stiffness_N_per_m;
  bool in_contact;
};

struct ApexPoint {
  double time_s, x_m, height_m, speed_m_per_s, energy_J;
};

/// A run with what the study looks at.
struct HoppingRun {
  Outcome outcome = Outcome::kCompleted;
  double end_time_s = 0.0;
  double final_speed_m_per_s = std::numeric_limits<double>::quiet_NaN();
  int hops = 0;
  std::vector<ApexPoint> apexes;  // the start, an apex at no vertical speed, is the first
  SpeedHistory speeds;
  std::vector<HoppingSample> samples;

  bool fell() const;
};

/// Samples every `sample_step_s`; none if that is 0.
HoppingRun RunHopping(const Hopper& hopper, double sample_step_s);

/// Convergence time of the run as the study's tables are read (M48); none where it did not reach
/// its time limit.
ConvergenceTime ConvergenceOf(const HoppingRun& run);

/// Least and greatest stiffness over the last five hops [N/m]: the steady state of M23. NaN without
/// five hops.
struct StiffnessRange {
  double min_N_per_m, max_N_per_m;
};
StiffnessRange SteadyStiffness(const HoppingRun& run);

/// The stretches of samples in contact, each as a range of indices [begin, end).
struct StanceRange {
  std::size_t begin, end;
};
std::vector<StanceRange> StancesOf(const HoppingRun& run);

/// The straight leg that stands for a half-circular one: means over time of the stiffness and chord
/// length while it is on the ground. NaN for a run without stance.
StraightSpringLeg MeanLeg(const HoppingRun& run);

}  // namespace hoplab
