#include "optimize/continuation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

using Eigen::Vector3d;

// Below these an event is called nearly grazing: a guard crossed at less than one of its scales per
// second (a tenth of what a usual hop has), or missed by half a percent of its scale.
constexpr double kSlowCrossing = 1.0;  // 1/s
constexpr double kNearMiss = 0.005;
constexpr double kShortestStep = 1e-5;

// Coordinates along a branch: apex state and parameter over their sizes.
class Follower {
 public:
  Follower(const Hopper& hopper, const FixedPoint& start, const SensitivityDirection& parameter,
           const ContinuationOptions& options)
      : map_(hopper), start_(start), parameter_(parameter), options_(options) {
    size_ << std::max(std::abs(start.state[0]), 0.1), start.state[1], options.high - options.low;
  }

  // Points beyond the first one, that one left out; what ended them.
  std::vector<BranchPoint> Follow(double sense, BranchEnd& end, Outcome& outcome) {
    std::vector<BranchPoint> points;
    Vector3d u = Coordinates(start_.state, ValueOf(map_.hopper(), parameter_));
    Vector3d tangent = TangentAt(u);
    if (tangent[2] * sense < 0.0) tangent = -tangent;
    double step = options_.first_step;
    for (;;) {
      if (options_.stop && *options_.stop) return Ended(end, BranchEnd::kStopped, points);
      if (static_cast<int>(points.size()) >= options_.max_points)
        return Ended(end, BranchEnd::kPointLimit, points);
      Vector3d next = u + step * tangent;
      FixedPoint found;
      int iterations = 0;
      if (!Correct(tangent, next, found, iterations)) {
        step *= 0.5;
        if (step >= kShortestStep) continue;
        outcome = found.hop.outcome;
        return Ended(end, found.hop.ok() ? BranchEnd::kNotConverged : BranchEnd::kHopFails, points);
      }
      if (Parameter(next) < options_.low || Parameter(next) > options_.high) {
        LastPoint(next[2] > u[2] ? options_.high : options_.low, found.state, points);
        return Ended(end, BranchEnd::kRange, points);
      }
      const Vector3d new_tangent = TangentAt(next);
      u = next;
      tangent = new_tangent.dot(tangent) < 0.0 ? Vector3d(-new_tangent) : new_tangent;
      points.push_back({.parameter = Parameter(u), .fixed_point = found});
      step = std::min(iterations <= 3 ? 1.4 * step : step, options_.max_step);
    }
  }

 private:
  static std::vector<BranchPoint> Ended(BranchEnd& end, BranchEnd why,
                                        std::vector<BranchPoint>& points) {
    end = why;
    return std::move(points);
  }

  Vector3d Coordinates(const ApexState& z, double p) const {
    return {z[0] / size_[0], z[1] / size_[1], (p - options_.low) / size_[2]};
  }
  double Parameter(const Vector3d& u) const { return options_.low + u[2] * size_[2]; }
  ApexState State(const Vector3d& u) const { return {u[0] * size_[0], u[1] * size_[1]}; }

  // P(z; p) - z and its derivative by u; false if the hop fails.
  bool Evaluate(const Vector3d& u, Eigen::VectorXd& value, Eigen::MatrixXd& rate, Hop& hop) {
    SetValue(map_.hopper(), parameter_, Parameter(u));
    const ApexState z = State(u);
    hop = map_.Differentiate(z, {&parameter_, 1});
    if (!hop.ok()) return false;
    const int rows = start_.conserves_energy ? 3 : 2;
    value.resize(rows);
    rate.resize(rows, 3);
    value.head<2>() = hop.next - z;
    rate.topLeftCorner<2, 2>() = hop.jacobian - Eigen::Matrix2d::Identity();
    rate.block<2, 1>(0, 2) = hop.by_parameter;
    if (rows == 3) {
      value[2] = map_.SpecificEnergy(z) - start_.specific_energy;
      rate.row(2) << map_.SpecificEnergyRate(z), EnergyRateByParameter(z, Parameter(u));
    }
    rate = rate * size_.asDiagonal();
    return true;
  }

  double EnergyRateByParameter(const ApexState& z, double p) {
    const double h = 1e-3 * size_[2];
    const auto at = [&](double value) {
      SetValue(map_.hopper(), parameter_, value);
      return map_.SpecificEnergy(z);
    };
    const double rate = (at(p + h) - at(p - h)) / (2.0 * h);
    SetValue(map_.hopper(), parameter_, p);
    return rate;
  }

  Vector3d TangentAt(const Vector3d& u) {
    Eigen::VectorXd value;
    Eigen::MatrixXd rate;
    Hop hop;
    if (!Evaluate(u, value, rate, hop)) return Vector3d::UnitZ();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rate, Eigen::ComputeFullV);
    return svd.matrixV().col(2);
  }

  // Newton's method in the plane through `u` across the tangent.
  bool Correct(const Vector3d& tangent, Vector3d& u, FixedPoint& found, int& iterations) {
    constexpr int kMaxIterations = 12;
    const Vector3d predicted = u;
    Eigen::VectorXd value;
    Eigen::MatrixXd rate;
    for (iterations = 0; iterations < kMaxIterations; ++iterations) {
      if (!Evaluate(u, value, rate, found.hop)) return false;
      if (value.norm() <= options_.fixed_point.tolerance) {
        const FixedPoint polished = FindFixedPoint(map_, State(u), EnergyKept());
        if (!polished.found() || (polished.state - State(u)).norm() > 1e-6) return false;
        found = polished;
        return true;
      }
      Eigen::MatrixXd system(rate.rows() + 1, 3);
      system << rate, tangent.transpose();
      Eigen::VectorXd right(rate.rows() + 1);
      right << -value, -tangent.dot(u - predicted);
      const Vector3d step = system.completeOrthogonalDecomposition().solve(right);
      if (!(step.norm() < 0.5)) return false;
      u += step;
    }
    return false;
  }

  FixedPointOptions EnergyKept() const {
    FixedPointOptions options = options_.fixed_point;
    if (start_.conserves_energy) options.specific_energy = start_.specific_energy;
    return options;
  }

  void LastPoint(double p, const ApexState& near, std::vector<BranchPoint>& points) {
    SetValue(map_.hopper(), parameter_, p);
    const FixedPoint found = FindFixedPoint(map_, near, EnergyKept());
    if (found.found()) points.push_back({.parameter = p, .fixed_point = found});
  }

  ReturnMap map_;
  const FixedPoint& start_;
  SensitivityDirection parameter_;
  ContinuationOptions options_;
  Vector3d size_;
};

// Eigenvalue tests that are zero at a bifurcation: of +1, -1, and a pair on the unit circle.
std::array<double, 3> Tests(const FixedPoint& point) {
  const double trace = point.hop.jacobian.trace();
  const double determinant = point.hop.jacobian.determinant();
  const bool pair = point.multipliers[0].imag() != 0.0;
  return {1.0 - trace + determinant, 1.0 + trace + determinant,
          pair ? determinant - 1.0 : std::numeric_limits<double>::quiet_NaN()};
}

void AddBifurcations(Branch& branch) {
  constexpr std::array kKinds = {BifurcationKind::kFold, BifurcationKind::kFlip,
                                 BifurcationKind::kTorus};
  for (std::size_t i = 1; i < branch.points.size(); ++i) {
    const BranchPoint &a = branch.points[i - 1], &b = branch.points[i];
    if (a.fixed_point.conserves_energy || b.sequence_changed) continue;
    const std::array before = Tests(a.fixed_point), after = Tests(b.fixed_point);
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
      if (!(before[k] * after[k] < 0.0)) continue;
      const double share = before[k] / (before[k] - after[k]);
      branch.bifurcations.push_back({kKinds[k], a.parameter + share * (b.parameter - a.parameter)});
    }
  }
}

}  // namespace

std::string_view NameOf(BifurcationKind kind) {
  switch (kind) {
    case BifurcationKind::kFold:
      return "fold";
    case BifurcationKind::kFlip:
      return "flip";
    case BifurcationKind::kTorus:
      return "torus";
  }
  return "";
}

std::string_view NameOf(BranchEnd end) {
  switch (end) {
    case BranchEnd::kRange:
      return "range";
    case BranchEnd::kHopFails:
      return "hop_fails";
    case BranchEnd::kNotConverged:
      return "not_converged";
    case BranchEnd::kPointLimit:
      return "point_limit";
    case BranchEnd::kStopped:
      return "stopped";
  }
  return "";
}

Branch FollowFixedPoint(const Hopper& hopper, const FixedPoint& start,
                        const SensitivityDirection& parameter, const ContinuationOptions& options) {
  Branch branch;
  if (!start.found()) return branch;
  Follower follower(hopper, start, parameter, options);
  std::vector<BranchPoint> down = follower.Follow(-1.0, branch.first_end, branch.first_outcome);
  Follower other(hopper, start, parameter, options);
  std::vector<BranchPoint> up = other.Follow(1.0, branch.last_end, branch.last_outcome);
  branch.points.assign(std::make_move_iterator(down.rbegin()),
                       std::make_move_iterator(down.rend()));
  branch.points.push_back({.parameter = ValueOf(hopper, parameter), .fixed_point = start});
  branch.points.insert(branch.points.end(), up.begin(), up.end());
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    BranchPoint& point = branch.points[i];
    const Hop& hop = point.fixed_point.hop;
    point.near_grazing =
        hop.simultaneous || hop.least_crossing_rate < kSlowCrossing || hop.nearest_miss < kNearMiss;
    point.sequence_changed = i > 0 && hop.events != branch.points[i - 1].fixed_point.hop.events;
  }
  AddBifurcations(branch);
  return branch;
}

}  // namespace hoplab
