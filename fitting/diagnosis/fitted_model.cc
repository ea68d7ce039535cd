#include "fitting/diagnosis/fitted_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fitting/apex_segments.h"
#include "fitting/discrepancy/restricted_likelihood.h"
#include "fitting/growing_horizon.h"
#include "fitting/threshold.h"
#include "model/mechanism_traits.h"

namespace hoplab {
namespace {

// Likelihoods are compared to well below a nat; where costs are large, so are their differences.
constexpr double kCostTolerance = 1e-6;

// Nats a look beyond a threshold must gain to be followed.
constexpr double kWorthFollowing = 4.0;

// A size whose beginning costs so many times what the base does is not the linear forecast's.
constexpr double kFarOff = 10.0;

// A start inside the bounds, off null so that a derivative that ends there has a side.
double Inside(const SharedParameter& s, double value) {
  const double room = std::min(1e-3 * s.scale, 0.25 * (s.upper - s.lower));
  return std::clamp(value, s.lower + room, s.upper - room);
}

// A search from where a model is.
SolveRequest RequestFrom(const FittedModel& e, const RefitSettings& settings) {
  SolveRequest request;
  request.problem = &e.problem;
  request.trials = settings.train;
  request.shared = e.shared;
  request.initial_states = e.initial_states;
  request.max_iterations = settings.max_iterations;
  request.function_tolerance = kCostTolerance;
  request.jobs = settings.jobs;
  request.stop = settings.stop;
  return request;
}

void Take(FittedModel& e, const SolveResult& result) {
  e.shared = result.shared;
  e.initial_states = result.initial_states;
  e.cost = result.cost;
  e.status = result.status;
  e.complete = result.complete;
}

std::vector<OwnValues> NominalInitialStates(const std::vector<TrialProblem>& trials) {
  std::vector<OwnValues> initial_states;
  for (const TrialProblem& t : trials) initial_states.push_back(t.start);
  return initial_states;
}

// What a look is taken at: the hops of some of the trials, each from the apex its data show, so
// that an early error does not turn the later ones; where no apexes are seen, those trials.
struct Glance {
  std::vector<TrialProblem> trials;
  std::vector<OwnValues> initial_states;
  bool of_hops = false;
};
Glance GlanceAt(const FitProblem& problem, const std::vector<TrialProblem>& trials,
                const std::vector<OwnValues>& initial_states) {
  constexpr std::size_t kMost = 12;
  const std::size_t n = std::min(kMost, trials.size());
  Glance whole, hops;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = i * trials.size() / n;
    whole.trials.push_back(trials[k]);
    whole.initial_states.push_back(initial_states[k]);
  }
  hops.trials = CutAllAtApexes(problem, whole.trials);
  if (hops.trials.empty()) return whole;
  hops.initial_states = NominalInitialStates(hops.trials);
  hops.of_hops = true;
  return hops;
}

// Starts that suit values found on hops: those of another model would lead them back to it.
std::vector<OwnValues> InitialStatesFor(SolveRequest request) {
  request.initial_states = NominalInitialStates(*request.trials);
  request.hold_shared = true;
  const SolveResult found = GrowHorizon(request);
  return IsUsable(found.status) ? found.initial_states : request.initial_states;
}

void ClampToBounds(SolveRequest& request) {
  for (Eigen::Index k = 0; k < request.shared.size(); ++k) {
    const SharedParameter& s = request.problem->shared[static_cast<std::size_t>(k)];
    request.shared[k] = std::clamp(request.shared[k], s.lower, s.upper);
  }
}

bool LedOn(const SolveResult& result) { return IsUsable(result.status) && result.complete; }

// Where the search for a model with added candidates begins: their sizes, brought inside the
// bounds.
Eigen::VectorXd Beginning(const FittedModel& e, const Eigen::VectorXd& kept,
                          const Eigen::VectorXd& null_values, const Eigen::VectorXd& sizes) {
  Eigen::VectorXd shared(kept.size() + sizes.size());
  shared.head(kept.size()) = kept;
  for (Eigen::Index k = 0; k < sizes.size(); ++k) {
    const SharedParameter& s = e.problem.shared[static_cast<std::size_t>(kept.size() + k)];
    const double size = std::isfinite(sizes[k]) ? sizes[k] : 0.0;
    shared[kept.size() + k] = Inside(s, null_values[k] + size);
  }
  return shared;
}

}  // namespace

int FittedModel::PlaceOf(int i) const {
  return problem.shared_count() - parameter_count() +
         ParameterCount(std::span(members).first(static_cast<std::size_t>(i)));
}

Eigen::VectorXd FittedModel::ValuesOf(int i) const {
  return shared.segment(PlaceOf(i), members[static_cast<std::size_t>(i)].parameter_count());
}

bool FittedModel::AtNull(int i) const {
  const int first = PlaceOf(i);
  const Candidate& member = members[static_cast<std::size_t>(i)];
  for (int k = 0; k < member.parameter_count(); ++k) {
    const EffectParameter& p = member.Parameter(k);
    if (!p.is_shape && !p.is_of_first &&
        std::abs(shared[first + k] - p.null) > 1e-6 * std::abs(p.typical))
      return false;
  }
  return true;
}

bool FittedModel::AtPhysicalBound(int i) const {
  const int first = PlaceOf(i);
  const Candidate& member = members[static_cast<std::size_t>(i)];
  for (int k = 0; k < member.parameter_count(); ++k) {
    const int place = first + k;
    const SharedParameter& s = problem.shared[static_cast<std::size_t>(place)];
    const double null = member.Parameter(k).null, near = 1e-6 * s.scale;
    const double value = shared[place];
    if (value <= s.lower + near && null > s.lower + near) return true;
    if (value >= s.upper - near && null < s.upper - near) return true;
  }
  return false;
}

bool FittedModel::has_own_sizes() const {
  return std::any_of(members.begin(), members.end(),
                     [](const Candidate& c) { return c.each_trial; });
}

FittedModel Refit(const FittedModel& base, std::span<const Candidate> added,
                  const Eigen::VectorXd& sizes, const RefitSettings& settings) {
  // A search that gains less than this share of the forecast went into the wrong valley.
  constexpr double kFair = 0.15;
  FittedModel e;
  e.members = base.members;
  e.members.insert(e.members.end(), added.begin(), added.end());
  e.problem = Extend(base.problem, added);
  e.initial_states = base.initial_states;
  const Eigen::VectorXd null = NullValues(added);
  SolveRequest request = RequestFrom(e, settings);
  request.give_up_above = std::min(settings.give_up_above, base.cost);
  request.start_below = kFarOff * base.cost;
  std::vector<Eigen::VectorXd> begun;
  // A large effect may end a simulation early, or lead far off, where the fitted values are not yet
  // its own; and more values cannot fit worse: a search that ended above its base went astray.
  for (const double share : {1.0, 0.3, 0.1, 0.0}) {
    const bool below_base = e.ok() && e.cost <= base.cost;
    if (below_base && (share == 0.0 || base.cost - e.cost >= kFair * settings.forecast)) break;
    request.shared = Beginning(e, base.shared, null, share * sizes);
    if (std::find(begun.begin(), begun.end(), request.shared) != begun.end()) continue;
    begun.push_back(request.shared);
    const SolveResult result = Solve(request);
    const bool better = IsUsable(result.status) && result.complete && result.cost < e.cost;
    if (begun.size() == 1 || !e.ok() || better) Take(e, result);
  }
  if (e.ok() && e.cost > base.cost) {
    e.shared << base.shared, null;
    e.initial_states = base.initial_states;
    e.cost = base.cost;
  }
  return e;
}

void RefitBeyondThresholds(FittedModel& model, const FittedModel& base,
                           const RefitSettings& settings) {
  const Eigen::VectorXd of_added =
      NullValues(std::span(model.members).subspan(base.members.size()));
  Eigen::VectorXd null(base.shared.size() + of_added.size());
  null << base.shared, of_added;
  const Eigen::VectorXd others = model.ok() ? model.shared : null;
  const std::vector<Eigen::VectorXd> beginnings =
      BeginningsBeyondThresholds(model.problem, others, static_cast<int>(base.shared.size()));
  if (beginnings.empty()) return;
  FittedModel from = model;
  from.initial_states = base.initial_states;
  SolveRequest request = RequestFrom(from, settings);
  // Where it begins, what stood in for it is still in place, and costs much. So short searches look
  // which beginning comes to something.
  constexpr int kLook = 20;
  const Glance glance = GlanceAt(model.problem, *settings.train, base.initial_states);
  request.trials = &glance.trials;
  request.initial_states = glance.initial_states;
  request.max_iterations = kLook;
  request.shared = others;
  // A robot's search over all rows at once may end in another order of events.
  const bool grows = TraitsOf(model.problem.law).lands_leg_by_leg;
  Rounds of_without;
  const SolveResult without = grows ? GrowHorizonBeside(request, {}, of_without) : Solve(request);
  const SolveResult* best = &without;
  std::vector<SolveResult> looks;
  looks.reserve(beginnings.size());
  for (const Eigen::VectorXd& begun : beginnings) {
    if (settings.stop && *settings.stop) return;
    request.shared = begun;
    Rounds own;
    const SolveResult& found =
        looks.emplace_back(grows ? GrowHorizonBeside(request, of_without, own) : Solve(request));
    if (LedOn(found) && (found.cost < best->cost || !LedOn(*best))) best = &found;
  }
  if (best == &without || (LedOn(without) && without.cost - best->cost < kWorthFollowing)) return;
  request = RequestFrom(from, settings);
  request.shared = best->shared;
  if (glance.of_hops) request.initial_states = InitialStatesFor(request);
  request.max_iterations = 2 * settings.max_iterations;
  request.give_up_above = model.ok() ? model.cost : settings.give_up_above;
  SolveResult found = grows ? GrowHorizon(request) : Solve(request);
  const double least = kCostTolerance * std::abs(model.cost);  // less is rounding
  if (LedOn(found) && (!model.ok() || model.cost - found.cost > least)) Take(model, found);
}

FittedModel RefitWithout(const FittedModel& base, int i, const FitProblem& null_problem,
                         const RefitSettings& settings) {
  FittedModel e;
  const int place = base.PlaceOf(i);
  const int count = base.members[static_cast<std::size_t>(i)].parameter_count();
  e.members = base.members;
  e.members.erase(e.members.begin() + i);
  e.problem = Extend(null_problem, e.members);
  e.problem.noise = base.problem.noise;
  e.shared.resize(base.shared.size() - count);
  e.shared << base.shared.head(place), base.shared.tail(base.shared.size() - place - count);
  e.initial_states = base.initial_states;
  Take(e, Solve(RequestFrom(e, settings)));
  return e;
}

FittedModel LeadOut(const FittedModel& base, int i, const FitProblem& null_problem,
                    double plain_cost, const RefitSettings& settings) {
  constexpr double kFirstStep = 0.25, kGrowth = 1.5;  // of the size
  constexpr int kMostSteps = 24;
  // What misses the data grows as the square of what is taken out, all of it missing what the plain
  // model does. A search that rises further has lost its way, one that wanders about even sooner.
  constexpr double kMostRise = 2.0, kWandering = 2.0;
  const auto member = static_cast<std::size_t>(i);
  const int place = base.PlaceOf(i), count = base.members[member].parameter_count();
  const Eigen::VectorXd null = NullValues(std::span(base.members).subspan(member, 1));
  const Eigen::VectorXd size = base.ValuesOf(i) - null;
  FittedModel before = base, at = base;
  double share_before = 1.0, share = 1.0, step = kFirstStep;
  for (int tries = 0; share > 0.0; ++tries) {
    if (tries == kMostSteps || (settings.stop && *settings.stop)) return {};
    const double next = std::max(0.0, share - step);
    SolveRequest request = RequestFrom(at, settings);
    // On along the way it went before, if it did.
    const double on = share < share_before ? (share - next) / (share_before - share) : 0.0;
    request.shared += on * (at.shared - before.shared);
    for (std::size_t t = 0; t < at.initial_states.size(); ++t)
      request.initial_states[t] += on * (at.initial_states[t] - before.initial_states[t]);
    ClampToBounds(request);
    request.shared.segment(place, count) = null + next * size;
    for (int k = 0; k < count; ++k) request.held.push_back(place + k);
    const SolveResult found = Solve(request);
    const double out = 1.0 - next, rise = std::max(0.0, plain_cost - base.cost);
    const double most = found.status == SolveStatus::kConverged
                            ? base.cost + kMostRise * out * out * rise
                            : kWandering * at.cost;
    const bool follows = LedOn(found) && found.cost < std::max(most, kWandering * at.cost);
    step *= follows ? kGrowth : 0.5;
    if (!follows) continue;
    before = at;
    share_before = share;
    Take(at, found);
    share = next;
  }
  return RefitWithout(at, i, null_problem, settings);
}

std::vector<Candidate> CandidatesBeside(const FittedModel& model,
                                        std::span<const Candidate> candidates) {
  std::vector<Candidate> others;
  for (const Candidate& c : candidates) {
    if (std::none_of(model.members.begin(), model.members.end(),
                     [&](const Candidate& m) { return m.effect == c.effect; }))
      others.push_back(c);
  }
  return others;
}

bool EndFit(FittedModel& model, const RefitSettings& settings) {
  const SolveResult found = Solve(RequestFrom(model, settings));
  if (!LedOn(found)) return false;
  if (found.cost <= model.cost) Take(model, found);
  return true;
}

void Settle(FittedModel& model, const RefitSettings& settings) {
  if (!model.ok()) return;
  // A trial refit may have stopped short of the minimum.
  EndFit(model, settings);
  SettleNoise(model, settings);
}

void SettleNoise(FittedModel& model, const RefitSettings& settings, const NoiseModel& also) {
  LikelihoodDetail detail;
  detail.prior_widths = PriorWidths(model.problem, model.shared);
  const RestrictedLikelihood likelihood(model.problem, *settings.train, model.shared,
                                        model.initial_states, settings.jobs, detail);
  model.settled = likelihood.complete();
  if (!model.settled) return;
  const RestrictedLikelihood coarse = likelihood.With(LikelihoodDetail::Coarse());
  if (settings.discrepancy == Discrepancy::kMatern) {
    const NoiseModel near = model.problem.noise;
    model.discrepancy = EstimateDiscrepancy(coarse, near, /*known_only=*/!near.IsWhite());
    model.problem.noise = model.discrepancy.noise;
  }
  model.evidence = EvidenceOf(model.problem, model.shared, likelihood, coarse, model.problem.noise);
  if (also.IsWhite()) return;
  const Evidence other = EvidenceOf(model.problem, model.shared, likelihood, coarse, also);
  if (other.log_z() <= model.evidence.log_z()) return;
  model.evidence = other;
  model.problem.noise = model.discrepancy.noise = also;
  model.discrepancy.log_likelihood = coarse.At(also);
}

}  // namespace hoplab
