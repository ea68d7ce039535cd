#include "fitting/diagnosis/score.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>

#include "base/nan.h"
#include "base/random.h"

namespace hoplab {
namespace {

constexpr int kDraws = 4000;
// Singular values of a hypothesis' normalised columns below this are one column seen twice.
constexpr double kScoreRankTolerance = 1e-4;

double NormalTail(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }

double ChiSquaredTail(double value, int dof) {
  if (!(value > 0.0)) return 1.0;
  if (dof == 1) return std::erfc(std::sqrt(0.5 * value));
  if (dof == 2) return std::exp(-0.5 * value);
  return boost::math::cdf(
      boost::math::complement(boost::math::chi_squared(static_cast<double>(dof)), value));
}

// A hypothesis made ready: an orthonormal basis of its columns, and, for a single column that may
// lie on one side of null only, which.
struct Basis {
  Eigen::MatrixXd Q;  // rows x rank
  int side = 0;       // +1: only sizes above null, -1: only below, 0: both
};

// Columns of a hypothesis that can be told from the fitted values.
std::vector<int> SeenColumns(const Linearisation& at, const Hypothesis& h) {
  std::vector<int> seen;
  for (int k = h.first; k < h.first + h.count; ++k) {
    if (Information(at, k) > 0.0) seen.push_back(k);
  }
  return seen;
}

// Of length one: parameters of one effect may differ by powers of ten.
Eigen::MatrixXd Normalised(const Linearisation& at, const std::vector<int>& columns) {
  Eigen::MatrixXd A(at.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    A.col(static_cast<Eigen::Index>(i)) = at.columns.col(columns[i]).normalized();
  return A;
}

Basis BasisOf(const Linearisation& at, const Hypothesis& h) {
  Basis out;
  const std::vector<int> seen = SeenColumns(at, h);
  if (seen.empty()) {
    out.Q.resize(at.rows(), 0);
    return out;
  }
  const Eigen::MatrixXd A = Normalised(at, seen);
  if (A.cols() == 1) {
    out.Q = A;
    const int k = seen.front() - h.first;
    if (h.count == 1) out.side = h.lower[k] >= 0.0 ? 1 : (h.upper[k] <= 0.0 ? -1 : 0);
    return out;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  qr.setThreshold(kScoreRankTolerance);
  out.Q = qr.householderQ() * Eigen::MatrixXd::Identity(A.rows(), qr.rank());
  return out;
}

// Score and p-value from the projections q = Q'r; the residual is simulated minus measured, so a
// positive size shows as a negative q.
double StatisticOf(const Basis& basis, const Eigen::Ref<const Eigen::VectorXd>& q, double& p) {
  if (q.size() == 0) {
    p = 1.0;
    return 0.0;
  }
  if (basis.side == 0) {
    const double score = q.squaredNorm();
    p = ChiSquaredTail(score, static_cast<int>(q.size()));
    return score;
  }
  const double z = -basis.side * q[0];
  p = NormalTail(z);
  return z > 0.0 ? z * z : 0.0;
}

}  // namespace

double Information(const Linearisation& at, int column) {
  const double V = at.columns.col(column).squaredNorm();
  const double whole = at.length[column] * at.length[column];
  return std::isfinite(V) && V > kInseparable * whole ? V : 0.0;
}

double DetectableSize(const Linearisation& at, int column, double threshold) {
  const double V = Information(at, column);
  constexpr double kPower80 = 0.8416212335729143;
  if (!(V > 0.0)) return std::numeric_limits<double>::infinity();
  return (std::sqrt(threshold) + kPower80) / std::sqrt(V);
}

std::vector<Hypothesis> HypothesesOf(std::span<const Candidate> candidates) {
  std::vector<Hypothesis> hypotheses;
  int next = 0;
  for (const Candidate& c : candidates) {
    Hypothesis h{next, c.parameter_count(), Eigen::VectorXd(c.parameter_count()),
                 Eigen::VectorXd(c.parameter_count())};
    for (int i = 0; i < h.count; ++i) {
      const EffectParameter& p = c.Parameter(i);
      h.lower[i] = p.lower - p.null;
      h.upper[i] = p.upper - p.null;
    }
    next += h.count;
    hypotheses.push_back(std::move(h));
  }
  return hypotheses;
}

Score ScoreOf(const Linearisation& at, const Hypothesis& h) {
  Score out;
  out.size = Eigen::VectorXd::Constant(h.count, kNaN);
  const Basis basis = BasisOf(at, h);
  out.rank = static_cast<int>(basis.Q.cols());
  if (out.rank == 0) return out;
  const Eigen::VectorXd q = basis.Q.transpose() * at.r;
  out.score = StatisticOf(basis, q, out.p_value);
  out.predicted_gain = 0.5 * out.score;
  // Columns that are one seen twice share its size: where they differ there is rounding alone.
  const std::vector<int> seen = SeenColumns(at, h);
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(kScoreRankTolerance);
  solver.compute(Normalised(at, seen));
  const Eigen::VectorXd along = solver.solve(at.r);
  for (std::size_t i = 0; i < seen.size(); ++i)
    out.size[seen[i] - h.first] =
        -along[static_cast<Eigen::Index>(i)] / at.columns.col(seen[i]).norm();
  return out;
}

ScoreTests TestScores(const Linearisation& at, std::span<const Hypothesis> hypotheses,
                      std::uint64_t seed) {
  ScoreTests out;
  std::vector<Basis> bases;
  Eigen::Index total = 0;
  int tested = 0;
  for (const Hypothesis& h : hypotheses) {
    bases.push_back(BasisOf(at, h));
    total += bases.back().Q.cols();
    tested += bases.back().Q.cols() > 0;
    out.scores.push_back(ScoreOf(at, h));
    out.smallest_p = std::min(out.smallest_p, out.scores.back().p_value);
  }
  if (tested == 0) return out;

  // White noise seen through all bases at once: q ~ N(0, B'B), drawn by the square root of B'B.
  Eigen::MatrixXd B(at.rows(), total);
  Eigen::Index next = 0;
  for (const Basis& b : bases) {
    B.middleCols(next, b.Q.cols()) = b.Q;
    next += b.Q.cols();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(B.transpose() * B);
  const Eigen::MatrixXd root =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  RandomStream random(seed, 0);
  Eigen::VectorXd noise(total);
  int as_extreme = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    for (Eigen::Index i = 0; i < total; ++i) noise[i] = random.Normal();
    const Eigen::VectorXd q = root * noise;
    double smallest = 1.0;
    next = 0;
    for (const Basis& b : bases) {
      if (b.Q.cols() == 0) continue;
      double p;
      StatisticOf(b, q.segment(next, b.Q.cols()), p);
      next += b.Q.cols();
      smallest = std::min(smallest, p);
    }
    as_extreme += smallest <= out.smallest_p;
  }
  out.global_p = (as_extreme + 1.0) / (kDraws + 1.0);
  out.global_p = std::min(out.global_p, std::min(1.0, tested * out.smallest_p));
  return out;
}

}  // namespace hoplab
