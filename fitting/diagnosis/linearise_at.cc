#include "fitting/diagnosis/linearise_at.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "base/parallel.h"
#include "fitting/eliminated_trial.h"
#include "model/formula/formula.h"
#include "model/jet.h"

namespace hoplab {
namespace {

// What a run with this effect costs decides which effects are differentiated together: one that
// changes the leg's law, or is sharp, slows every column of its run.
int CostClass(const Candidate& candidate, bool of_robot) {
  const Effect& effect = *candidate.effect;
  if (effect.info.sharp) return 2;
  Parameters<double> p;
  if (of_robot) p.robot = RobotParameters<double>();
  if (effect.formula) {
    effect.formula->ChangeParameters(p);
    return p.law_terms.active ? 1 : 0;
  }
  if (!effect.hooks0.change_parameters) return 0;
  const EffectSetting at_null = EffectSetting::Null(effect);
  effect.hooks0.change_parameters(at_null.values.data(), p);
  return p.law_terms.active ? 1 : 0;
}

// Of the tolerances of a run that is repeated.
constexpr double kTightened = 1e-2;

using Places = std::vector<int>;

// Candidates that are differentiated together, by place: as many as one run of the simulator holds
// directions, so that no run carries an effect it is not differentiated by.
std::vector<Places> BatchesOf(std::span<const Candidate> tested, Law law) {
  const bool of_robot = MechanismOf(law) == MechanismKind::kRobot;
  std::array<Places, 3> classes;
  for (std::size_t i = 0; i < tested.size(); ++i)
    classes[static_cast<std::size_t>(CostClass(tested[i], of_robot))].push_back(
        static_cast<int>(i));
  std::vector<Places> batches;
  for (const Places& places : classes) {
    int directions = kWidestJet;
    for (const int place : places) {
      const int more = tested[static_cast<std::size_t>(place)].parameter_count();
      if (directions + more > kWidestJet) {
        batches.emplace_back();
        directions = 0;
      }
      batches.back().push_back(place);
      directions += more;
    }
  }
  return batches;
}

// One trial compressed: columns of the fitted values, then of the tested ones, own values projected
// out of all.
struct Part {
  EliminatedTrial rows;
  Eigen::VectorXd tested_square;
  Eigen::Index row_count = 0;
  int samples = 0;
  std::set<int> failed;  // places of candidates by which it cannot be differentiated
};

class TrialColumns {
 public:
  TrialColumns(const FittedModel& model, std::span<const Candidate> tested,
               const std::vector<int>& first_column, const std::vector<int>& fitted,
               const TrialProblem& trial, const OwnValues& own)
      : model_(model),
        tested_(tested),
        first_column_(first_column),
        fitted_(fitted),
        trial_(trial),
        own_(own),
        columns_(ParameterCount(tested)) {}

  Part Collect(const std::vector<Places>& batches) {
    Part part;
    const TrialEvaluation bare = EvaluateWith({}, std::nullopt);
    if (!bare.complete) return part;
    const int n = model_.problem.shared_count();
    // The layout EliminateOwn expects: fitted, tested, own.
    whole_ = bare;
    const auto f = static_cast<Eigen::Index>(fitted_.size());
    whole_.jacobian.setZero(bare.jacobian.rows(), f + columns_ + trial_.own_count());
    for (Eigen::Index k = 0; k < f; ++k) {
      const int place = fitted_[static_cast<std::size_t>(k)];
      whole_.jacobian.col(k) =
          bare.jacobian.col(place) * model_.problem.shared[static_cast<std::size_t>(place)].scale;
    }
    whole_.jacobian.rightCols(trial_.own_count()) = bare.jacobian.middleCols(n, trial_.own_count());
    for (const Places& batch : batches) Add(batch, part.failed);
    part.tested_square =
        whole_.jacobian.middleCols(f, columns_).colwise().squaredNorm().transpose();
    std::vector<KeptColumn> kept;
    for (int k = 0; k < static_cast<int>(f) + columns_; ++k) kept.push_back({k, 1.0});
    part.rows = EliminateOwn(trial_, whole_, static_cast<int>(f) + columns_, kept);
    part.row_count = bare.residuals.size();
    part.samples = bare.data_residuals;
    return part;
  }

 private:
  TrialEvaluation EvaluateWith(std::span<const Candidate> part, std::optional<ColumnRange> only,
                               double tightened = 1.0) const {
    FitProblem problem = ExtendWithoutTrials(part);
    problem.integrator.relative_tolerance *= tightened;
    problem.integrator.absolute_tolerance *= tightened;
    Eigen::VectorXd shared(problem.shared_count());
    shared << model_.shared, NullValues(part);
    TrialEvaluation e;
    TrialEvaluator(problem, trial_)
        .Evaluate({.shared = shared, .own = own_, .want_jacobian = true, .only = only}, e);
    return e;
  }
  FitProblem ExtendWithoutTrials(std::span<const Candidate> part) const {
    FitProblem bare;
    bare.law = model_.problem.law;
    bare.shared = model_.problem.shared;
    bare.effects = model_.problem.effects;
    bare.clocks = model_.problem.clocks;
    bare.channels = model_.problem.channels;
    bare.uses_contact = model_.problem.uses_contact;
    bare.contact_clock = model_.problem.contact_clock;
    bare.noise = model_.problem.noise;
    bare.integrator = model_.problem.integrator;
    return Extend(bare, part);
  }

  // Differentiated together. Where that fails, as it may for one that asks for too many steps, in
  // halves; one that fails alone is differentiated along a more accurate run, since a search may
  // have ended right beside a graze, and else keeps columns of zeros.
  void Add(std::span<const int> places, std::set<int>& failed) {
    std::vector<Candidate> part;
    for (const int place : places) part.push_back(tested_[static_cast<std::size_t>(place)]);
    const TrialEvaluation e =
        EvaluateWith(part, ColumnRange{model_.problem.shared_count(), ParameterCount(part)});
    if (e.complete && e.jacobian.allFinite()) return Take(places, e);
    if (places.size() == 1) {
      const TrialEvaluation tight = EvaluateWith(
          part, ColumnRange{model_.problem.shared_count(), ParameterCount(part)}, kTightened);
      if (tight.complete && tight.jacobian.allFinite()) return Take(places, tight);
      failed.insert(places.front());
      return;
    }
    Add(places.first(places.size() / 2), failed);
    Add(places.subspan(places.size() / 2), failed);
  }
  void Take(std::span<const int> places, const TrialEvaluation& e) {
    Eigen::Index next = 0;
    for (const int place : places) {
      const auto i = static_cast<std::size_t>(place);
      const Eigen::Index to = static_cast<Eigen::Index>(fitted_.size()) + first_column_[i];
      for (int k = 0; k < tested_[i].parameter_count(); ++k, ++next)
        whole_.jacobian.col(to + k) = e.jacobian.col(next);
    }
  }

  const FittedModel& model_;
  std::span<const Candidate> tested_;
  const std::vector<int>& first_column_;
  const std::vector<int>& fitted_;
  const TrialProblem& trial_;
  const OwnValues& own_;
  int columns_;
  TrialEvaluation whole_;
};

}  // namespace

Linearisation LineariseAt(const FittedModel& model, std::span<const Candidate> tested,
                          const std::vector<TrialProblem>& train, int jobs) {
  const std::vector<int> fitted = FreeShared(model.problem, model.shared);
  std::vector<int> first_column;
  int columns = 0;
  for (const Candidate& c : tested) {
    first_column.push_back(columns);
    columns += c.parameter_count();
  }
  const std::vector<Places> batches = BatchesOf(tested, model.problem.law);
  std::vector<Part> parts(train.size());
  ParallelFor(static_cast<int>(train.size()), jobs, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    parts[at] =
        TrialColumns(model, tested, first_column, fitted, train[at], model.initial_states[at])
            .Collect(batches);
  });

  std::vector<LinearisedTrial> trials(parts.size());
  std::map<int, int> failures;  // in how many trials, by place
  int simulated = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Part& p = parts[i];
    simulated += !p.rows.empty();
    for (const int place : p.failed) ++failures[place];
    LinearisedTrial& t = trials[i];
    const auto f = static_cast<Eigen::Index>(fitted.size());
    t.fitted = p.rows.columns.leftCols(p.rows.empty() ? 0 : f);
    t.tested = p.rows.columns.rightCols(p.rows.empty() ? 0 : columns);
    t.r = std::move(p.rows.residuals);
    t.tested_square = p.tested_square;
    t.own_rank = p.rows.own_rank;
    t.row_count = p.row_count;
    t.samples = p.samples;
    RowLabel label;
    label.trial = static_cast<int>(i);
    t.labels.assign(static_cast<std::size_t>(t.r.size()), label);
  }
  Linearisation out = Assemble(trials, static_cast<int>(fitted.size()), columns);
  for (const auto& [place, count] : failures) {
    if (count < simulated) continue;
    const auto i = static_cast<std::size_t>(place);
    out.failed.push_back(tested[i].Name());
    for (int k = first_column[i]; k < first_column[i] + tested[i].parameter_count(); ++k) {
      out.columns.col(k).setZero();
      out.along_fitted.col(k).setZero();
      out.length[k] = 0.0;
    }
  }
  return out;
}

void RestateUnseen(const std::vector<TrialProblem>& train, int jobs, FittedModel& model) {
  if (!model.ok()) return;
  const auto at = [&](const Eigen::VectorXd& shared) {
    return Linearise(model.problem, /*first_tested=*/0, train, shared, model.initial_states, jobs);
  };
  const Linearisation here = at(model.shared);
  Eigen::VectorXd restated = model.shared;
  for (Eigen::Index k = 0; k < restated.size() - model.parameter_count(); ++k)
    if (here.length[k] == 0.0)
      restated[k] = model.problem.shared[static_cast<std::size_t>(k)].initial;
  if (restated != model.shared && at(restated).raw == here.raw) model.shared = restated;
}

}  // namespace hoplab
