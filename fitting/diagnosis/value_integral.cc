#include "fitting/diagnosis/value_integral.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace hoplab {
namespace {

constexpr std::array kPriorWidths = {0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0};
const double kLogRootTwoPi = 0.5 * std::log(2.0 * std::numbers::pi);
// What no data see is held by this much, so that there is a normal density to begin with; the
// widest prior holds it a hundred times more, and it is taken off again.
constexpr double kHold = 1e-5;

// A normal density times exp(log_weight).
struct Piece {
  double log_weight = 0.0;
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;

  // One value's mean and variance become others, and all values correlated with it follow.
  void Move(Eigen::Index k, double to_mean, double to_variance) {
    const Eigen::VectorXd column = covariance.col(k);
    const double variance = column[k];
    mean += column * ((to_mean - mean[k]) / variance);
    covariance += column * column.transpose() * ((to_variance - variance) / (variance * variance));
  }
};

// The likelihood alone.
Piece PieceOf(const ValueLikelihood& likelihood, const std::vector<ValuePrior>& priors) {
  const Eigen::Index n = likelihood.root.cols(), rows = likelihood.root.rows();
  Eigen::VectorXd at(n);
  for (Eigen::Index k = 0; k < n; ++k) at[k] = priors[static_cast<std::size_t>(k)].at;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows + n + 1, n + 1);
  all.topLeftCorner(rows, n) = likelihood.root;
  all.topRightCorner(rows, 1) = likelihood.root * at - likelihood.rest;
  all.block(rows, 0, n, n).diagonal().setConstant(std::sqrt(kHold));
  const Eigen::MatrixXd qr = Eigen::HouseholderQR<Eigen::MatrixXd>(all).matrixQR();
  const auto R = qr.topLeftCorner(n, n).triangularView<Eigen::Upper>();
  const Eigen::MatrixXd inverse = R.solve(Eigen::MatrixXd::Identity(n, n));
  Piece piece;
  piece.mean = R.solve(qr.col(n).head(n));
  piece.covariance = inverse * inverse.transpose();
  piece.log_weight = likelihood.log_constant - 0.5 * qr(n, n) * qr(n, n) +
                     static_cast<double>(n) * kLogRootTwoPi -
                     qr.diagonal().head(n).array().abs().log().sum();
  return piece;
}

// exp(z^2) erfc(z).
double ScaledErfc(double z) {
  if (z < 20.0) return std::exp(z * z) * boost::math::erfc(z);
  return (1.0 - 0.5 / (z * z)) / (z * std::sqrt(std::numbers::pi));
}

// A normal density in one dimension, cut by the nearer of two bounds.
struct Cut {
  double log_share = 0.0, mean, variance;

  Cut(double m, double v, double lower, double upper) : mean(m), variance(v) {
    const double deviation = std::sqrt(v);
    // The upper bound is the lower one, mirrored.
    const bool mirrored = upper - m < m - lower;
    const double a = (mirrored ? m - upper : lower - m) / deviation;
    if (a < -8.0) return;
    const double z = a / std::numbers::sqrt2;
    const double scaled = ScaledErfc(z);
    // Density at the bound over what is left beyond it.
    const double hazard = std::sqrt(2.0 / std::numbers::pi) / scaled;
    log_share = std::log(0.5 * scaled) - z * z;
    mean += (mirrored ? -1.0 : 1.0) * hazard * deviation;
    // Far beyond the bound what is left is exponential; the difference would be rounding.
    variance *= a > 30.0 ? 1.0 / (a * a) : 1.0 - hazard * (hazard - a);
  }
};

// Its children: the piece times each normal density of a value's prior.
struct Child {
  double log_weight, mean, variance;  // of the value
};
std::array<Child, kPriorWidths.size()> ChildrenOf(const Piece& piece, Eigen::Index k,
                                                  const ValuePrior& prior) {
  const double m = piece.mean[k], v = piece.covariance(k, k);
  std::array<Child, kPriorWidths.size()> children{};
  for (std::size_t j = 0; j < kPriorWidths.size(); ++j) {
    const double w = kPriorWidths[j], precision = 1.0 / (w * w) - kHold;
    const double shrink = 1.0 / (1.0 + precision * v);
    const Cut cut(shrink * m, shrink * v, prior.lower, prior.upper);
    children[j] = {piece.log_weight + 0.5 * std::log(shrink) - 0.5 * precision * shrink * m * m -
                       std::log(w * kPriorWidths.size()) - kLogRootTwoPi +
                       (prior.one_sided ? std::log(2.0) : 0.0) + cut.log_share,
                   cut.mean, cut.variance};
  }
  return children;
}

template <class Range>
double LogSumOfWeights(const Range& range) {
  double most = -std::numeric_limits<double>::infinity(), sum = 0.0;
  for (const auto& c : range) most = std::max(most, c.log_weight);
  for (const auto& c : range) sum += std::exp(c.log_weight - most);
  return most + std::log(sum);
}

// The children as one piece with their mean and variance.
Piece Joined(Piece piece, Eigen::Index k, const std::array<Child, kPriorWidths.size()>& children) {
  const double log_sum = LogSumOfWeights(children);
  double mean = 0.0, variance = 0.0;
  for (const Child& c : children) mean += std::exp(c.log_weight - log_sum) * c.mean;
  for (const Child& c : children)
    variance += std::exp(c.log_weight - log_sum) * (c.variance + (c.mean - mean) * (c.mean - mean));
  piece.Move(k, mean, variance);
  piece.log_weight = log_sum;
  return piece;
}

}  // namespace

double LogSizePrior(double u, bool one_sided) {
  double density = 0.0;
  for (const double w : kPriorWidths)
    density += std::exp(-0.5 * (u / w) * (u / w) - kLogRootTwoPi) / w / kPriorWidths.size();
  return std::log(std::max(density, 1e-300) * (one_sided ? 2.0 : 1.0));
}

double LogValueIntegral(const ValueLikelihood& likelihood, const std::vector<ValuePrior>& priors) {
  // Six of its standard errors from what changes nothing the prior is as good as flat.
  constexpr double kWellKnown = 6.0;
  constexpr std::size_t kMostPieces = 64;
  std::vector<Piece> pieces = {PieceOf(likelihood, priors)};
  const Piece& first = pieces.front();
  Eigen::VectorXd known = first.mean.cwiseAbs();
  known = known.cwiseQuotient(first.covariance.diagonal().cwiseSqrt());
  std::vector<Eigen::Index> order(priors.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return known[a] > known[b]; });
  for (const Eigen::Index k : order) {
    std::vector<Piece> next;
    for (const Piece& piece : pieces) {
      const auto children = ChildrenOf(piece, k, priors[static_cast<std::size_t>(k)]);
      if (known[k] > kWellKnown) {
        next.push_back(Joined(piece, k, children));
        continue;
      }
      for (const Child& c : children) {
        next.push_back(piece);
        next.back().Move(k, c.mean, c.variance);
        next.back().log_weight = c.log_weight;
      }
    }
    std::stable_sort(next.begin(), next.end(),
                     [](const Piece& a, const Piece& b) { return a.log_weight > b.log_weight; });
    if (next.size() > kMostPieces) next.resize(kMostPieces);
    pieces = std::move(next);
  }
  return LogSumOfWeights(pieces);
}

}  // namespace hoplab
