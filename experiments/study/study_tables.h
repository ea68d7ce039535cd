#pragma once

#include "experiments/study/study_result.h"

namespace hoplab {

/// Convergence time over 25 initial states (tables 6.1, d = 0, and 6.2, d = 6).
struct StartGrid {
  std::vector<double> speeds, heights;             // a cell each, as the published table has them
  std::vector<double> published_time, time;        // NaN: no convergence
  std::vector<double> band_percent, steady_speed;  // 1 or 2; NaN
};
StartGrid RunStartGrid(const Study& study, double damping_N_s_per_m);
StudyTable StartTable(const std::string& name, const Study& study, double damping_N_s_per_m);

/// Convergence time and range of stiffness at the steady state over Young's modulus (tables 6.3, d
/// = 0, and 6.4, d = 6).
struct ModulusSweep {
  std::vector<double> modulus_GPa;
  std::vector<double> published_time, published_min, published_max;
  std::vector<double> time, stiffness_min, stiffness_max;
};
ModulusSweep RunModulusSweep(const Study& study, double damping_N_s_per_m);
StudyTable ModulusTable(const std::string& name, const Study& study, double damping_N_s_per_m);

/// Energy after a single jump without torque, in percent of that before, over touch-down angle and
/// damping (table 6.5). The start is that of the study's constants.
struct EnergyGrid {
  std::vector<double> angle_deg, damping, published_percent, percent;
};
EnergyGrid RunEnergyGrid(const Study& study);
StudyTable EnergyTable(const Study& study);

/// Percent of the energy that a single undriven jump leaves; NaN where there is no next apex.
double EnergyPercent(const Study& study, double touchdown_angle_rad, double damping_N_s_per_m);

}  // namespace hoplab
