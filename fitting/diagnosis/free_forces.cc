#include "fitting/diagnosis/free_forces.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/nan.h"
#include "base/random.h"

namespace hoplab {
namespace {

constexpr int kResamples = 200;
constexpr double kForceRankTolerance = 1e-6;
// A bump of which the data see less than this share of what they see of the group's best seen one
// is hardly visited: it would take any size.
constexpr double kHardlySeen = 1e-6;
// Subsets of terms whose BIC differs by less than rounding of their fits say the same.
constexpr double kTie = 1e-4;
constexpr std::array kTermNames = {"1", "s", "s^2", "s^3"};

// Least-squares sizes of a group's columns and their covariance; columns the data do not determine
// are left out.
struct Estimate {
  std::vector<int> seen;  // places within the group
  Eigen::VectorXd size;
  Eigen::MatrixXd covariance;
};

Estimate EstimateGroup(const Linearisation& at, const ProbeGroup& group) {
  Estimate out;
  double most = 0.0;
  for (int k = 0; k < group.count; ++k) most = std::max(most, Information(at, group.first + k));
  for (int k = 0; k < group.count; ++k) {
    if (Information(at, group.first + k) > kHardlySeen * most) out.seen.push_back(k);
  }
  const auto n = static_cast<Eigen::Index>(out.seen.size());
  if (n == 0) return out;
  Eigen::MatrixXd A(at.rows(), n);
  Eigen::VectorXd scale(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    A.col(i) = at.columns.col(group.first + out.seen[static_cast<std::size_t>(i)]);
    scale[i] = A.col(i).norm();
    A.col(i) /= scale[i];
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  Eigen::VectorXd inverse = svd.singularValues();
  for (double& s : inverse) s = s > kForceRankTolerance * svd.singularValues()[0] ? 1.0 / s : 0.0;
  const Eigen::MatrixXd half = svd.matrixV() * inverse.asDiagonal();
  out.size = -(half * (svd.matrixU().transpose() * at.r)).cwiseQuotient(scale);
  out.covariance = half * half.transpose();
  for (Eigen::Index i = 0; i < n; ++i) {
    out.covariance.row(i) /= scale[i];
    out.covariance.col(i) /= scale[i];
  }
  return out;
}

// The best subset of the terms by BIC with its coefficients. All of them are tried: a forward step
// kept a constant it had begun with where the force was linear.
std::array<double, kTermNames.size()> Select(const Eigen::MatrixXd& terms,
                                             const Eigen::VectorXd& values,
                                             const Eigen::MatrixXd& whitener) {
  std::array<double, kTermNames.size()> kept{};
  const Eigen::VectorXd y = whitener * values;
  const Eigen::MatrixXd X = whitener * terms;
  const double price = std::log(static_cast<double>(values.size()));
  double best = y.squaredNorm();
  for (unsigned subset = 1; subset < 1u << kTermNames.size(); ++subset) {
    const int count = std::popcount(subset);
    if (count >= values.size()) continue;
    Eigen::MatrixXd A(X.rows(), count);
    for (unsigned t = 0, c = 0; t < kTermNames.size(); ++t) {
      if (subset >> t & 1u) A.col(c++) = X.col(t);
    }
    const Eigen::VectorXd b = A.colPivHouseholderQr().solve(y);
    const double cost = (y - A * b).squaredNorm() + price * count;
    // Low powers come first: on three bumps s and s^3 are the same, and the simpler one is meant.
    if (!(cost < best - kTie)) continue;
    best = cost;
    kept.fill(0.0);
    for (unsigned t = 0, c = 0; t < kTermNames.size(); ++t) {
      if (subset >> t & 1u) kept[t] = b[c++];
    }
  }
  return kept;
}

std::vector<RegressionTerm> Regress(const ProbeGroup& group, const Estimate& e,
                                    std::uint64_t seed) {
  const Eigen::Index n = e.size.size();
  if (group.against.empty() || n < 3) return {};
  Eigen::MatrixXd terms(n, static_cast<Eigen::Index>(kTermNames.size()));
  for (Eigen::Index i = 0; i < n; ++i) {
    const double s = group.centres[static_cast<std::size_t>(e.seen[static_cast<std::size_t>(i)])];
    terms.row(i) << 1.0, s, s * s, s * s * s;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(e.covariance);
  const double floor = 1e-9 * eigen.eigenvalues().maxCoeff();
  const Eigen::VectorXd root = eigen.eigenvalues().cwiseMax(floor).cwiseSqrt();
  const Eigen::MatrixXd whitener =
      root.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  const auto kept = Select(terms, e.size, whitener);
  std::array<int, kTermNames.size()> counts{};
  RandomStream random(seed, 2);
  Eigen::VectorXd noise(n);
  for (int draw = 0; draw < kResamples; ++draw) {
    for (double& z : noise) z = random.Normal();
    const auto again =
        Select(terms, e.size + eigen.eigenvectors() * root.cwiseProduct(noise), whitener);
    for (std::size_t t = 0; t < counts.size(); ++t) counts[t] += again[t] != 0.0;
  }
  std::vector<RegressionTerm> out;
  for (std::size_t t = 0; t < counts.size(); ++t)
    out.push_back({kTermNames[t], kept[t], static_cast<double>(counts[t]) / kResamples});
  return out;
}

}  // namespace

FreeForces Reconstruct(const Linearisation& at, const ProbeBasis& basis, std::uint64_t seed) {
  FreeForces out;
  for (std::size_t g = 0; g < basis.groups.size(); ++g) {
    const ProbeGroup& group = basis.groups[g];
    ReconstructedForce force;
    force.group = group;
    const Score score = ScoreOf(at, basis.hypotheses[g]);
    if (score.rank == 0) continue;
    force.score = score.score;
    force.p_value = score.p_value;
    const Estimate e = EstimateGroup(at, group);
    for (int k = 0; k < group.count; ++k)
      force.points.push_back({group.centres[static_cast<std::size_t>(k)], kNaN, kNaN});
    for (std::size_t i = 0; i < e.seen.size(); ++i) {
      ForcePoint& point = force.points[static_cast<std::size_t>(e.seen[i])];
      point.value = e.size[static_cast<Eigen::Index>(i)];
      point.band95 = 1.96 * std::sqrt(e.covariance(static_cast<Eigen::Index>(i),
                                                   static_cast<Eigen::Index>(i)));
    }
    force.terms = Regress(group, e, seed);
    out.forces.push_back(std::move(force));
  }
  std::stable_sort(out.forces.begin(), out.forces.end(),
                   [](const ReconstructedForce& a, const ReconstructedForce& b) {
                     if (a.p_value != b.p_value) return a.p_value < b.p_value;
                     return a.score > b.score;  // where both are too small for a number
                   });
  return out;
}

}  // namespace hoplab
