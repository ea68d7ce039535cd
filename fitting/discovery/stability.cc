#include "fitting/discovery/stability.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace hoplab {
namespace {

// Sums of products of fitted basis, columns and residuals, in this order.
struct Products {
  Eigen::MatrixXd gram;
  Eigen::Index fitted = 0;

  Eigen::Index residual() const { return gram.rows() - 1; }
  Eigen::Index at(int column) const { return fitted + column; }
};

// Takes the direction of row `i` out of the rest; false where nothing of it is left.
bool Sweep(Products& p, Eigen::Index i, double whole) {
  const double pivot = p.gram(i, i);
  if (!(pivot > 1e-9 * whole) || !(whole > 0.0)) {
    p.gram.row(i).setZero();
    p.gram.col(i).setZero();
    return false;
  }
  const Eigen::VectorXd column = p.gram.col(i) / std::sqrt(pivot);
  p.gram.noalias() -= column * column.transpose();
  p.gram.row(i).setZero();
  p.gram.col(i).setZero();
  return true;
}

std::vector<LinearPick> Pick(Products p, const std::vector<int>& columns, int most,
                             double least_gain) {
  const Eigen::VectorXd whole = p.gram.diagonal();
  for (Eigen::Index i = 0; i < p.fitted; ++i) Sweep(p, i, whole[i]);
  std::vector<LinearPick> picks;
  while (static_cast<int>(picks.size()) < most) {
    LinearPick best{-1, least_gain};
    for (const int column : columns) {
      const Eigen::Index i = p.at(column);
      if (!(p.gram(i, i) > 1e-6 * whole[i])) continue;
      const double along = p.gram(i, p.residual());
      const double gain = 0.5 * along * along / p.gram(i, i);
      if (gain > best.gain) best = {column, gain};
    }
    if (best.column < 0) break;
    picks.push_back(best);
    Sweep(p, p.at(best.column), whole[p.at(best.column)]);
  }
  return picks;
}

// Rows with the fitted values' part still in them, so that a resample can take out its own.
Eigen::MatrixXd WholeRows(const Linearisation& at) {
  const Eigen::Index f = at.fitted_basis.cols(), n = at.columns.cols();
  Eigen::MatrixXd rows(at.rows(), f + n + 1);
  rows.leftCols(f) = at.fitted_basis;
  rows.middleCols(f, n) = at.columns + at.fitted_basis * at.along_fitted;
  rows.col(f + n) = at.r;
  return rows;
}

}  // namespace

std::vector<std::vector<int>> EqualColumns(const Linearisation& at, double alike) {
  std::vector<std::vector<int>> groups;
  for (int j = 0; j < static_cast<int>(at.columns.cols()); ++j) {
    const double length = at.columns.col(j).norm();
    if (!(length * length > 1e-6 * at.length[j] * at.length[j]) || !(length > 0.0)) continue;
    bool found = false;
    for (std::vector<int>& group : groups) {
      const auto& first = at.columns.col(group.front());
      if (std::abs(first.dot(at.columns.col(j))) < alike * first.norm() * length) continue;
      group.push_back(j);
      found = true;
      break;
    }
    if (!found) groups.push_back({j});
  }
  return groups;
}

std::vector<LinearPick> PickForward(const Linearisation& at, const std::vector<int>& columns,
                                    int most, double least_gain) {
  const Eigen::MatrixXd rows = WholeRows(at);
  return Pick({rows.transpose() * rows, at.fitted_basis.cols()}, columns, most, least_gain);
}

std::vector<double> ShareOfResamples(const Linearisation& at, const std::vector<int>& columns,
                                     const std::vector<std::vector<int>>& wanted, int most,
                                     double least_gain, std::uint64_t seed, int draws) {
  int trials = 0;
  for (const RowLabel& label : at.labels) trials = std::max(trials, label.trial + 1);
  if (trials < 2) return {};
  const Eigen::MatrixXd rows = WholeRows(at);
  const Eigen::Index width = rows.cols();
  std::vector<Eigen::MatrixXd> grams(static_cast<std::size_t>(trials),
                                     Eigen::MatrixXd::Zero(width, width));
  for (Eigen::Index first = 0; first < rows.rows();) {
    const int trial = at.labels[static_cast<std::size_t>(first)].trial;
    Eigen::Index last = first;
    while (last < rows.rows() && at.labels[static_cast<std::size_t>(last)].trial == trial) ++last;
    const auto block = rows.middleRows(first, last - first);
    grams[static_cast<std::size_t>(trial)].noalias() += block.transpose() * block;
    first = last;
  }
  std::vector<double> share(wanted.size(), 0.0);
  RandomStream random(seed, 0);
  for (int draw = 0; draw < draws; ++draw) {
    Products p{Eigen::MatrixXd::Zero(width, width), at.fitted_basis.cols()};
    for (int k = 0; k < trials; ++k) {
      const auto taken = static_cast<std::size_t>(
          std::min(trials - 1, static_cast<int>(random.Uniform(0.0, trials))));
      p.gram += grams[taken];
    }
    const std::vector<LinearPick> picks = Pick(std::move(p), columns, most, least_gain);
    for (std::size_t w = 0; w < wanted.size(); ++w) {
      const bool has = std::any_of(picks.begin(), picks.end(), [&](const LinearPick& pick) {
        return std::find(wanted[w].begin(), wanted[w].end(), pick.column) != wanted[w].end();
      });
      if (has) share[w] += 1.0 / draws;
    }
  }
  return share;
}

}  // namespace hoplab
