#include "fitting/diagnosis/extension.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "model/effects/active_effects.h"

namespace hoplab {
namespace {

// Likelihoods are compared to well below a nat; where costs are large, so are their differences.
constexpr double kCostTolerance = 1e-6;

// A size whose beginning costs so many times what the base does is not the linear forecast's.
constexpr double kFarOff = 10.0;

// Where in the shared values member i begins.
int PlaceOf(const Extension& e, int i) {
  return e.problem.shared_count() - e.parameter_count() +
         ParameterCount(std::span(e.members).first(static_cast<std::size_t>(i)));
}

// A start inside the bounds, off null so that a derivative that ends there has a side.
double Inside(const SharedParameter& s, double value) {
  const double room = std::min(1e-3 * s.scale, 0.25 * (s.upper - s.lower));
  return std::clamp(value, s.lower + room, s.upper - room);
}

void Run(Extension& e, const Eigen::VectorXd& null_values, const RefitSettings& settings,
         double base_cost) {
  SolveRequest request;
  request.problem = &e.problem;
  request.trials = settings.train;
  request.starts = e.starts;
  request.max_iterations = settings.max_iterations;
  request.function_tolerance = kCostTolerance;
  request.jobs = settings.jobs;
  request.stop = settings.stop;
  request.give_up_above = std::min(settings.give_up_above, base_cost);
  request.start_below = kFarOff * base_cost;
  const Eigen::Index added = null_values.size(), kept = e.shared.size() - added;
  const Eigen::VectorXd sizes = e.shared.tail(added);
  SolveResult result;
  // A large effect may end a simulation early, or lead far off, where the fitted values are not yet
  // its own.
  for (double share : {1.0, 0.3, 0.1, 0.01}) {
    request.shared = e.shared;
    for (Eigen::Index k = 0; k < added; ++k) {
      const SharedParameter& s = e.problem.shared[static_cast<std::size_t>(kept + k)];
      const double size = std::isfinite(sizes[k]) ? sizes[k] : 0.0;
      request.shared[kept + k] = Inside(s, null_values[k] + share * size);
    }
    result = Solve(request);
    if (result.status != SolveStatus::kNoStart) break;
  }
  e.shared = result.shared;
  e.starts = result.starts;
  e.cost = result.cost;
  e.status = result.status;
}

}  // namespace

Eigen::VectorXd Extension::ValuesOf(int i) const {
  return shared.segment(PlaceOf(*this, i), members[static_cast<std::size_t>(i)].parameter_count());
}

bool Extension::AtPhysicalBound(int i) const {
  const int first = PlaceOf(*this, i);
  const Candidate& member = members[static_cast<std::size_t>(i)];
  for (int k = 0; k < member.parameter_count(); ++k) {
    const int place = first + k;
    const SharedParameter& s = problem.shared[static_cast<std::size_t>(place)];
    const double null = member.effect->info.parameters[k].null, near = 1e-6 * s.scale;
    const double value = shared[place];
    if (value <= s.lower + near && null > s.lower + near) return true;
    if (value >= s.upper - near && null < s.upper - near) return true;
  }
  return false;
}

Extension Refit(const Extension& base, std::span<const Candidate> added,
                const Eigen::VectorXd& sizes, const RefitSettings& settings) {
  Extension e;
  e.members = base.members;
  e.members.insert(e.members.end(), added.begin(), added.end());
  e.problem = Extend(base.problem, added);
  e.shared.resize(base.shared.size() + sizes.size());
  e.shared << base.shared, sizes;
  e.starts = base.starts;
  const Eigen::VectorXd null = NullValues(added);
  // More values cannot fit worse: a search that ended above its base went astray.
  Run(e, null, settings, base.cost);
  if (!e.ok() || e.cost > base.cost) {
    e.shared << base.shared, Eigen::VectorXd::Zero(null.size());
    e.starts = base.starts;
    Run(e, null, settings, base.cost);
    if (e.ok() && e.cost > base.cost) {
      e.shared << base.shared, null;
      e.starts = base.starts;
      e.cost = base.cost;
    }
  }
  return e;
}

Extension RefitWithout(const Extension& base, int i, const FitProblem& null_problem,
                       const RefitSettings& settings) {
  Extension e;
  const int place = PlaceOf(base, i);
  const int count = base.members[static_cast<std::size_t>(i)].parameter_count();
  e.members = base.members;
  e.members.erase(e.members.begin() + i);
  e.problem = Extend(null_problem, e.members);
  e.shared.resize(base.shared.size() - count);
  e.shared << base.shared.head(place), base.shared.tail(base.shared.size() - place - count);
  e.starts = base.starts;
  Run(e, Eigen::VectorXd(0), settings, std::numeric_limits<double>::infinity());
  return e;
}

namespace {

// What a run with this effect costs decides which effects are differentiated together: one that
// changes the leg's law, or is sharp, slows every column of its run.
int CostClass(const Candidate& candidate) {
  const Effect& effect = *candidate.effect;
  if (effect.info.sharp) return 2;
  if (!effect.hooks0.change_parameters) return 0;
  Parameters<double> p;
  const EffectSetting at_null = EffectSetting::Null(effect);
  effect.hooks0.change_parameters(at_null.values.data(), p);
  return p.law_terms.active ? 1 : 0;
}

// Collects columns of one linearisation that come from several runs.
class Columns {
 public:
  Columns(const Extension& model, std::span<const Candidate> tested,
          const std::vector<TrialProblem>& train, int jobs)
      : model_(model), tested_(tested), train_(train), jobs_(jobs) {
    for (const Candidate& c : tested) {
      column_of_.push_back(count_);
      count_ += c.parameter_count();
    }
  }

  /// Those of the candidates at `places`, differentiated together. Where that fails, as it may for
  /// one that asks for too many steps, in halves; one that fails alone keeps columns of zeros.
  void Add(std::span<const int> places) {
    std::vector<Candidate> part;
    for (const int place : places) part.push_back(tested_[static_cast<std::size_t>(place)]);
    Linearisation at = LineariseWith(part);
    if (IsSound(at)) return Take(places, std::move(at));
    if (places.size() > 1) {
      Add(places.first(places.size() / 2));
      Add(places.subspan(places.size() / 2));
    } else {
      failed_.push_back(part.front().Name());
    }
  }

  Linearisation Done() {
    if (!begun_) Begin(Linearisation(Bare()));
    all_.failed = std::move(failed_);
    return std::move(all_);
  }

 private:
  Linearisation LineariseWith(std::span<const Candidate> part) const {
    const FitProblem problem = Extend(model_.problem, part);
    Eigen::VectorXd shared(problem.shared_count());
    shared << model_.shared, NullValues(part);
    return Linearise(problem, model_.problem.shared_count(), train_, shared, model_.starts, jobs_);
  }
  const Linearisation& Bare() {
    if (!bare_) bare_ = LineariseWith({});
    return *bare_;
  }
  // Differentiating by more must not lose a trial that the model by itself gets through.
  bool IsSound(const Linearisation& at) {
    if (!at.columns.allFinite()) return false;
    if (at.trials_left_out > 0 && at.trials_left_out != Bare().trials_left_out) return false;
    return !begun_ ||
           (at.rows() == all_.rows() && at.fitted_basis.cols() == all_.fitted_basis.cols());
  }
  void Begin(Linearisation at) {
    all_ = std::move(at);
    all_.columns = Eigen::MatrixXd::Zero(all_.rows(), count_);
    all_.along_fitted = Eigen::MatrixXd::Zero(all_.fitted_basis.cols(), count_);
    all_.length = Eigen::VectorXd::Zero(count_);
    begun_ = true;
  }
  void Take(std::span<const int> places, Linearisation at) {
    const Eigen::MatrixXd found = std::move(at.columns);
    const Eigen::MatrixXd along = std::move(at.along_fitted);
    const Eigen::VectorXd length = std::move(at.length);
    if (!begun_) Begin(std::move(at));
    int next = 0;
    for (const int place : places) {
      const auto i = static_cast<std::size_t>(place);
      for (int k = 0; k < tested_[i].parameter_count(); ++k, ++next) {
        all_.columns.col(column_of_[i] + k) = found.col(next);
        all_.along_fitted.col(column_of_[i] + k) = along.col(next);
        all_.length[column_of_[i] + k] = length[next];
      }
    }
  }

  const Extension& model_;
  std::span<const Candidate> tested_;
  const std::vector<TrialProblem>& train_;
  int jobs_;
  std::vector<int> column_of_;  // first column of each tested candidate
  int count_ = 0;
  bool begun_ = false;
  Linearisation all_;
  std::optional<Linearisation> bare_;
  std::vector<std::string> failed_;
};

}  // namespace

Linearisation LineariseAt(const Extension& model, std::span<const Candidate> tested,
                          const std::vector<TrialProblem>& train, int jobs) {
  std::array<std::vector<int>, 3> classes;  // places in `tested`
  for (std::size_t i = 0; i < tested.size(); ++i)
    classes[static_cast<std::size_t>(CostClass(tested[i]))].push_back(static_cast<int>(i));
  // What one run can hold beside the effects the model has.
  const std::size_t room = ActiveEffects<double>::kMax - model.problem.effects.size();
  Columns columns(model, tested, train, jobs);
  for (const std::vector<int>& places : classes) {
    for (std::size_t first = 0; first < places.size(); first += room)
      columns.Add(std::span(places).subspan(first, std::min(room, places.size() - first)));
  }
  return columns.Done();
}

}  // namespace hoplab
