#include "fitting/diagnosis/refits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "fitting/diagnosis/linearise_at.h"

namespace hoplab {
namespace {

// Iterations of a trial refit; one that is settled has as many more as it needs.
constexpr int kTryIterations = 12;
// What a cause loses whose size ends at a physical bound, as if one true cause in 20000 did
// [nats]: a choice, not a measured rate.
constexpr double kAtBound = 10.0;
// A linear forecast worth a second try where its refit falls short [nats].
constexpr double kForecast = 8.0;
// Costs nearer to each other are one valley's [nats].
constexpr double kSame = 0.01;

}  // namespace

Refits::Refits(const FittedModel& plain, const FittedModel& null,
               const std::vector<TrialProblem>& train, const NamingOptions& options, Naming& naming)
    : plain_(plain), null_(null), train_(train), options_(options), naming_(naming) {
  refit_.train = &train_;
  refit_.stop = options.stop;
  refit_.discrepancy = options.discrepancy;
  refit_.jobs = options.jobs;
}

// One expected in all; trials picked out of many must pay for the picking.
double Refits::LogPrior(const CandidateSet& set) const {
  double sum = 0.0;
  for (const int i : set) sum -= naming_.LogOdds(CandidateAt(i));
  return sum;
}

double Refits::Worth(const CandidateSet& set) const {
  const FittedModel& model = At(set);
  double worth = model.evidence.log_z() + LogPrior(set);
  for (int i = 0; i < static_cast<int>(set.size()); ++i) {
    // The set without it says as much.
    if (model.AtNull(i)) return -std::numeric_limits<double>::infinity();
    if (model.AtPhysicalBound(i)) worth -= kAtBound;
  }
  return worth;
}

CandidateSet Refits::Better(CandidateSet current, const std::vector<CandidateSet>& sets, int width,
                            const std::vector<CandidateSet>& anyway) {
  std::vector<CandidateSet> promising;
  for (const CandidateSet& set : sets)
    if (std::find(promising.begin(), promising.end(), set) == promising.end())
      promising.push_back(set);
  std::erase_if(promising, [&](const CandidateSet& set) { return !MayBeTold(set); });
  Try(promising);
  std::erase_if(promising, [&](const CandidateSet& set) { return !Usable(set); });
  std::stable_sort(
      promising.begin(), promising.end(),
      [&](const CandidateSet& a, const CandidateSet& b) { return White(a).cost < White(b).cost; });
  if (promising.size() > static_cast<std::size_t>(width))
    promising.resize(static_cast<std::size_t>(width));
  for (const CandidateSet& set : anyway) {
    if (MayBeTold(set) && Usable(set) &&
        std::find(promising.begin(), promising.end(), set) == promising.end())
      promising.push_back(set);
  }
  SettleAll(promising);
  for (const CandidateSet& set : promising) {
    if (Settled(set) && Worth(set) > Worth(current) + 1e-6) current = set;
  }
  return current;
}

CandidateSet Refits::Adopt(const FittedModel& model) {
  CandidateSet order;
  for (const Candidate& member : model.members) {
    const auto at = std::find_if(naming_.candidates.begin(), naming_.candidates.end(),
                                 [&](const CandidateResult& c) { return c.candidate == member; });
    if (at == naming_.candidates.end()) return {};
    order.push_back(static_cast<int>(at - naming_.candidates.begin()));
  }
  CandidateSet set = order;
  std::sort(set.begin(), set.end());
  FittedModel& white = models_[set].white;
  white = Ordered(model, order, set);
  white.settled = false;
  return set;
}

void Refits::Try(const std::vector<CandidateSet>& sets) {
  std::vector<CandidateSet> missing;
  for (const CandidateSet& set : sets) {
    if (!Has(set) && std::find(missing.begin(), missing.end(), set) == missing.end())
      missing.push_back(set);
  }
  planned_ += static_cast<int>(missing.size());
  std::vector<FittedModel> results(missing.size());
  ParallelFor(static_cast<int>(missing.size()), options_.jobs, [&](int i) {
    if (Stopped()) return;
    results[i] = Refitted(missing[i]);
    Report(missing[i], "");
  });
  for (std::size_t i = 0; i < missing.size(); ++i)
    models_[missing[i]].white = std::move(results[i]);
}

void Refits::SettleAll(const std::vector<CandidateSet>& sets) {
  std::vector<Entry*> open;
  std::vector<const CandidateSet*> names;
  std::vector<NoiseModel> near;  // before any is settled: no model waits for another
  for (const CandidateSet& set : sets) {
    if (set.empty() || !Usable(set) || Settled(set)) continue;
    Entry* entry = &models_.at(set);
    const bool lost_a_trial = entry->settled.ok();  // SettleNoise
    if (lost_a_trial || std::find(open.begin(), open.end(), entry) != open.end()) continue;
    open.push_back(entry);
    names.push_back(&set);
    near.push_back(NoiseNear(set));
  }
  planned_ += static_cast<int>(open.size());
  ParallelFor(static_cast<int>(open.size()), options_.jobs, [&](int i) {
    if (Stopped()) return;
    FittedModel model = open[i]->white;
    model.problem.noise = near[i];
    Settle(model, refit_);
    open[i]->settled = std::move(model);
    Report(*names[i], ", its noise");
  });
}

void Refits::Report(const CandidateSet& set, std::string_view what) {
  const std::lock_guard lock(mutex_);
  ++naming_.refits;
  if (options_.progress)
    options_.progress(naming_.refits, planned_, NamesOf(set) + std::string(what));
}

std::string Refits::NamesOf(const CandidateSet& set) const {
  std::string names;
  for (const int i : set) names += (names.empty() ? "" : " + ") + CandidateAt(i).Name();
  return names;
}

// The set with one member less that fits best under white noise; empty: the null fit.
CandidateSet Refits::BestPart(const CandidateSet& set) const {
  CandidateSet best;
  for (const CandidateSet& less : Eliminations(set)) {
    if (Usable(less) && White(less).cost < White(best).cost) best = less;
  }
  return best;
}

// A noise is sought from what is left, and from that of the set's best settled part.
NoiseModel Refits::NoiseNear(const CandidateSet& set) const {
  const NoiseModel* near = &null_.problem.noise;
  double worth = -std::numeric_limits<double>::infinity();
  for (const CandidateSet& less : Eliminations(set)) {
    if (!Settled(less) || !(Worth(less) > worth)) continue;
    worth = Worth(less);
    near = &At(less).problem.noise;
  }
  return *near;
}

FittedModel Refits::Refitted(const CandidateSet& set) const {
  const CandidateSet part = BestPart(set);
  CandidateSet added;
  std::set_difference(set.begin(), set.end(), part.begin(), part.end(), std::back_inserter(added));
  std::vector<Candidate> candidates;
  for (const int i : added) candidates.push_back(CandidateAt(i));
  const FittedModel& base = White(part);
  const Linearisation at = LineariseAt(base, candidates, train_, options_.jobs);
  const Eigen::Index n = ParameterCount(candidates);
  const Hypothesis all{0, static_cast<int>(n), Eigen::VectorXd::Constant(n, -1.0),
                       Eigen::VectorXd::Constant(n, 1.0)};
  const Score score = ScoreOf(at, all);
  RefitSettings settings = refit_;
  settings.max_iterations = kTryIterations;
  if (score.predicted_gain > kForecast) settings.forecast = score.predicted_gain;
  FittedModel e = Refit(base, candidates, score.size, settings);
  RefitBeyondThresholds(e, base, settings);  // no slope tells of them
  e.settled = false;
  CandidateSet order = part;
  order.insert(order.end(), added.begin(), added.end());
  return Ordered(std::move(e), order, set);
}

// Members in the order of the pool, whatever order they were added in.
FittedModel Refits::Ordered(FittedModel e, const CandidateSet& order,
                            const CandidateSet& set) const {
  if (order == set) return e;
  FittedModel sorted = e;
  sorted.members.clear();
  for (const int i : set) sorted.members.push_back(CandidateAt(i));
  sorted.problem = Extend(plain_.problem, sorted.members);
  sorted.problem.noise = e.problem.noise;
  Eigen::Index next = plain_.shared.size();
  for (const int i : set) {
    const auto at = std::find(order.begin(), order.end(), i) - order.begin();
    const Eigen::VectorXd values = e.ValuesOf(static_cast<int>(at));
    sorted.shared.segment(next, values.size()) = values;
    next += values.size();
  }
  return sorted;
}

std::vector<CandidateSet> Refits::SettleParts(const CandidateSet& set) {
  const std::vector<CandidateSet> parts = Eliminations(set);
  // From the same whole the same would come of it.
  const auto [of_set, is_first] = parted_.try_emplace(set, White(set).cost);
  if (!is_first && of_set->second == White(set).cost) {
    SettleAll(parts);
    return parts;
  }
  of_set->second = White(set).cost;
  // A part that was not tried yet, or was tried from elsewhere and fits worse, is refitted from the
  // whole: where that has found a better valley, its parts are in it too.
  std::vector<FittedModel> from_whole(parts.size());
  planned_ += static_cast<int>(parts.size());
  ParallelFor(static_cast<int>(parts.size()), options_.jobs, [&](int i) {
    if (Stopped() || parts[i].empty()) return;
    RefitSettings settings = refit_;
    if (Usable(parts[i])) settings.give_up_above = White(parts[i]).cost - kSame;
    from_whole[i] = RefitWithout(White(set), i, plain_.problem, settings);
    Report(parts[i], ", from the whole");
  });
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!parts[i].empty()) TakeIfBetter(std::move(from_whole[i]), parts[i]);
  SettleAll(parts);
  return parts;
}

CandidateSet Refits::BestPart(const CandidateSet& set, int most) {
  const bool too_many = static_cast<int>(set.size()) > most;
  CandidateSet best = set;
  for (const CandidateSet& less : SettleParts(set)) {
    if (!Settled(less)) continue;
    if ((too_many && best == set) || Worth(less) > Worth(best)) best = less;
  }
  return best;
}

bool Refits::TakeIfBetter(FittedModel found, const CandidateSet& set) {
  if (!found.ok()) return false;
  Entry& known = models_[set];
  if (known.white.ok() && known.white.cost < found.cost + kSame) return false;
  known.white = std::move(found);
  known.white.settled = false;
  known.settled = FittedModel();
  return true;
}

bool Refits::SettleByLeadingOut(const CandidateSet& set) {
  if (set.size() < 2) return false;
  const std::vector<CandidateSet> parts = Eliminations(set);
  std::vector<FittedModel> led(parts.size());
  const auto loses_most = [&](const CandidateSet& part) {
    return !Usable(part) || Gain(part) < 0.5 * Gain(set);
  };
  planned_ += static_cast<int>(std::count_if(parts.begin(), parts.end(), loses_most));
  ParallelFor(static_cast<int>(parts.size()), options_.jobs, [&](int i) {
    if (Stopped() || !loses_most(parts[i])) return;
    led[i] = LeadOut(White(set), i, plain_.problem, plain_.cost, refit_);
    Report(parts[i], ", by small steps");
  });
  bool better = false;
  for (std::size_t i = 0; i < parts.size(); ++i)
    better |= TakeIfBetter(std::move(led[i]), parts[i]);
  SettleAll(parts);
  return better;
}

std::vector<std::pair<CandidateSet, double>> Refits::Visited() const {
  std::vector<std::pair<CandidateSet, double>> visited = {{CandidateSet(), Worth({})}};
  for (const auto& [set, entry] : models_) {
    if (MayBeTold(set) && Settled(set)) visited.emplace_back(set, Worth(set));
  }
  return visited;
}

bool Refits::WasTried(int candidate) const {
  return std::any_of(models_.begin(), models_.end(), [&](const auto& model) {
    return model.second.white.ok() && Holds(model.first, candidate);
  });
}

bool Holds(const CandidateSet& set, int i) {
  return std::find(set.begin(), set.end(), i) != set.end();
}

CandidateSet With(CandidateSet set, int i) {
  set.insert(std::upper_bound(set.begin(), set.end(), i), i);
  return set;
}

std::vector<CandidateSet> Eliminations(const CandidateSet& set) {
  std::vector<CandidateSet> sets;
  for (std::size_t i = 0; i < set.size(); ++i) {
    CandidateSet less = set;
    less.erase(less.begin() + static_cast<std::ptrdiff_t>(i));
    sets.push_back(less);
  }
  return sets;
}

}  // namespace hoplab
