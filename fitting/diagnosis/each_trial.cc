#include "fitting/diagnosis/each_trial.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/statistics/bivariate_statistics.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "base/nan.h"
#include "fitting/diagnosis/gate.h"
#include "fitting/diagnosis/linearise_at.h"

namespace hoplab {
namespace {

// Causes that are tried so, and trials without which no size is told to be one trial's own.
constexpr std::size_t kMostTried = 3;
constexpr long kFewestTrials = 5;
// Names that hold this share of the weight are told.
constexpr double kHeld = 0.95;

// A cause of each trial's own size, alone or beside others; the model's members are these others.
struct World {
  Candidate cause;
  VaryingModel v;
  double worth = 0.0;  // as Naming has it
};

RefitSettings WithTrials(RefitSettings settings, const std::vector<TrialProblem>& train) {
  settings.train = &train;
  return settings;
}

// A value of the plain model does what the cause would with one size in all trials.
bool ActsAsAFittedValue(const Candidate& cause, const FittedModel& plain,
                        const RefitSettings& settings) {
  const Linearisation at = LineariseAt(plain, std::span(&cause, 1), *settings.train, settings.jobs);
  return ScoreOf(at, HypothesesOf(std::span(&cause, 1)).front()).rank == 0;
}

// What the cause was promised beside, fitted alone with one size for all; none: it promises alone.
const FittedModel* BesideOf(const OwnSizes& own, const Naming& with_one_size) {
  for (const CandidateResult& c : with_one_size.candidates)
    if (c.alone.ok() && c.candidate.Name() == own.beside) return &c.alone;
  return nullptr;
}

// The cause, with what it was promised beside: the model's members.
std::optional<World> Begin(const OwnSizes& own, const EachTrialRequest& request,
                           const RefitSettings& settings) {
  const FittedModel& plain = *request.null.plain;
  World world;
  world.cause = own.cause;
  world.cause.mean_held = ActsAsAFittedValue(own.cause, plain, settings);
  double mean = 0.0;
  for (const double size : own.sizes) mean += size / static_cast<double>(own.sizes.size());
  if (world.cause.mean_held) mean = 0.0;
  std::vector<Candidate> members = {world.cause};
  Eigen::VectorXd sizes = Eigen::VectorXd::Constant(1, mean);
  if (const FittedModel* beside = BesideOf(own, *request.with_one_size)) {
    const Candidate& other = beside->members.front();
    members.push_back(other);
    sizes.conservativeResize(1 + other.parameter_count());
    sizes.tail(other.parameter_count()) = beside->ValuesOf(0) - NullValues(std::span(&other, 1));
  }
  FittedModel one_size = Refit(plain, members, sizes, settings);
  Settle(one_size, settings);
  if (!one_size.ok() || !one_size.settled) return std::nullopt;
  world.v = RefitVarying(one_size, {one_size.PlaceOf(0)}, settings);
  if (!world.v.converged || world.v.values.empty()) return std::nullopt;
  world.cause.each_trial = true;
  world.v.model.members.erase(world.v.model.members.begin());
  return world;
}

// Under white noise, without what acts beside it, as a search begins.
FittedModel PlainOf(const World& world, const RefitSettings& settings) {
  FittedModel plain = UnderWhiteNoise(world.v.model);
  plain.shared = plain.shared.head(plain.shared.size() - plain.parameter_count()).eval();
  plain.problem.shared.resize(static_cast<std::size_t>(plain.shared.size()));
  plain.problem.effects.resize(plain.problem.effects.size() - plain.members.size());
  plain.members.clear();
  plain.cost = std::numeric_limits<double>::infinity();  // the ridges were other ones
  RefitSettings white = settings;
  white.discrepancy = Discrepancy::kNone;
  Settle(plain, white);
  return plain;
}

// What acts beside the cause; nothing found where its model cannot be led on.
std::optional<Naming> NameBeside(const World& world, const EachTrialRequest& request,
                                 const RefitSettings& of_all) {
  const RefitSettings settings = WithTrials(of_all, world.v.train);
  const FittedModel plain = PlainOf(world, settings);
  if (!plain.ok() || !plain.settled) return std::nullopt;
  FittedModel null = plain;
  Settle(null, settings);
  std::vector<Candidate> others(request.candidates.begin(), request.candidates.end());
  std::erase_if(others, [&](const Candidate& c) { return c.effect == world.cause.effect; });
  Linearisation at = LineariseAt(null, others, world.v.train, settings.jobs);
  at.alike_rows = AlikeRows(world.v.train, *request.noise_squares);
  NamingOptions options = request.naming;
  options.max_effects -= 1;
  FittedModel begun = UnderWhiteNoise(world.v.model);
  options.begin = {};
  if (!begun.members.empty()) options.begin = std::span(&begun, 1);
  Naming naming = NameCauses({&plain, &null}, others, at, world.v.train, options);
  if (naming.interrupted) return std::nullopt;
  return naming;
}

// The spread anew beside other causes.
std::optional<World> WithOthers(World world, FittedModel model, const RefitSettings& settings) {
  world.v.model = std::move(model);
  world.v.rounds = 0;
  const NoiseModel noise = world.v.model.problem.noise;
  BringToRest(world.v, settings, noise);
  if (!world.v.converged) return std::nullopt;
  world.v.model.cost = 0.5 * world.v.square;
  return world;
}

// Of a correlation as large, by Student's t; 1 where it says nothing.
double ChanceOfCorrelation(const std::vector<double>& set_up, const std::vector<double>& sizes) {
  std::vector<double> a, b;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!std::isfinite(sizes[i])) continue;
    a.push_back(set_up[i]);
    b.push_back(sizes[i]);
  }
  const double n = static_cast<double>(a.size());
  const double r = boost::math::statistics::correlation_coefficient(a, b);
  const double r2 = std::min(r * r, 1.0 - 1e-12);
  if (!std::isfinite(r2)) return 1.0;
  const double t = std::sqrt(r2 * (n - 2.0) / (1.0 - r2));
  return 2.0 * boost::math::cdf(boost::math::complement(boost::math::students_t(n - 2.0), t));
}

// A cause with what acts beside it, and the search for that.
struct Searched {
  World world;
  FittedModel others;  // as the search left them
  Naming naming;
};

// What a trial is set up with: its start, and its first touch-down angle.
std::vector<std::vector<double>> SetUps(const World& world) {
  std::map<std::string, std::vector<double>> of_start;
  std::vector<double> angles;
  for (std::size_t i = 0; i < world.v.train.size(); ++i) {
    const TrialProblem& trial = world.v.train[i];
    for (int k = 0; k < trial.own_count(); ++k) {
      const OwnParameter& own = trial.own[static_cast<std::size_t>(k)];
      if (own.deviation_of < 0) of_start[own.name].push_back(world.v.model.initial_states[i][k]);
    }
    angles.push_back(trial.touchdown_angles.empty() ? trial.parameters.theta_td
                                                    : trial.touchdown_angles.front());
  }
  std::vector<std::vector<double>> all = {std::move(angles)};
  for (auto& [name, values] : of_start) all.push_back(std::move(values));
  std::erase_if(all, [&](const std::vector<double>& values) {
    return values.size() < world.v.train.size() ||
           *std::max_element(values.begin(), values.end()) -
                   *std::min_element(values.begin(), values.end()) <
               1e-9;
  });
  return all;
}

// Sizes that go with what the trials are set up with are no trial's own: something is missing that
// depends on it, and the cause stands in for it. Of few trials nothing tells the two apart.
bool MayFollowTheSetUp(const World& world) {
  constexpr double kByChance = 0.1;
  const std::vector<double>& sizes = world.v.values.front().sizes;
  if (std::count_if(sizes.begin(), sizes.end(), [](double s) { return std::isfinite(s); }) <
      kFewestTrials)
    return true;
  const std::vector<std::vector<double>> set_ups = SetUps(world);
  return std::any_of(set_ups.begin(), set_ups.end(), [&](const std::vector<double>& set_up) {
    return ChanceOfCorrelation(set_up, sizes) < kByChance / static_cast<double>(set_ups.size());
  });
}

std::vector<Searched> SearchAll(const EachTrialRequest& request, const RefitSettings& settings) {
  std::vector<Searched> all;
  const std::size_t count = std::min(kMostTried, request.promising.size());
  for (const OwnSizes& own : request.promising.first(count)) {
    const std::optional<World> begun = Begin(own, request, settings);
    if (!begun) continue;
    std::optional<Naming> naming = NameBeside(*begun, request, settings);
    if (!naming) continue;
    std::optional<World> found = WithOthers(*begun, naming->best, settings);
    if (!found || MayFollowTheSetUp(*found)) continue;
    found->worth = naming->worth + found->v.log_z - naming->best.evidence.log_z() -
                   request.with_one_size->log_odds;
    FittedModel others = naming->best;
    all.push_back({std::move(*found), std::move(others), std::move(*naming)});
  }
  std::stable_sort(all.begin(), all.end(), [](const Searched& a, const Searched& b) {
    return a.world.worth > b.world.worth;
  });
  return all;
}

// The first, and the next ones, until they hold enough of the weight.
std::vector<World> AsGood(const std::vector<Searched>& all) {
  double whole = 0.0, held = 0.0;
  const auto weight = [&](const Searched& s) {
    return std::exp(s.world.worth - all.front().world.worth);
  };
  for (const Searched& s : all) whole += weight(s);
  std::vector<World> worlds;
  for (const Searched& s : all) {
    if (held >= kHeld * whole) break;
    held += weight(s);
    worlds.push_back(s.world);
  }
  return worlds;
}

// The other members in the trials as they are without it.
FittedModel WithoutIt(const FittedModel& best, const NullFits& null,
                      const RefitSettings& settings) {
  if (best.members.empty()) return *null.settled;
  const Eigen::VectorXd sizes = best.shared.tail(best.parameter_count()) - NullValues(best.members);
  FittedModel model = Refit(*null.plain, best.members, sizes, settings);
  Settle(model, settings);
  return model;
}

FittedModel WithFirst(const Candidate& cause, FittedModel model) {
  if (model.ok()) model.members.insert(model.members.begin(), cause);
  return model;
}

// What each candidate is alone is told of the trials as they are without the cause.
void TellAlone(const Naming& with_one_size, Naming& naming) {
  for (CandidateResult& c : naming.candidates) {
    const auto before =
        std::find_if(with_one_size.candidates.begin(), with_one_size.candidates.end(),
                     [&](const CandidateResult& other) { return other.candidate == c.candidate; });
    const bool is_known = before != with_one_size.candidates.end();
    c.alone = is_known ? before->alone : FittedModel();
    c.gain = is_known ? before->gain : 0.0;
    if (is_known) c.score = before->score;
  }
}

int AddCandidate(const Candidate& cause, double probability, const Naming& with_one_size,
                 Naming& naming) {
  CandidateResult c;
  for (const CandidateResult& other : with_one_size.candidates)
    if (other.candidate == cause) c = other;
  c.candidate = cause;
  c.probability = probability;
  c.status = CandidateStatus::kSupported;
  c.bound95 = Eigen::VectorXd::Constant(cause.parameter_count(), kNaN);
  naming.candidates.push_back(std::move(c));
  return static_cast<int>(naming.candidates.size()) - 1;
}

// Makes the cause a member of all that was found beside it. `worlds`: it, then what does as well.
void Join(const std::vector<World>& worlds, const EachTrialRequest& request, double gain,
          FittedModel without, Naming& naming) {
  const Candidate& cause = worlds.front().cause;
  TellAlone(*request.with_one_size, naming);
  std::vector<int> group;
  std::vector<double> weights;
  std::vector<FittedModel> rivals;
  double sum = 0.0;
  const double best = worlds.front().worth;
  for (const World& world : worlds) sum += std::exp(world.worth - best);
  for (const World& world : worlds) {
    weights.push_back(std::exp(world.worth - best) / sum);
    const double probability = weights.back() / (1.0 + std::exp(-gain));
    group.push_back(AddCandidate(world.cause, probability, *request.with_one_size, naming));
    rivals.push_back(WithFirst(world.cause, world.v.model));
    if (worlds.size() > 1) naming.candidates.back().status = CandidateStatus::kIndistinguishable;
  }
  naming.best = rivals.front();
  for (std::vector<FittedModel>& models : naming.rivals) {
    for (FittedModel& model : models) model = WithFirst(cause, std::move(model));
    models.front() = naming.best;
  }
  for (FittedModel& model : naming.without) model = WithFirst(cause, std::move(model));
  const auto first = [](auto& of_members, auto&& value) {
    of_members.insert(of_members.begin(), std::forward<decltype(value)>(value));
  };
  for (auto& [set, weight] : naming.posterior) first(set, group.front());
  first(naming.best_set, group.front());
  first(naming.groups, std::move(group));
  first(naming.rivals, std::move(rivals));
  first(naming.group_weights, std::move(weights));
  first(naming.gaps, gain);
  first(naming.wider, std::vector<WiderGroup>());
  first(naming.without, std::move(without));
}

}  // namespace

std::optional<EachTrialFound> NameEachTrial(const EachTrialRequest& request,
                                            const RefitSettings& settings) {
  if (std::ssize(*settings.train) < kFewestTrials) return std::nullopt;
  std::vector<Searched> all = SearchAll(request, settings);
  if (all.empty()) return std::nullopt;
  Searched& best = all.front();
  EachTrialFound out;
  out.gain = best.world.worth - request.with_one_size->worth;
  if (!(out.gain >= kOwnSizesPay)) return std::nullopt;
  out.value = best.world.v.values.front();
  out.train = best.world.v.train;
  out.naming = std::move(best.naming);
  out.naming.worth = best.world.worth;
  Join(AsGood(all), request, out.gain, WithoutIt(best.others, request.null, settings), out.naming);
  return out;
}

}  // namespace hoplab
