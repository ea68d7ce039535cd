#pragma once

#include <cmath>

#include "base/units.h"
#include "experiments/identification/energy_jump.h"
#include "experiments/identification/study_runs.h"
#include "experiments/identification/study_unit.h"

namespace hoplab::testing {

/// A massless hopper that settles in some hops, damped and undamped, and is not that of
/// `experiments/published.yaml`.
inline StudyHopper SomeHopper() {
  StudyHopper hopper;
  hopper.constants = ConstantsAsPrinted();
  const auto set = [&](StudyConstant c, double value) { At(hopper.constants, c) = value; };
  set(StudyConstant::kMass, 0.55);
  set(StudyConstant::kRadius, 0.105);
  set(StudyConstant::kBendingStiffness, 7.5);
  set(StudyConstant::kGain, 6.0);
  set(StudyConstant::kStartSpeed, 1.1);
  set(StudyConstant::kPlacedShare, 0.45);
  return hopper;
}

/// The same with a mass at the toe, 3 % of the body's.
inline StudyHopper SomeHopperWithToe() {
  StudyHopper hopper = SomeHopper();
  At(hopper.constants, StudyConstant::kToeMass) = 0.016;
  At(hopper.constants, StudyConstant::kPlacementRate) = 45.0;
  At(hopper.constants, StudyConstant::kPlacementDamping) = 0.5;
  return hopper;
}

/// The print of another study: what a hopper does by a reading of its times, to one digit more than
/// the study prints. `initial_states` a side of their grid, damped.
inline StudyData TablesOf(const StudyHopper& truth, const ConvergenceReading& reading,
                          int initial_states) {
  const auto rounded = [](double value, double digit) { return std::round(value / digit) * digit; };
  StudyData data;
  for (double deg : {25.0, 30.0, 35.0, 40.0, 45.0}) {
    for (double d : {0.0, 3.0, 6.0}) data.energy.push_back({DegToRad(deg), d, std::nan("")});
  }
  for (EnergyCell& cell : data.energy)
    cell.percent = rounded(EnergyPercent(truth, cell).value_or(std::nan("")), 1e-3);
  RunWants wants = WantsOf({reading});
  wants.stiffness = true;
  for (const double modulus : {21.1e9, 22e9}) {
    ModulusRow row{modulus, 6.0};
    const ControlledRun run = RunControlled(truth, SettingsOf(row), wants);
    row.convergence_time_s = rounded(run.TimeBy(reading).time, 1e-2);
    row.k_min_N_per_m = rounded(run.k_min_N_per_m, 10.0);
    row.k_max_N_per_m = rounded(run.k_max_N_per_m, 10.0);
    data.modulus.push_back(row);
  }
  for (int i = 0; i < initial_states; ++i) {
    for (int j = 0; j < initial_states; ++j) {
      StartCell cell{0.8 + 0.4 * i / (initial_states - 1), 0.2 + 0.2 * j / (initial_states - 1),
                     6.0};
      const ControlledRun run = RunControlled(truth, SettingsOf(cell), wants);
      cell.convergence_time_s = rounded(run.TimeBy(reading).time, 1e-2);
      data.initial_states.push_back(cell);
    }
  }
  return data;
}

}  // namespace hoplab::testing
