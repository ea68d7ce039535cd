#include "fitting/edges.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace hoplab {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of the Gauss-Newton step: along so short a way the columns turn by kJump of their length where an
// edge is there. Those of a smooth function turn an eighth of it along an eighth of the way, those
// of one with an edge as much.
constexpr double kWay = 1e-3, kShorter = 0.125;
constexpr double kJump = 5e-3, kStays = 0.5;

// The unknowns of all trials in one row: shared values, then each trial's own, over their scales.
class Unknowns {
 public:
  explicit Unknowns(const EdgePoint& at) : at_(at), shared_(at.problem.shared_count()) {
    Index next = shared_;
    for (const TrialProblem& t : at.trials) {
      own_begin_.push_back(next);
      next += t.own_count();
    }
    scale_ = VectorXd::Ones(next);
    free_ = VectorXd::Ones(next);
    for (Index k = 0; k < shared_; ++k)
      scale_[k] = at.problem.shared[static_cast<std::size_t>(k)].scale;
    for (const int k : at.held) free_[k] = 0.0;
    for (std::size_t i = 0; i < at.trials.size(); ++i) {
      for (Index k = 0; k < at.trials[i].own_count(); ++k) {
        const OwnParameter& own = at.trials[i].own[static_cast<std::size_t>(k)];
        scale_[own_begin_[i] + k] = own.scale;
        if (at.hold_own || !own.free) free_[own_begin_[i] + k] = 0.0;
      }
    }
  }

  Index count() const { return scale_.size(); }
  const VectorXd& scale() const { return scale_; }

  // A trial's Jacobian with its columns over the unknowns' scales; held ones are zero.
  MatrixXd Scaled(std::size_t trial, const TrialEvaluation& e) const {
    MatrixXd J = e.jacobian;
    for (Index k = 0; k < J.cols(); ++k) {
      const Index place = PlaceOf(trial, k);
      J.col(k) *= scale_[place] * free_[place];
    }
    return J;
  }
  // Where column `k` of a trial's Jacobian stands among the unknowns.
  Index PlaceOf(std::size_t trial, Index k) const {
    return k < shared_ ? k : own_begin_[trial] + k - shared_;
  }
  // A trial's part of a row of all unknowns, and back.
  VectorXd PartOf(std::size_t trial, const VectorXd& all) const {
    VectorXd part(shared_ + at_.trials[trial].own_count());
    for (Index k = 0; k < part.size(); ++k) part[k] = all[PlaceOf(trial, k)];
    return part;
  }
  VectorXd Spread(std::size_t trial, const VectorXd& part) const {
    VectorXd all = VectorXd::Zero(count());
    for (Index k = 0; k < part.size(); ++k) all[PlaceOf(trial, k)] = part[k];
    return all;
  }

  // All trials at the point moved by `step`; empty where one cannot be evaluated.
  std::vector<TrialEvaluation> EvaluatedAt(const VectorXd& step) const {
    VectorXd shared = at_.shared + scale_.head(shared_).cwiseProduct(step.head(shared_));
    for (Index k = 0; k < shared_; ++k) {
      const SharedParameter& s = at_.problem.shared[static_cast<std::size_t>(k)];
      shared[k] = std::clamp(shared[k], s.lower, s.upper);
    }
    std::vector<TrialEvaluation> out(at_.trials.size());
    ParallelFor(static_cast<int>(out.size()), at_.jobs, [&](int index) {
      const auto i = static_cast<std::size_t>(index);
      const Index begin = own_begin_[i], many = at_.trials[i].own_count();
      const OwnValues own =
          at_.own[i] + scale_.segment(begin, many).cwiseProduct(step.segment(begin, many));
      const TrialEvaluator evaluator(at_.problem, at_.trials[i]);
      evaluator.Evaluate({shared, own, true, at_.loss, /*fly_on=*/false, /*whiten=*/false}, out[i]);
    });
    const bool all = std::all_of(out.begin(), out.end(), [](const TrialEvaluation& e) {
      return e.complete && e.evaluated && e.jacobian.allFinite();
    });
    return all ? out : std::vector<TrialEvaluation>();
  }

 private:
  const EdgePoint& at_;
  Index shared_;
  std::vector<Index> own_begin_;
  VectorXd scale_, free_;
};

// The linear model of all trials at the point. Products of its columns are enough for its steps.
struct LinearModel {
  MatrixXd JtJ;
  VectorXd gradient;
  VectorXd size;  // 1/length of each column; 0 where it has none

  LinearModel(const Unknowns& unknowns, const std::vector<TrialEvaluation>& evaluations)
      : JtJ(MatrixXd::Zero(unknowns.count(), unknowns.count())),
        gradient(VectorXd::Zero(unknowns.count())),
        size(unknowns.count()) {
    for (std::size_t i = 0; i < evaluations.size(); ++i) {
      const MatrixXd J = unknowns.Scaled(i, evaluations[i]);
      const MatrixXd products = J.transpose() * J;
      const VectorXd slopes = J.transpose() * evaluations[i].residuals;
      for (Index a = 0; a < J.cols(); ++a) {
        gradient[unknowns.PlaceOf(i, a)] += slopes[a];
        for (Index b = 0; b < J.cols(); ++b)
          JtJ(unknowns.PlaceOf(i, a), unknowns.PlaceOf(i, b)) += products(a, b);
      }
    }
    for (Index k = 0; k < size.size(); ++k)
      size[k] = JtJ(k, k) > 0.0 ? 1.0 / std::sqrt(JtJ(k, k)) : 0.0;
    JtJ = size.asDiagonal() * JtJ * size.asDiagonal();
    gradient = gradient.cwiseProduct(size);
  }

  // The Gauss-Newton step along which every row of `normals` stays zero; columns over `size`.
  VectorXd Step(const MatrixXd& normals) const {
    const Index n = JtJ.rows();
    if (normals.rows() >= n) return VectorXd::Zero(n);
    MatrixXd along = MatrixXd::Identity(n, n);
    if (normals.rows() > 0) {
      const MatrixXd Q = Eigen::HouseholderQR<MatrixXd>(normals.transpose()).householderQ();
      along = Q.rightCols(n - normals.rows());
    }
    const MatrixXd reduced = along.transpose() * JtJ * along;
    return along * Eigen::CompleteOrthogonalDecomposition<MatrixXd>(reduced).solve(
                       -(along.transpose() * gradient));
  }
  // How far the residuals move along a way over the scales.
  double LengthOf(VectorXd way) const {
    for (Index k = 0; k < way.size(); ++k) way[k] = size[k] > 0.0 ? way[k] / size[k] : 0.0;
    return std::sqrt(way.dot(JtJ * way));
  }
  double GainOf(const VectorXd& step) const {
    return -gradient.dot(step) - 0.5 * step.dot(JtJ * step);
  }
};

// Adds a normal to those there are, unless they make it up.
bool Add(const VectorXd& normal, MatrixXd& normals) {
  constexpr double kNew = 0.1;
  VectorXd rest = normal;
  if (normals.rows() > 0) {
    const MatrixXd Q = Eigen::HouseholderQR<MatrixXd>(normals.transpose()).householderQ() *
                       MatrixXd::Identity(normals.cols(), normals.rows());
    rest -= Q * (Q.transpose() * rest);
  }
  if (rest.norm() < kNew) return false;
  normals.conservativeResize(normals.rows() + 1, normal.size());
  normals.row(normals.rows() - 1) = normal.transpose();
  return true;
}

}  // namespace

EdgeCheck CheckEdges(const EdgePoint& at) {
  EdgeCheck out;
  const Unknowns unknowns(at);
  const std::vector<TrialEvaluation> here = unknowns.EvaluatedAt(VectorXd::Zero(unknowns.count()));
  if (here.empty()) return out;
  const LinearModel model(unknowns, here);
  MatrixXd normals(0, unknowns.count());
  const VectorXd free_step = model.Step(normals);
  for (const double way : {kWay, -kWay}) {
    const VectorXd step = way * model.size.cwiseProduct(free_step);
    const std::vector<TrialEvaluation> there = unknowns.EvaluatedAt(kShorter * step);
    const std::vector<TrialEvaluation> beyond = unknowns.EvaluatedAt(step);
    for (std::size_t i = 0; i < std::min(there.size(), beyond.size()); ++i) {
      const VectorXd size = unknowns.PartOf(i, model.size);
      const MatrixXd at_point = unknowns.Scaled(i, here[i]);
      if (there[i].jacobian.rows() != at_point.rows() ||
          beyond[i].jacobian.rows() != at_point.rows())
        continue;
      const MatrixXd jump = (unknowns.Scaled(i, there[i]) - at_point) * size.asDiagonal();
      const MatrixXd further = (unknowns.Scaled(i, beyond[i]) - at_point) * size.asDiagonal();
      const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(jump.transpose() * jump);
      for (Index k = jump.cols(); k-- > 0;) {  // the largest first
        if (!(solver.eigenvalues()[k] > kJump * kJump)) break;
        const VectorXd along = solver.eigenvectors().col(k);
        if ((jump * along).norm() < kStays * (further * along).norm()) continue;
        const VectorXd normal = unknowns.Spread(i, along);
        if (!Add(normal, normals)) continue;
        Edge edge{static_cast<int>(i), {}, 0.0};
        // A way over the scales is one over `size` times it.
        VectorXd part = unknowns.PartOf(i, normal);
        for (Index c = 0; c < part.size(); ++c) part[c] = size[c] > 0.0 ? part[c] / size[c] : 0.0;
        edge.normal = part.normalized();
        edge.slope = model.LengthOf(unknowns.Spread(i, edge.normal));
        out.edges.push_back(std::move(edge));
      }
    }
  }
  const VectorXd step = model.Step(normals);
  out.promised_nats = model.GainOf(step);
  const Index n = at.problem.shared_count();
  out.promised_step =
      unknowns.scale().head(n).cwiseProduct(model.size.head(n)).cwiseProduct(step.head(n));
  return out;
}

}  // namespace hoplab
