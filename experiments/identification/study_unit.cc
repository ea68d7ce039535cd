#include "experiments/identification/study_unit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/identification/study_residuals.h"
#include "fitting/least_squares.h"
#include "optimize/box_search.h"

namespace hoplab {
namespace {

// The misfit of one unit as a function of the logarithms of its free constants.
class UnitProblem {
 public:
  UnitProblem(const UnitContext& context, const StudyUnit& unit)
      : context_(context), unit_(unit), own_(context) {
    const bool has_toe = At(unit.constants, StudyConstant::kToeMass) > 0.0;
    if (unit.runs == StudyUnit::Runs::kSteady) own_.data = SteadyData(context.data, has_toe);
    if (unit.times) own_.convergence = {context.convergence[static_cast<std::size_t>(*unit.times)]};
    for (const StudyConstant c : unit.free) {
      const double at = std::log(At(unit.constants, c));
      low_.push_back(std::max(std::log(InfoOf(c).low), at - Reach()));
      high_.push_back(std::min(std::log(InfoOf(c).high), at + Reach()));
      start_.push_back(std::clamp(at, low_.back(), high_.back()));
    }
  }

  StudyFit Search() {
    BoxSearchRequest q;
    q.low = low_;
    q.high = high_;
    if (unit_.box == 0.0) q.start = start_;
    q.cost = [&](std::span<const double> x) {
      return Cost(HopperAt(x.data())).Total(unit_.weights);
    };
    q.budget = unit_.budget;
    q.seed = unit_.seed;
    q.stop = context_.stop;
    const BoxSearchResult found = SearchBox(q);
    StudyFit fit{unit_.reading, unit_.constants, std::nan(""), {}, found.evaluations};
    if (!found.x.empty()) Take(HopperAt(found.x.data()), fit);
    return fit;
  }

  // By least squares, for as much again, where that does better: a convergence time moves smoothly
  // with the constants as long as it is told by the same hop.
  void Polish(StudyFit& fit) {
    if (std::isnan(fit.misfit) || (context_.stop && *context_.stop)) return;
    LeastSquaresRequest q;
    q.residual_count = static_cast<int>(Residuals(HopperOf(fit), fit).size());
    q.lower = Eigen::Map<const Eigen::VectorXd>(low_.data(), std::ssize(low_));
    q.upper = Eigen::Map<const Eigen::VectorXd>(high_.data(), std::ssize(high_));
    q.start.resize(q.lower.size());
    for (Eigen::Index i = 0; i < q.start.size(); ++i)
      q.start[i] = std::clamp(std::log(At(fit.constants, unit_.free[static_cast<std::size_t>(i)])),
                              q.lower[i], q.upper[i]);
    q.max_iterations = Iterations();
    q.stop = context_.stop;
    q.evaluate = [&](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
      if (unit_.runs == StudyUnit::Runs::kEnergy) {
        ++fit.evaluations;
        return ResidualsOf(HopperAt(x.data()), context_.data, false, unit_.free, r, jacobian);
      }
      return Differentiated(x, fit, r, jacobian);
    };
    const LeastSquaresResult solved = SolveLeastSquares(q);
    if (!solved.usable()) return;
    StudyFit polished = fit;
    Take(HopperAt(solved.x.data()), polished);
    if (polished.misfit < fit.misfit) fit = polished;
  }

 private:
  // A slope by differences takes two evaluations a constant, one from the sensitivities none.
  int Iterations() const {
    constexpr int kMost = 20, kMostByDifferences = 8;
    if (unit_.runs == StudyUnit::Runs::kEnergy) return kMost;
    return std::clamp(unit_.budget / (2 * static_cast<int>(unit_.free.size()) + 1), 1,
                      kMostByDifferences);
  }
  // How far the search goes from its start: a local one everywhere within the bounds.
  double Reach() const { return unit_.box == 0.0 ? kWholeBox : unit_.box; }
  StudyHopper HopperAt(const double* logarithms) const {
    StudyHopper hopper{unit_.reading, unit_.constants, context_.integrator};
    for (std::size_t i = 0; i < unit_.free.size(); ++i)
      At(hopper.constants, unit_.free[i]) = std::exp(logarithms[i]);
    return hopper;
  }
  StudyHopper HopperOf(const StudyFit& fit) const {
    return {unit_.reading, fit.constants, context_.integrator};
  }
  // The weighted differences, times by the reading that did best for `fit`.
  std::vector<double> Residuals(const StudyHopper& hopper, const StudyFit& fit) const {
    if (unit_.runs == StudyUnit::Runs::kEnergy)
      return std::vector<double>(context_.data.energy.size());
    const std::vector<ConvergenceReading> readings = ReadingOf(fit);
    const StudyRuns runs = unit_.runs == StudyUnit::Runs::kSteady
                               ? RunSteady(hopper, own_.data, WantsOf(readings))
                               : RunTables(hopper, own_.data, WantsOf(readings));
    return ResidualsOf(runs, own_.data, readings.empty() ? ConvergenceReading() : readings[0],
                       unit_.weights);
  }
  std::vector<ConvergenceReading> ReadingOf(const StudyFit& fit) const {
    if (context_.convergence.empty()) return {};
    return {context_.convergence[static_cast<std::size_t>(fit.parts.reading)]};
  }
  // Residuals, and their slopes by central differences.
  bool Differentiated(const Eigen::VectorXd& x, StudyFit& fit, Eigen::VectorXd& r,
                      Eigen::MatrixXd* jacobian) const {
    constexpr double kStep = 1e-4;  // of a logarithm
    const auto at = [&](const Eigen::VectorXd& y) {
      ++fit.evaluations;
      const std::vector<double> residuals = Residuals(HopperAt(y.data()), fit);
      return Eigen::VectorXd(
          Eigen::Map<const Eigen::VectorXd>(residuals.data(), std::ssize(residuals)));
    };
    r = at(x);
    for (Eigen::Index i = 0; jacobian && i < x.size(); ++i) {
      Eigen::VectorXd above = x, below = x;
      above[i] += kStep;
      below[i] -= kStep;
      jacobian->col(i) = (at(above) - at(below)) / (2.0 * kStep);
    }
    return r.allFinite();
  }
  StudyMisfit Cost(const StudyHopper& hopper) const {
    return MisfitOf(hopper, own_, unit_.runs, unit_.weights);
  }
  void Take(const StudyHopper& hopper, StudyFit& fit) const {
    fit.constants = hopper.constants;
    fit.parts = Cost(hopper);
    if (unit_.times) fit.parts.reading = *unit_.times;
    fit.misfit = fit.parts.Total(unit_.weights);
  }

  const UnitContext& context_;
  const StudyUnit& unit_;
  UnitContext own_;  // with the data its runs take, and the readings of the times it tries
  std::vector<double> low_, high_, start_;
};

}  // namespace

StudyMisfit MisfitOf(const StudyHopper& hopper, const UnitContext& context, StudyUnit::Runs runs,
                     const StudyWeights& weights) {
  if (runs == StudyUnit::Runs::kEnergy) {
    StudyMisfit misfit;
    misfit.parts[0] = EnergyMisfit(RunEnergy(hopper, context.data), context.data);
    return misfit;
  }
  const RunWants wants = WantsOf(context.convergence);
  const StudyRuns made = runs == StudyUnit::Runs::kSteady ? RunSteady(hopper, context.data, wants)
                                                          : RunTables(hopper, context.data, wants);
  return MisfitOf(made, context.data, context.convergence, weights);
}

std::vector<int> LikelyTimes(const UnitContext& context, const StudyUnit& unit, int most) {
  const StudyHopper hopper{unit.reading, unit.constants, context.integrator};
  const StudyRuns runs = RunTables(hopper, context.data, WantsOf(context.convergence));
  std::vector<std::pair<double, int>> by_misfit;
  for (int i = 0; i < std::ssize(context.convergence); ++i) {
    const auto at = static_cast<std::size_t>(i);
    by_misfit.emplace_back(MisfitOf(runs, context.data, {context.convergence[at]}).Total(), i);
  }
  std::sort(by_misfit.begin(), by_misfit.end());
  std::vector<int> likely;
  for (const auto& [misfit, place] : by_misfit)
    if (std::ssize(likely) < most) likely.push_back(place);
  return likely;
}

StudyFit FitUnit(const UnitContext& context, const StudyUnit& unit) {
  UnitProblem problem(context, unit);
  StudyFit fit = problem.Search();
  problem.Polish(fit);
  return fit;
}

}  // namespace hoplab
