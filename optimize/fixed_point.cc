#include "optimize/fixed_point.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"

namespace hoplab {
namespace {

constexpr double kBand = 0.01;  // of the steady speed
constexpr int kMaxHalvings = 12;

// P(z) - z, with the energy's deviation below it where energy is conserved (P(z) - z alone would
// leave a family of solutions).
struct Residual {
  Eigen::VectorXd value;
  Eigen::MatrixXd jacobian;
};

Residual ResidualAt(const ReturnMap& map, const SectionState& z, const Hop& hop,
                    std::optional<double> energy) {
  const Eigen::Index n = z.size(), rows = energy ? n + 1 : n;
  Residual r{Eigen::VectorXd(rows), Eigen::MatrixXd(rows, n)};
  r.value.head(n) = hop.next - z;
  if (hop.jacobian.size() > 0)
    r.jacobian.topRows(n) = hop.jacobian - Eigen::MatrixXd::Identity(n, n);
  if (energy) {
    r.value[n] = map.SpecificEnergy(z) - *energy;
    r.jacobian.row(n) = map.SpecificEnergyRate(z);
  }
  return r;
}

void AddMultipliers(FixedPoint& point) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(point.hop.jacobian, false);
  point.multipliers.assign(solver.eigenvalues().begin(), solver.eigenvalues().end());
  std::stable_sort(point.multipliers.begin(), point.multipliers.end(),
                   [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  point.spectral_radius = std::abs(point.multipliers[0]);
}

// Derivative of the modulus of the dominant eigenvalue of J in the direction dJ.
double ModulusRate(const Eigen::MatrixXd& J, const Eigen::MatrixXd& dJ) {
  const Eigen::EigenSolver<Eigen::MatrixXd> right(J), left(J.transpose());
  Eigen::Index r = 0, l = 0;
  right.eigenvalues().cwiseAbs().maxCoeff(&r);
  const std::complex<double> lambda = right.eigenvalues()[r];
  // The left eigenvector of the same eigenvalue, not of its conjugate.
  (left.eigenvalues().array() - lambda).abs().minCoeff(&l);
  const Eigen::VectorXcd v = right.eigenvectors().col(r), w = left.eigenvectors().col(l);
  const std::complex<double> rate =
      (w.transpose() * dJ.cast<std::complex<double>>() * v).value() / (w.transpose() * v).value();
  return (std::conj(lambda) * rate).real() / std::abs(lambda);
}

// Moduli so close that no difference step would keep them apart, of two that are no pair.
bool HasKink(const FixedPoint& point) {
  const auto& m = point.multipliers;
  const std::size_t next = m[0].imag() == 0.0 ? 1 : 2;
  return next < m.size() &&
         std::abs(std::abs(m[0]) - std::abs(m[next])) <= 1e-9 * point.spectral_radius;
}

// On which sides of a value differences can be taken: a parameter at its physical bound (damping 0)
// has only one.
enum class StepSide { kBoth, kAbove, kBelow };
StepSide SideOf(const Hopper& hopper, const SensitivityDirection& direction, double value,
                double step) {
  double lower = -std::numeric_limits<double>::infinity(), upper = -lower;
  if (direction.of == SensitivityDirection::Of::kParameter) {
    lower = InfoOf(direction.parameter).lower;
    upper = InfoOf(direction.parameter).upper;
  } else if (direction.of == SensitivityDirection::Of::kEffect) {
    const EffectInfo& info = hopper.effects[direction.index].effect->info;
    lower = info.parameters[direction.component].lower;
    upper = info.parameters[direction.component].upper;
  }
  if (value - step < lower) return StepSide::kAbove;
  return value + step > upper ? StepSide::kBelow : StepSide::kBoth;
}

}  // namespace

std::string_view NameOf(FixedPointStatus status) {
  switch (status) {
    case FixedPointStatus::kFound:
      return "found";
    case FixedPointStatus::kHopFails:
      return "hop_fails";
    case FixedPointStatus::kNotConverged:
      return "not_converged";
  }
  return "";
}

FixedPoint FindFixedPoint(ReturnMap& map, const SectionState& start,
                          const FixedPointOptions& options) {
  FixedPoint point;
  point.state = start;
  point.hop = map.Differentiate(start);
  if (!point.hop.ok()) {
    point.status = FixedPointStatus::kHopFails;
    return point;
  }
  point.conserves_energy = map.ConservesEnergy(start);
  point.specific_energy = map.SpecificEnergy(start);
  std::optional<double> energy;
  if (point.conserves_energy) {
    energy = options.specific_energy.value_or(point.specific_energy);
    point.specific_energy = *energy;
  }
  Residual residual = ResidualAt(map, point.state, point.hop, energy);
  for (; point.iterations < options.max_iterations; ++point.iterations) {
    point.residual = residual.value.norm();
    if (point.residual <= options.tolerance) {
      point.status = FixedPointStatus::kFound;
      AddMultipliers(point);
      return point;
    }
    const Eigen::VectorXd step =
        -residual.jacobian.completeOrthogonalDecomposition().solve(residual.value);
    double length = 1.0;
    bool accepted = false;
    for (int halving = 0; halving < kMaxHalvings && !accepted; ++halving, length *= 0.5) {
      const SectionState trial = point.state + length * step;
      // Most full steps are taken; of shorter ones the hop alone tells.
      if (halving > 0) {
        const Hop tried = map.Apply(trial);
        if (!tried.ok() || !(ResidualAt(map, trial, tried, energy).value.norm() < point.residual))
          continue;
      }
      const Hop hop = map.Differentiate(trial);
      if (!hop.ok()) continue;
      Residual next = ResidualAt(map, trial, hop, energy);
      if (!(next.value.norm() < point.residual)) continue;
      accepted = true;
      point.state = trial;
      point.hop = hop;
      residual = std::move(next);
    }
    if (!accepted) break;
  }
  // Rounding may keep the last digit of the tolerance out of reach.
  if (point.residual <= 100.0 * options.tolerance) {
    point.status = FixedPointStatus::kFound;
    AddMultipliers(point);
  }
  return point;
}

FixedPoint SearchFixedPoint(ReturnMap& map, const SectionState& start,
                            const FixedPointOptions& options) {
  FixedPoint first = FindFixedPoint(map, start, options);
  if (first.found()) return first;
  SectionState state = start;
  int made = 0;
  for (const int hops : {1, 3, 10, 30, 100}) {
    for (; made < hops; ++made) {
      const Hop hop = map.Apply(state);
      if (!hop.ok()) return first;
      state = hop.next;
    }
    const FixedPoint later = FindFixedPoint(map, state, options);
    if (later.found()) return later;
  }
  return first;
}

SpectralRadiusRate DifferentiateSpectralRadius(const ReturnMap& map, const FixedPoint& fixed_point,
                                               const SensitivityDirection& parameter, int levels) {
  constexpr double kFirstStep = 0.008;  // of the parameter's scale
  HOPLAB_CHECK(levels <= kRadiusLevels);
  SpectralRadiusRate rate;
  if (!fixed_point.found() || HasKink(fixed_point)) return rate;
  const std::unique_ptr<ReturnMap> moving = map.Clone();
  const Hopper& hopper = map.hopper();
  const double value = ValueOf(hopper, parameter);
  const double scale = ScaleOf(hopper, parameter);
  FixedPointOptions options;
  if (fixed_point.conserves_energy) options.specific_energy = fixed_point.specific_energy;

  // DP at the fixed point of p + h; false if it is gone or lies on another branch.
  const auto jacobian_at = [&](double h, Eigen::MatrixXd& J) {
    SetValue(moving->hopper(), parameter, value + h);
    const FixedPoint moved = FindFixedPoint(*moving, fixed_point.state, options);
    J = moved.hop.jacobian;
    return moved.found() && moved.hop.events == fixed_point.hop.events &&
           moved.conserves_energy == fixed_point.conserves_energy;
  };
  const StepSide side = SideOf(hopper, parameter, value, kFirstStep * scale);
  const Eigen::MatrixXd here = fixed_point.hop.jacobian;
  // One difference of step h; false if it leaves the branch.
  const auto difference = [&](double h, Eigen::MatrixXd& out) {
    Eigen::MatrixXd up = here, down = here;
    if (side != StepSide::kBelow && !jacobian_at(h, up)) return false;
    if (side != StepSide::kAbove && !jacobian_at(-h, down)) return false;
    out = (up - down) / (side == StepSide::kBoth ? 2.0 * h : h);
    return true;
  };
  // The error of a central difference is even in h, that of a one-sided one is not.
  const double ratio = side == StepSide::kBoth ? 4.0 : 2.0;
  double best_change = std::numeric_limits<double>::infinity();
  std::array<std::array<Eigen::MatrixXd, kRadiusLevels>, kRadiusLevels> table;
  int rows = 0;  // of consecutive steps that stayed on the branch
  double h = kFirstStep * scale;
  for (int level = 0; level < levels + 3 && rows < levels; ++level, h *= 0.5) {
    if (!difference(h, table[rows][0])) {
      rows = 0;
      continue;
    }
    const int i = rows++;
    double power = 1.0;
    for (int j = 1; j <= i; ++j) {
      power *= ratio;
      table[i][j] = table[i][j - 1] + (table[i][j - 1] - table[i - 1][j - 1]) / (power - 1.0);
      const double change = std::max((table[i][j] - table[i][j - 1]).norm(),
                                     (table[i][j] - table[i - 1][j - 1]).norm());
      if (change >= best_change) continue;
      best_change = change;
      rate.value = ModulusRate(here, table[i][j]);
      rate.error = std::abs(ModulusRate(here, table[i][j] - table[i - 1][j - 1]));
    }
  }
  return rate;
}

HopPrediction PredictHops(const FixedPoint& fixed_point, const SectionState& start) {
  HopPrediction prediction;
  const double speed = fixed_point.found() ? std::abs(fixed_point.state[0]) : 0.0;
  if (speed == 0.0) return prediction;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(fixed_point.hop.jacobian);
  const Eigen::VectorXd deviation = start - fixed_point.state;
  const Eigen::VectorXcd share =
      solver.eigenvectors().partialPivLu().solve(deviation.cast<std::complex<double>>());
  Eigen::Index slow = 0;
  solver.eigenvalues().cwiseAbs().maxCoeff(&slow);
  const bool pair = solver.eigenvalues()[slow].imag() != 0.0;
  prediction.e0 =
      (pair ? 2.0 : 1.0) * std::abs(share[slow] * solver.eigenvectors()(0, slow)) / speed;
  if (!fixed_point.stable()) return prediction;
  prediction.hops = prediction.e0 <= kBand
                        ? 0.0
                        : std::log(kBand / prediction.e0) / std::log(fixed_point.spectral_radius);

  // Last hop outside the band, in a number of hops after which nothing is.
  constexpr int kMaxHops = 100000;
  const int enough = std::min(kMaxHops, 20 + static_cast<int>(2.0 * prediction.hops));
  Eigen::VectorXd z = deviation;
  prediction.linear_hops = 0;
  for (int hop = 0; hop <= enough; ++hop, z = fixed_point.hop.jacobian * z) {
    if (std::abs(z[0]) > kBand * speed) prediction.linear_hops = hop + 1;
  }
  return prediction;
}

}  // namespace hoplab
