#pragma once

#include <array>

namespace hoplab::bench {

/// RobotSecond in MuJoCo: the same body, motors and clock on legs that are chains of 24 arcs, at
/// the step that such a chain needs.
struct BeamSecond {
  double seconds = 0.0;              // it took [s]
  double step = 0.0;                 // of the engine [s]
  std::array<double, 3> early = {};  // x, y [m] and pitch [rad] at kEarly
};

/// An instant of the second, in the middle of the first stance [s]: later a foot that slides makes
/// the two motions two.
inline constexpr double kEarly = 0.12;

/// Throws std::runtime_error where the engine does not take the model.
BeamSecond RunBeamSecond();

}  // namespace hoplab::bench
