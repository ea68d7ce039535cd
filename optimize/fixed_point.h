#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "optimize/return_map.h"

namespace hoplab {

struct FixedPointOptions {
  double tolerance = 1e-11;  // of P(z) - z, SI
  int max_iterations = 60;
  /// Energy over mass [J/kg] at which to look, for a hopper that conserves it; absent: that of the
  /// start.
  std::optional<double> specific_energy;
};

enum class FixedPointStatus {
  kFound,
  kHopFails,     // no hop could be made from the start; `hop.outcome` says why
  kNotConverged  // Newton's method went nowhere
};
std::string_view NameOf(FixedPointStatus status);

/// A steady hop, and how its neighbours behave: P(z) = z, DP and its eigenvalues (the Floquet
/// multipliers, largest modulus first; none where it was not found). What is unknown is NaN.
struct FixedPoint {
  FixedPointStatus status = FixedPointStatus::kNotConverged;
  bool found() const { return status == FixedPointStatus::kFound; }

  SectionState state;
  Hop hop;  // from `state`; of a search that failed, the last hop tried
  double residual = std::numeric_limits<double>::quiet_NaN();
  int iterations = 0;
  /// The hopper conserves energy: one of a family of fixed points, the one at `specific_energy`.
  bool conserves_energy = false;
  double specific_energy = std::numeric_limits<double>::quiet_NaN();  // J/kg

  std::vector<std::complex<double>> multipliers;
  double spectral_radius = std::numeric_limits<double>::quiet_NaN();
  /// All multipliers inside the unit circle: neighbours come back. False for a conserved energy.
  bool stable() const { return found() && spectral_radius < 1.0 && !conserves_energy; }
};

/// Finds the fixed point near `start` by Newton's method with DP from the sensitivities; unstable
/// ones as well. Steps that make the residual larger, or whose hop fails, are halved.
FixedPoint FindFixedPoint(ReturnMap& map, const SectionState& start,
                          const FixedPointOptions& options = {});

/// The same with a second chance: where Newton's method fails from `start`, it starts again from
/// where some hops lead.
FixedPoint SearchFixedPoint(ReturnMap& map, const SectionState& start,
                            const FixedPointOptions& options = {});

/// Total derivative of the spectral radius with respect to a parameter, the fixed point moving
/// along. DP is exact; its derivative comes from differences of DP at moved fixed points, central
/// (one-sided at a physical bound) and extrapolated (Richardson). `error` is what the last
/// extrapolation changed; `levels` steps are extrapolated at most. Both are NaN where the
/// derivative does not exist: two multipliers of the same modulus that are no conjugate pair, or
/// another event sequence next to the fixed point.
inline constexpr int kRadiusLevels = 5;
struct SpectralRadiusRate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double error = std::numeric_limits<double>::quiet_NaN();
};
SpectralRadiusRate DifferentiateSpectralRadius(const ReturnMap& map, const FixedPoint& fixed_point,
                                               const SensitivityDirection& parameter,
                                               int levels = kRadiusLevels);

/// How many hops a start takes into the 1 % band about the steady speed, by the linear map; its
/// state leads with the speed, as an ApexMap's.
struct HopPrediction {
  /// Hops until vx stays in the band, counted in the linear map, all modes together; -1 for a hop
  /// that is not stable.
  int linear_hops = -1;
  /// Amplitude of vx in the slowest mode, over the steady speed: what of the start's deviation
  /// decays with the spectral radius.
  double e0 = std::numeric_limits<double>::quiet_NaN();
  /// ln(0.01/e0)/ln(rho), at least 0: when that amplitude enters the band. It knows neither the
  /// other mode nor the phase of a pair. NaN for a hop that is not stable.
  double hops = std::numeric_limits<double>::quiet_NaN();
};
HopPrediction PredictHops(const FixedPoint& fixed_point, const SectionState& start);

}  // namespace hoplab
