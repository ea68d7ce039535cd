#include "fitting/diagnosis/refits.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "fitting/uncertainty.h"

namespace hoplab {
namespace {

// Every refit gets so many iterations; those that may come this close to the best [nats] as many
// more goes as this.
constexpr int kFirstIterations = 10;
constexpr double kContention = 25.0;
constexpr int kMostContinuations = 4;
// A member that is worth this many penalties by the linear model will not be missed for less than
// one, whatever valley the model without it lies in.
constexpr double kIndispensable = 30.0;

}  // namespace

Refits::Refits(const Extension& null, const std::vector<TrialProblem>& train,
               const NamingOptions& options, Naming& naming)
    : null_(null), train_(train), options_(options), naming_(naming) {
  refit_.train = &train_;
  refit_.stop = options.stop;
}

double Refits::PenaltyOf(const Model& model) const {
  double sum = 0.0;
  for (int i : model)
    sum += CandidateAt(i).parameter_count() *
           (CandidateAt(i).only_recording.empty() ? naming_.penalty : naming_.local_penalty);
  return sum;
}

Model Refits::Better(Model current, const std::vector<Model>& models, Effort effort) {
  RefitAll(models, effort);
  for (const Model& m : models) {
    if (Usable(m) && Worth(m) > Worth(current) + 1e-6) current = m;
  }
  return current;
}

void Refits::RefitAll(const std::vector<Model>& models, Effort effort) {
  std::vector<Model> missing;
  for (const Model& m : models) {
    if (!m.empty() && !models_.count(m) &&
        std::find(missing.begin(), missing.end(), m) == missing.end())
      missing.push_back(m);
  }
  std::vector<Extension> results(missing.size());
  RefitSettings settings = refit_;
  settings.max_iterations = kFirstIterations;
  if (effort == Effort::kWhileInContention) settings.give_up_above = BestCost() + kContention;
  const int planned = naming_.refits + static_cast<int>(missing.size());
  ParallelFor(static_cast<int>(missing.size()), options_.jobs, [&](int i) {
    if (Stopped()) return;
    results[i] = RefitModel(missing[i], settings);
    if (options_.progress) {
      const std::lock_guard lock(mutex_);
      options_.progress(++naming_.refits, planned, NamesOf(missing[i]));
    }
  });
  for (std::size_t i = 0; i < missing.size(); ++i)
    models_.emplace(missing[i], std::move(results[i]));
  Finish(missing, effort);
  if (!options_.progress) naming_.refits += static_cast<int>(missing.size());
}

double Refits::BestCost() const {
  double best = null_.cost;
  for (const auto& [model, e] : models_) {
    if (e.ok()) best = std::min(best, e.cost);
  }
  return best;
}

// Refits that ran out of iterations go on: those that may come near the best known model, where a
// nat decides; the others once, if they are wanted to the end.
void Refits::Finish(const std::vector<Model>& models, Effort effort) {
  RefitSettings contending = refit_;
  contending.give_up_above = BestCost() + kContention;
  ParallelFor(static_cast<int>(models.size()), options_.jobs, [&](int i) {
    Extension& e = models_.at(models[i]);
    for (int round = 0; round < kMostContinuations && !Stopped(); ++round) {
      if (e.status != SolveStatus::kIterationLimit) return;
      const bool anyway = round == 0 && effort == Effort::kToTheEnd;
      Extension further = Refit(e, {}, Eigen::VectorXd(0), anyway ? refit_ : contending);
      if (!further.ok()) return;
      e = std::move(further);
    }
  });
}

std::string Refits::NamesOf(const Model& model) const {
  std::string names;
  for (int i : model) names += (names.empty() ? "" : " + ") + CandidateAt(i).Name();
  return names;
}

Extension Refits::RefitModel(const Model& model, const RefitSettings& settings) const {
  // From the best refitted model with one member less; its missing member at its expected size.
  Model part;
  for (std::size_t i = 0; i < model.size(); ++i) {
    Model less = model;
    less.erase(less.begin() + static_cast<std::ptrdiff_t>(i));
    if (!Usable(less) || less.empty()) continue;
    if (part.empty() || At(less).cost < At(part).cost) part = less;
  }
  std::vector<int> added;
  std::set_difference(model.begin(), model.end(), part.begin(), part.end(),
                      std::back_inserter(added));
  std::vector<Candidate> candidates;
  for (int i : added) candidates.push_back(CandidateAt(i));
  Eigen::VectorXd sizes(ParameterCount(candidates));
  if (part.empty() && added.size() == 1 && CandidateAt(added[0]).only_recording.empty()) {
    sizes = naming_.candidates[added[0]].score.size;
  } else {
    const Linearisation at = LineariseAt(At(part), candidates, train_, 1);
    const Eigen::Index n = sizes.size();
    const Hypothesis all{0, static_cast<int>(n), Eigen::VectorXd::Constant(n, -1.0),
                         Eigen::VectorXd::Constant(n, 1.0)};
    sizes = ScoreOf(at, all).size;
  }
  Extension e = Refit(At(part), candidates, sizes, settings);
  // Where the refit falls well short of the linear forecast, it went into the wrong valley: the
  // forecast was too far out, or the effect too bent.
  const double forecast =
      part.empty() && added.size() == 1 ? naming_.candidates[added[0]].score.predicted_gain : 0.0;
  if (forecast > naming_.penalty && (!e.ok() || At(part).cost - e.cost < 0.15 * forecast)) {
    for (double share : {0.3, 0.1}) {
      Extension again = Refit(At(part), candidates, share * sizes, settings);
      if (again.ok() && (!e.ok() || again.cost < e.cost)) e = std::move(again);
    }
  }
  return Ordered(std::move(e), part, added, model);
}

// Members in the order of the pool, whatever order they were added in.
Extension Refits::Ordered(Extension e, const Model& part, const std::vector<int>& added,
                          const Model& model) const {
  std::vector<int> order = part;
  order.insert(order.end(), added.begin(), added.end());
  if (order == model) return e;
  Extension sorted = e;
  sorted.members.clear();
  for (int i : model) sorted.members.push_back(CandidateAt(i));
  sorted.problem = Extend(null_.problem, sorted.members);
  Eigen::Index next = null_.shared.size();
  for (int i : model) {
    const auto at = std::find(order.begin(), order.end(), i) - order.begin();
    const Eigen::VectorXd values = e.ValuesOf(static_cast<int>(at));
    sorted.shared.segment(next, values.size()) = values;
    next += values.size();
  }
  return sorted;
}

// Log-likelihood that each member is worth by the linear model [nats]: half the square of its
// greatest distance from null in standard errors.
std::vector<double> Refits::LinearWorth(const Extension& e) const {
  const Uncertainty u =
      AssessUncertainty(e.problem, train_, e.shared, e.starts, Loss(), options_.jobs);
  std::vector<double> worth;
  int place = null_.problem.shared_count();
  for (const Candidate& member : e.members) {
    double most = 0.0;
    for (int k = 0; k < member.parameter_count(); ++k, ++place) {
      const std::optional<double>& error = u.parameters[static_cast<std::size_t>(place)].std_error;
      const double away =
          e.shared[place] - member.effect->info.parameters[static_cast<std::size_t>(k)].null;
      if (error && *error > 0.0) most = std::max(most, 0.5 * std::pow(away / *error, 2));
    }
    worth.push_back(most);
  }
  return worth;
}

void Refits::RefineParts(const Model& model) {
  const std::vector<Model> parts = Eliminations(model);
  RefitAll(parts, Effort::kToTheEnd);
  const std::vector<double> worth = LinearWorth(At(model));
  std::vector<Extension> refined(parts.size());
  ParallelFor(static_cast<int>(parts.size()), options_.jobs, [&](int i) {
    const double lost = At(parts[i]).ok() ? At(parts[i]).cost - At(model).cost : 0.0;
    const double enough = kIndispensable * naming_.penalty;
    if (lost > enough && worth[static_cast<std::size_t>(i)] > enough) return;
    refined[i] = RefitWithout(At(model), i, null_.problem, refit_);
  });
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Extension& known = models_.at(parts[i]);
    if (refined[i].ok() && (!known.ok() || refined[i].cost < known.cost)) known = refined[i];
  }
}

std::vector<Model> Eliminations(const Model& model) {
  std::vector<Model> models;
  for (std::size_t i = 0; i < model.size() && model.size() > 1; ++i) {
    Model less = model;
    less.erase(less.begin() + static_cast<std::ptrdiff_t>(i));
    models.push_back(less);
  }
  return models;
}

}  // namespace hoplab
