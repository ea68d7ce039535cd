#include "fitting/eliminated_trial.h"

#include <Eigen/QR>

namespace hoplab {
namespace {

// Own columns closer than this to the span of the others are one direction seen twice.
constexpr double kStartRankTolerance = 1e-10;

// Leaves the sums of products of the columns of `m` as they are, in min(rows, columns) rows.
Eigen::MatrixXd Compressed(Eigen::MatrixXd m) {
  const Eigen::Index n = m.cols();
  if (m.rows() <= n) return m;
  const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(m);
  return m.topRows(n).triangularView<Eigen::Upper>();
}

}  // namespace

Eigen::MatrixXd OwnBasis(const TrialProblem& trial, const TrialEvaluation& evaluation,
                         int shared_count) {
  Eigen::MatrixXd own(evaluation.jacobian.rows(), trial.own_count());
  Eigen::Index free = 0;
  for (int k = 0; k < trial.own_count(); ++k) {
    if (!trial.own[static_cast<std::size_t>(k)].free) continue;
    own.col(free) = evaluation.jacobian.col(shared_count + k);
    // Columns of very different length (a prior of 1e-9 beside one of 0.02) are scaled first.
    const double norm = own.col(free).norm();
    if (norm > 0.0) own.col(free++) /= norm;
  }
  own.conservativeResize(Eigen::NoChange, free);
  if (free == 0) return own;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(own);
  qr.setThreshold(kStartRankTolerance);
  if (qr.rank() == 0) return Eigen::MatrixXd(own.rows(), 0);
  return qr.householderQ() * Eigen::MatrixXd::Identity(own.rows(), qr.rank());
}

Eigen::MatrixXd ProjectedColumns(const Eigen::MatrixXd& own_basis,
                                 const TrialEvaluation& evaluation,
                                 const std::vector<KeptColumn>& columns) {
  const auto n = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd whole(evaluation.residuals.size(), n + 1);
  for (Eigen::Index k = 0; k < n; ++k) {
    const KeptColumn& c = columns[static_cast<std::size_t>(k)];
    whole.col(k) = evaluation.jacobian.col(c.place) * c.scale;
  }
  whole.col(n) = evaluation.residuals;
  // Twice is enough: what rounding of the first pass leaves along the basis is taken by the second.
  for (int pass = 0; pass < 2 && own_basis.cols() > 0; ++pass)
    whole -= own_basis * (own_basis.transpose() * whole);
  return whole;
}

EliminatedTrial EliminateOwn(const TrialProblem& trial, const TrialEvaluation& evaluation,
                             int shared_count, const std::vector<KeptColumn>& columns) {
  const auto n = static_cast<Eigen::Index>(columns.size());
  const Eigen::MatrixXd Q = OwnBasis(trial, evaluation, shared_count);
  EliminatedTrial out;
  out.own_rank = static_cast<int>(Q.cols());
  out.own_nats = 0.5 * (Q.transpose() * evaluation.residuals).squaredNorm();
  const Eigen::MatrixXd whole = Compressed(ProjectedColumns(Q, evaluation, columns));
  out.columns = whole.leftCols(n);
  out.residuals = whole.col(n);
  return out;
}

EliminatedTrial Stacked(const std::vector<EliminatedTrial>& trials) {
  Eigen::Index rows = 0, columns = 0;
  for (const EliminatedTrial& t : trials) {
    rows += t.residuals.size();
    if (!t.empty()) columns = t.columns.cols();
  }
  EliminatedTrial out;
  out.residuals.resize(rows);
  out.columns.resize(rows, columns);
  Eigen::Index at = 0;
  for (const EliminatedTrial& t : trials) {
    if (t.empty()) continue;
    out.residuals.segment(at, t.residuals.size()) = t.residuals;
    out.columns.middleRows(at, t.residuals.size()) = t.columns;
    at += t.residuals.size();
    out.own_rank += t.own_rank;
    out.own_nats += t.own_nats;
  }
  return out;
}

}  // namespace hoplab
