#pragma once

#include <Eigen/Core>
#include <vector>

#include "fitting/trial_evaluator.h"

namespace hoplab {

/// A trial's whitened residuals and columns of shared values with what its own values can explain
/// projected out, and the rest turned by an orthogonal matrix into as few rows as there are columns
/// and one. Sums of products of residuals and columns are those of the whole, so trials can be laid
/// one below the other at a cost that does not depend on their length.
struct EliminatedTrial {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd columns;  // one a column asked for
  int own_rank = 0;         // dimensions projected out
  double own_nats = 0.0;    // half the square of the residuals' length along them
  bool empty() const { return residuals.size() == 0; }
};

/// `columns` are those of the trial's Jacobian that stay, each taken times its scale.
struct KeptColumn {
  int place = 0;
  double scale = 1.0;
};

/// The columns, then the residuals, row by row, with the directions of an orthonormal basis
/// (OwnBasis) projected out.
Eigen::MatrixXd ProjectedColumns(const Eigen::MatrixXd& own_basis,
                                 const TrialEvaluation& evaluation,
                                 const std::vector<KeptColumn>& columns);

/// Of an evaluated trial with its Jacobian. Own values that are held are not projected out.
EliminatedTrial EliminateOwn(const TrialProblem& trial, const TrialEvaluation& evaluation,
                             int shared_count, const std::vector<KeptColumn>& columns);

/// Residuals and columns of several trials, one below the other.
EliminatedTrial Stacked(const std::vector<EliminatedTrial>& trials);

/// Orthonormal basis of the span of a trial's free own columns; directions no sample sees drop out.
Eigen::MatrixXd OwnBasis(const TrialProblem& trial, const TrialEvaluation& evaluation,
                         int shared_count);

}  // namespace hoplab
