#include "fitting/diagnosis/set_aside.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace hoplab {
namespace {

bool IsOneOf(const std::vector<SetAside>& members, int candidate) {
  return std::any_of(members.begin(), members.end(),
                     [&](const SetAside& m) { return m.candidate == candidate; });
}

bool IsInAGroup(const Naming& naming, int candidate) {
  return std::any_of(naming.groups.begin(), naming.groups.end(), [&](const std::vector<int>& g) {
    return std::find(g.begin(), g.end(), candidate) != g.end();
  });
}

template <class T>
void Erase(std::vector<T>& of_members, const std::vector<std::size_t>& descending) {
  for (const std::size_t i : descending)
    of_members.erase(of_members.begin() + static_cast<std::ptrdiff_t>(i));
}

// What does as well in a member's place only if it can be fitted.
void ForgetFailedRivals(Naming& naming, std::size_t member, std::vector<int>& as_good) {
  std::vector<FittedModel>& rivals = naming.rivals[member];
  std::vector<double>& weights = naming.group_weights[member];
  for (std::size_t k = rivals.size(); k-- > 1;) {
    if (rivals[k].ok()) continue;
    const auto at = static_cast<std::ptrdiff_t>(k);
    rivals.erase(rivals.begin() + at);
    as_good.push_back(naming.groups[member][k]);
    naming.groups[member].erase(naming.groups[member].begin() + at);
    weights.erase(weights.begin() + at);
  }
  double sum = 0.0;
  for (const double weight : weights) sum += weight;
  if (sum > 0.0)
    for (double& weight : weights) weight /= sum;
}

}  // namespace

FittedModel Without(const FittedModel& model, const std::vector<SetAside>& members,
                    const FitProblem& null_problem, const RefitSettings& settings) {
  FittedModel less = model;
  // With the deviations that the model has in them.
  FitProblem null = null_problem;
  null.trials = model.problem.trials;
  const std::vector<TrialProblem> train = TrialsOf(null, TrialRole::kTrain);
  RefitSettings own = settings;
  own.train = &train;
  for (const SetAside& m : members) {
    const auto at = std::find(less.members.begin(), less.members.end(), m.cause);
    if (at == less.members.end() || !less.ok()) continue;
    less = RefitWithout(less, static_cast<int>(at - less.members.begin()), null, own);
    less.settled = false;
  }
  if (!less.settled) Settle(less, own);
  return less;
}

bool TakeOut(const std::vector<SetAside>& members, const FitProblem& null_problem,
             const RefitSettings& settings, Naming& naming) {
  const FittedModel best = Without(naming.best, members, null_problem, settings);
  if (!best.ok() || !best.settled) return false;
  std::vector<std::size_t> places;
  std::vector<int> as_good;  // they, and what does as well in their places
  for (std::size_t i = naming.best_set.size(); i-- > 0;) {
    if (!IsOneOf(members, naming.best_set[i])) continue;
    places.push_back(i);
    as_good.insert(as_good.end(), naming.groups[i].begin(), naming.groups[i].end());
  }
  Erase(naming.best_set, places);
  Erase(naming.groups, places);
  Erase(naming.rivals, places);
  Erase(naming.group_weights, places);
  Erase(naming.gaps, places);
  Erase(naming.wider, places);
  Erase(naming.without, places);
  std::vector<FittedModel*> others;
  for (FittedModel& without : naming.without) others.push_back(&without);
  for (std::vector<FittedModel>& group : naming.rivals) {
    group.front() = best;
    for (std::size_t k = 1; k < group.size(); ++k) others.push_back(&group[k]);
  }
  ParallelFor(static_cast<int>(others.size()), settings.jobs, [&](int i) {
    FittedModel& other = *others[static_cast<std::size_t>(i)];
    other = Without(other, members, null_problem, settings);
  });
  for (std::size_t m = 0; m < naming.rivals.size(); ++m) ForgetFailedRivals(naming, m, as_good);
  naming.best = best;
  for (const int i : as_good)
    if (!IsInAGroup(naming, i))
      naming.candidates[static_cast<std::size_t>(i)].status = CandidateStatus::kNotNeeded;
  return true;
}

double ProbabilityOf(const std::vector<SetAside>& members) {
  double least = 1.0;
  for (const SetAside& m : members) least = std::min(least, m.group_probability);
  return least;
}

void TakeAllOut(const std::vector<SetAside>& members, const FittedModel& null, Naming& naming) {
  naming.unlisted_probability = 1.0 - ProbabilityOf(members);
  for (const std::vector<int>& group : naming.groups)
    for (const int i : group)
      naming.candidates[static_cast<std::size_t>(i)].status = CandidateStatus::kNotNeeded;
  naming.best = null;
  naming.best_set.clear();
  naming.groups.clear();
  naming.rivals.clear();
  naming.group_weights.clear();
  naming.gaps.clear();
  naming.wider.clear();
  naming.without.clear();
}

void Doubt(const std::vector<SetAside>& members, std::vector<OtherModel>& models) {
  for (OtherModel& model : models) {
    for (const SetAside& m : members) {
      if (m.candidate == model.candidate)
        model.log_odds =
            std::min(model.log_odds, m.by_whole_trials ? 0.0 : LogOddsOf(m.probability));
      else if (std::find(m.group.begin(), m.group.end(), model.candidate) != m.group.end())
        model.log_odds =
            std::min(model.log_odds, LogOddsOf(std::max(m.group_probability - m.probability, 0.0)));
    }
  }
  std::erase_if(models,
                [](const OtherModel& model) { return !(model.log_odds > std::log(kRuledOut)); });
}

}  // namespace hoplab
