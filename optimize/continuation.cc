#include "optimize/continuation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace hoplab {
namespace {

// Below these an event is called nearly grazing: a guard crossed at less than one of its scales per
// second (a tenth of what a usual hop has), or missed by half a percent of its scale.
constexpr double kSlowCrossing = 1.0;  // 1/s
constexpr double kNearMiss = 0.005;
constexpr double kShortestStep = 1e-5;
// How far a point may lie from where the tangent leads, in steps. Smooth branches stay within a
// tenth of one and bends within one; a point farther off is another branch's.
constexpr double kFarthest = 1.0;

// Coordinates along a branch: the section's state and the parameter, over their sizes.
class Follower {
 public:
  Follower(const ReturnMap& map, const FixedPoint& start, const SensitivityDirection& parameter,
           const ContinuationOptions& options)
      : map_(map.Clone()),
        start_(start),
        parameter_(parameter),
        options_(options),
        n_(start.state.size()),
        size_(n_ + 1) {
    const std::vector<SectionComponent> components = map.Components(start.state);
    for (Eigen::Index i = 0; i < n_; ++i) size_[i] = components[static_cast<std::size_t>(i)].size;
    size_[n_] = options.high - options.low;
  }

  // Points beyond the first one, that one left out; what ended them.
  std::vector<BranchPoint> Follow(double sense, BranchEnd& end, Outcome& outcome) {
    std::vector<BranchPoint> points;
    Eigen::VectorXd u = Coordinates(start_.state, ValueOf(map_->hopper(), parameter_));
    Eigen::VectorXd tangent = TangentAt(u);
    if (tangent[n_] * sense < 0.0) tangent = -tangent;
    double step = options_.first_step;
    for (;;) {
      if (options_.stop && *options_.stop) return Ended(end, BranchEnd::kStopped, points);
      if (static_cast<int>(points.size()) >= options_.max_points)
        return Ended(end, BranchEnd::kPointLimit, points);
      const Eigen::VectorXd predicted = u + step * tangent;
      Eigen::VectorXd next = predicted;
      FixedPoint found;
      int iterations = 0;
      const bool corrected = Correct(tangent, next, found, iterations);
      const bool lost = corrected && (next - predicted).norm() > kFarthest * step;
      if (!corrected || lost) {
        step *= 0.5;
        if (step >= kShortestStep) continue;
        outcome = found.hop.outcome;
        return Ended(end,
                     lost             ? BranchEnd::kLost
                     : found.hop.ok() ? BranchEnd::kNotConverged
                                      : BranchEnd::kHopFails,
                     points);
      }
      if (Parameter(next) < options_.low || Parameter(next) > options_.high)
        return Ended(end, LastPoint(u, next, points), points);
      const Eigen::VectorXd new_tangent = TangentAt(next);
      u = next;
      tangent = new_tangent.dot(tangent) < 0.0 ? Eigen::VectorXd(-new_tangent) : new_tangent;
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

  Eigen::VectorXd Coordinates(const SectionState& z, double p) const {
    Eigen::VectorXd u(n_ + 1);
    u << z.cwiseQuotient(size_.head(n_)), (p - options_.low) / size_[n_];
    return u;
  }
  double Parameter(const Eigen::VectorXd& u) const { return options_.low + u[n_] * size_[n_]; }
  SectionState State(const Eigen::VectorXd& u) const {
    return u.head(n_).cwiseProduct(size_.head(n_));
  }

  // P(z; p) - z and its derivative by u; false if the hop fails.
  bool Evaluate(const Eigen::VectorXd& u, Eigen::VectorXd& value, Eigen::MatrixXd& rate, Hop& hop) {
    SetValue(map_->hopper(), parameter_, Parameter(u));
    const SectionState z = State(u);
    hop = map_->Differentiate(z, {&parameter_, 1});
    if (!hop.ok()) return false;
    const Eigen::Index rows = start_.conserves_energy ? n_ + 1 : n_;
    value.resize(rows);
    rate.resize(rows, n_ + 1);
    value.head(n_) = hop.next - z;
    rate.topLeftCorner(n_, n_) = hop.jacobian - Eigen::MatrixXd::Identity(n_, n_);
    rate.block(0, n_, n_, 1) = hop.by_parameter;
    if (rows > n_) {
      value[n_] = map_->SpecificEnergy(z) - start_.specific_energy;
      rate.row(n_) << map_->SpecificEnergyRate(z), EnergyRateByParameter(z, Parameter(u));
    }
    rate = rate * size_.asDiagonal();
    return true;
  }

  double EnergyRateByParameter(const SectionState& z, double p) {
    const double h = 1e-3 * size_[n_];
    const auto at = [&](double value) {
      SetValue(map_->hopper(), parameter_, value);
      return map_->SpecificEnergy(z);
    };
    const double rate = (at(p + h) - at(p - h)) / (2.0 * h);
    SetValue(map_->hopper(), parameter_, p);
    return rate;
  }

  Eigen::VectorXd TangentAt(const Eigen::VectorXd& u) {
    Eigen::VectorXd value;
    Eigen::MatrixXd rate;
    Hop hop;
    if (!Evaluate(u, value, rate, hop)) return Eigen::VectorXd::Unit(n_ + 1, n_);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rate, Eigen::ComputeFullV);
    return svd.matrixV().col(n_);
  }

  // Newton's method in the plane through `u` across the tangent.
  bool Correct(const Eigen::VectorXd& tangent, Eigen::VectorXd& u, FixedPoint& found,
               int& iterations) {
    constexpr int kMaxIterations = 12;
    const Eigen::VectorXd predicted = u;
    Eigen::VectorXd value;
    Eigen::MatrixXd rate;
    for (iterations = 0; iterations < kMaxIterations; ++iterations) {
      if (!Evaluate(u, value, rate, found.hop)) return false;
      if (value.norm() <= options_.fixed_point.tolerance) {
        const FixedPoint polished = FindFixedPoint(*map_, State(u), EnergyKept());
        if (!polished.found() || (polished.state - State(u)).norm() > 1e-6) return false;
        found = polished;
        return true;
      }
      Eigen::MatrixXd system(rate.rows() + 1, n_ + 1);
      system << rate, tangent.transpose();
      Eigen::VectorXd right(rate.rows() + 1);
      right << -value, -tangent.dot(u - predicted);
      const Eigen::VectorXd step = system.completeOrthogonalDecomposition().solve(right);
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

  // The point between `u` and `next` at the end of the range that they pass.
  BranchEnd LastPoint(const Eigen::VectorXd& u, const Eigen::VectorXd& next,
                      std::vector<BranchPoint>& points) {
    const double p = next[n_] > u[n_] ? options_.high : options_.low;
    const double share = (p - Parameter(u)) / (Parameter(next) - Parameter(u));
    const Eigen::VectorXd between = u + share * (next - u);
    SetValue(map_->hopper(), parameter_, p);
    const FixedPoint found = FindFixedPoint(*map_, State(between), EnergyKept());
    if (!found.found()) return BranchEnd::kNotConverged;
    const double off = (Coordinates(found.state, p) - between).norm();
    if (off > kFarthest * (next - u).norm()) return BranchEnd::kLost;
    points.push_back({.parameter = p, .fixed_point = found});
    return BranchEnd::kRange;
  }

  std::unique_ptr<ReturnMap> map_;
  const FixedPoint& start_;
  SensitivityDirection parameter_;
  ContinuationOptions options_;
  Eigen::Index n_;        // of the section's state
  Eigen::VectorXd size_;  // of it and the parameter
};

// det(1 - DP) or det(1 + DP) but for its positive factors, those of pairs: it changes its sign
// where a real multiplier passes +1 or -1.
double RealTest(const FixedPoint& point, double passes) {
  double product = 1.0;
  for (const std::complex<double>& m : point.multipliers)
    if (m.imag() == 0.0) product *= 1.0 - passes * m.real();
  return product;
}

int CountOutside(const FixedPoint& point) {
  return static_cast<int>(std::count_if(point.multipliers.begin(), point.multipliers.end(),
                                        [](const auto& m) { return std::abs(m) > 1.0; }));
}

double Crossing(double before, double after) { return before / (before - after); }

// Where between two points stability changes, as a share of the way.
void AddBetween(const BranchPoint& a, const BranchPoint& b, std::vector<Bifurcation>& list) {
  const auto add = [&](BifurcationKind kind, double share) {
    list.push_back({kind, a.parameter + share * (b.parameter - a.parameter)});
  };
  bool real = false;
  for (const auto& [kind, passes] :
       {std::pair(BifurcationKind::kFold, 1.0), std::pair(BifurcationKind::kFlip, -1.0)}) {
    const double before = RealTest(a.fixed_point, passes), after = RealTest(b.fixed_point, passes);
    if (!(before * after < 0.0)) continue;
    real = true;
    add(kind, Crossing(before, after));
  }
  // Multipliers are sorted: the pair that leaves is the last one that is outside, or was.
  const int most = std::max(CountOutside(a.fixed_point), CountOutside(b.fixed_point));
  const int least = std::min(CountOutside(a.fixed_point), CountOutside(b.fixed_point));
  if (real || most - least != 2) return;
  const auto excess = [&](const BranchPoint& point) {
    return std::abs(point.fixed_point.multipliers[static_cast<std::size_t>(most) - 1]) - 1.0;
  };
  add(BifurcationKind::kTorus, Crossing(excess(a), excess(b)));
}

void AddBifurcations(Branch& branch) {
  for (std::size_t i = 1; i < branch.points.size(); ++i) {
    const BranchPoint &a = branch.points[i - 1], &b = branch.points[i];
    if (a.fixed_point.conserves_energy || b.sequence_changed) continue;
    AddBetween(a, b, branch.bifurcations);
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
    case BranchEnd::kLost:
      return "branch_lost";
    case BranchEnd::kPointLimit:
      return "point_limit";
    case BranchEnd::kStopped:
      return "stopped";
  }
  return "";
}

Branch FollowFixedPoint(const ReturnMap& map, const FixedPoint& start,
                        const SensitivityDirection& parameter, const ContinuationOptions& options) {
  Branch branch;
  if (!start.found()) return branch;
  Follower follower(map, start, parameter, options);
  std::vector<BranchPoint> down = follower.Follow(-1.0, branch.first_end, branch.first_outcome);
  Follower other(map, start, parameter, options);
  std::vector<BranchPoint> up = other.Follow(1.0, branch.last_end, branch.last_outcome);
  branch.points.assign(std::make_move_iterator(down.rbegin()),
                       std::make_move_iterator(down.rend()));
  branch.points.push_back({.parameter = ValueOf(map.hopper(), parameter), .fixed_point = start});
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
