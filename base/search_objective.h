#pragma once

#include <array>
#include <string_view>

namespace hoplab {

/// What a search makes smallest, or of a speed greatest; scenarios and the search share them.
enum class SearchObjective {
  kConvergenceTime,  // M23 [s]: a staircase
  kSpectralRadius,   // of the fixed point that hopping leads to: smooth but for kinks
  kWeighted,         // (1 - weight) time/horizon + weight rho
  // Of the steady stride of a robot, which must be stable:
  kSpeed,            // greatest [m/s]
  kCostOfTransport,  // energy over weight and way
  kPeakTorque        // of any motor [N m]
};
inline constexpr std::array kSearchObjectives = {
    SearchObjective::kConvergenceTime, SearchObjective::kSpectralRadius,
    SearchObjective::kWeighted,        SearchObjective::kSpeed,
    SearchObjective::kCostOfTransport, SearchObjective::kPeakTorque};
/// "convergence_time", "spectral_radius", "weighted", "speed", "cost_of_transport", "peak_torque".
std::string_view NameOf(SearchObjective objective);

}  // namespace hoplab
