#include "fitting/diagnosis/name.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <set>

#include "base/parallel.h"
#include "fitting/diagnosis/pool.h"

namespace hoplab {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// Models tried at each step of the search beyond the single ones.
constexpr int kForwardWidth = 5;
constexpr int kPairWidth = 8;

/// Places of members in the pool, ascending.
using Model = std::vector<int>;

class Search {
 public:
  Search(const Extension& null, std::span<const Candidate> candidates, const Linearisation& null_at,
         const std::vector<TrialProblem>& train, const NamingOptions& options)
      : null_(null), null_at_(null_at), train_(train), options_(options) {
    refit_.train = &train_;
    refit_.stop = options.stop;
    FillPool(naming_, candidates, null_at, train);
  }

  Naming Run() {
    if (options_.max_effects < 1) {
      naming_.best = null_;
      Judge({});
      return std::move(naming_);
    }
    RefitAll(Singles());
    Model current = Better({}, Singles());
    current = Better(current, PairsFromNull());
    while (!current.empty() && static_cast<int>(current.size()) < options_.max_effects &&
           !Stopped()) {
      Model grown = Better(current, Forward(current));
      if (grown == current) break;
      current = Tidy(grown);
    }
    if (!current.empty()) current = Tidy(current);
    naming_.best = At(current);
    for (std::size_t i = 0; i < naming_.candidates.size(); ++i) {
      CandidateResult& c = naming_.candidates[i];
      if (!c.separable) continue;
      c.alone = models_.at({static_cast<int>(i)});
      c.gain = c.alone.ok() ? c.alone.GainOver(null_) : 0.0;
    }
    FindGroups(current);
    Judge(current);
    naming_.interrupted = Stopped();
    return std::move(naming_);
  }

 private:
  bool Stopped() const { return options_.stop && *options_.stop; }

  bool IsLocal(int i) const { return !naming_.candidates[i].candidate.only_recording.empty(); }
  bool SameEffect(int i, int j) const {
    return naming_.candidates[i].candidate.effect == naming_.candidates[j].candidate.effect;
  }
  double PenaltyOf(const Model& model) const {
    double sum = 0.0;
    for (int i : model)
      sum += naming_.candidates[i].candidate.parameter_count() *
             (IsLocal(i) ? naming_.local_penalty : naming_.penalty);
    return sum;
  }

  // ---- models
  const Extension& At(const Model& model) const {
    return model.empty() ? null_ : models_.at(model);
  }
  bool Usable(const Model& model) const {
    return model.empty() || (models_.count(model) && models_.at(model).ok());
  }
  double Worth(const Model& model) const { return At(model).GainOver(null_) - PenaltyOf(model); }

  // The best of `current` and the given models by penalised likelihood, after refitting those.
  Model Better(Model current, const std::vector<Model>& models) {
    RefitAll(models);
    for (const Model& m : models) {
      if (Usable(m) && Worth(m) > Worth(current) + 1e-6) current = m;
    }
    return current;
  }

  // Refits the models not refitted yet, in parallel, each from its best known part.
  void RefitAll(const std::vector<Model>& models) {
    std::vector<Model> missing;
    for (const Model& m : models) {
      if (!m.empty() && !models_.count(m) &&
          std::find(missing.begin(), missing.end(), m) == missing.end())
        missing.push_back(m);
    }
    std::vector<Extension> results(missing.size());
    ParallelFor(static_cast<int>(missing.size()), options_.jobs, [&](int i) {
      if (Stopped()) return;
      results[i] = RefitModel(missing[i]);
      if (options_.progress) {
        const std::lock_guard lock(mutex_);
        options_.progress(++naming_.refits, NamesOf(missing[i]));
      }
    });
    for (std::size_t i = 0; i < missing.size(); ++i)
      models_.emplace(missing[i], std::move(results[i]));
    if (!options_.progress) naming_.refits += static_cast<int>(missing.size());
  }

  std::string NamesOf(const Model& model) const {
    std::string names;
    for (int i : model)
      names += (names.empty() ? "" : " + ") + naming_.candidates[i].candidate.Name();
    return names;
  }

  Extension RefitModel(const Model& model) const {
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
    for (int i : added) candidates.push_back(naming_.candidates[i].candidate);
    Eigen::VectorXd sizes(ParameterCount(candidates));
    if (part.empty() && added.size() == 1 && !IsLocal(added[0])) {
      sizes = naming_.candidates[added[0]].score.size;
    } else {
      const Linearisation at = LineariseAt(At(part), candidates, train_, 1);
      const Eigen::Index n = sizes.size();
      const Hypothesis all{0, static_cast<int>(n), Eigen::VectorXd::Constant(n, -1.0),
                           Eigen::VectorXd::Constant(n, 1.0)};
      sizes = ScoreOf(at, all).size;
    }
    Extension e = Refit(At(part), candidates, sizes, refit_);
    // Where the refit falls well short of the linear forecast, it went into the wrong valley: the
    // forecast was too far out, or the effect too bent.
    const double forecast =
        part.empty() && added.size() == 1 ? naming_.candidates[added[0]].score.predicted_gain : 0.0;
    if (forecast > naming_.penalty && (!e.ok() || At(part).cost - e.cost < 0.15 * forecast)) {
      for (double share : {0.3, 0.1}) {
        Extension again = Refit(At(part), candidates, share * sizes, refit_);
        if (again.ok() && (!e.ok() || again.cost < e.cost)) e = std::move(again);
      }
    }
    return Ordered(std::move(e), part, added, model);
  }

  // Members in the order of the pool, whatever order they were added in.
  Extension Ordered(Extension e, const Model& part, const std::vector<int>& added,
                    const Model& model) const {
    std::vector<int> order = part;
    order.insert(order.end(), added.begin(), added.end());
    if (order == model) return e;
    Extension sorted = e;
    sorted.members.clear();
    for (int i : model) sorted.members.push_back(naming_.candidates[i].candidate);
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

  // ---- steps
  std::vector<Model> Singles() const {
    std::vector<Model> models;
    for (std::size_t i = 0; i < naming_.candidates.size(); ++i) {
      if (naming_.candidates[i].separable) models.push_back({static_cast<int>(i)});
    }
    return models;
  }

  // Pool members not in `model`, the best expected gain beside it first.
  std::vector<std::pair<double, int>> Ranked(const Model& model) const {
    std::vector<int> rest;
    std::vector<Candidate> tested;
    for (int i = 0; i < static_cast<int>(naming_.candidates.size()); ++i) {
      if (!naming_.candidates[i].separable) continue;
      if (std::any_of(model.begin(), model.end(), [&](int m) { return SameEffect(m, i); }))
        continue;
      rest.push_back(i);
      tested.push_back(naming_.candidates[i].candidate);
    }
    const Linearisation at = LineariseAt(At(model), tested, train_, options_.jobs);
    const std::vector<Hypothesis> hypotheses = HypothesesOf(tested);
    std::vector<std::pair<double, int>> ranked;
    for (std::size_t i = 0; i < rest.size(); ++i)
      ranked.emplace_back(ScoreOf(at, hypotheses[i]).predicted_gain, rest[i]);
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    return ranked;
  }

  static Model With(Model model, int i) {
    model.insert(std::upper_bound(model.begin(), model.end(), i), i);
    return model;
  }

  std::vector<Model> Forward(const Model& model) const {
    std::vector<Model> models;
    for (const auto& [gain, i] : Ranked(model)) {
      if (static_cast<int>(models.size()) >= kForwardWidth || gain < 0.5 * naming_.penalty) break;
      models.push_back(With(model, i));
    }
    return models;
  }

  // The pairs that promise most by the linear model at the null fit.
  std::vector<Model> PairsFromNull() const {
    if (options_.max_effects < 2) return {};
    const Eigen::MatrixXd gram = null_at_.columns.transpose() * null_at_.columns;
    const Eigen::VectorXd b = -(null_at_.columns.transpose() * null_at_.r);
    struct Pair {
      double gain;
      Model model;
    };
    std::vector<Pair> pairs;
    std::vector<int> first;
    int columns = 0;
    for (const CandidateResult& c : naming_.candidates) {
      first.push_back(columns);
      if (c.candidate.only_recording.empty()) columns += c.candidate.parameter_count();
    }
    const int globals = static_cast<int>(naming_.candidates.size());
    for (int i = 0; i < globals; ++i) {
      for (int j = i + 1; j < globals; ++j) {
        const CandidateResult &ci = naming_.candidates[i], &cj = naming_.candidates[j];
        if (!ci.separable || !cj.separable || IsLocal(i) || IsLocal(j)) continue;
        if (ci.candidate.parameter_count() + cj.candidate.parameter_count() > 2) continue;
        const double a = gram(first[i], first[i]), d = gram(first[j], first[j]);
        const double off = gram(first[i], first[j]), det = a * d - off * off;
        if (!(det > 1e-6 * a * d)) continue;
        const double x = (d * b[first[i]] - off * b[first[j]]) / det;
        const double y = (a * b[first[j]] - off * b[first[i]]) / det;
        if (!Allowed(ci, x) || !Allowed(cj, y)) continue;
        pairs.push_back({0.5 * (x * b[first[i]] + y * b[first[j]]), {i, j}});
      }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& p, const Pair& q) { return p.gain > q.gain; });
    std::vector<Model> models;
    for (const Pair& p : pairs) {
      if (static_cast<int>(models.size()) >= kPairWidth || p.gain < 1.5 * naming_.penalty) break;
      models.push_back(p.model);
    }
    return models;
  }
  static bool Allowed(const CandidateResult& c, double size) {
    const EffectParameter& p = c.candidate.effect->info.parameters[0];
    return size > 0.0 ? p.upper > p.null : p.lower < p.null;
  }

  // Backward elimination and swaps, until neither helps.
  Model Tidy(Model model) {
    for (int round = 0; round < 3 && !Stopped(); ++round) {
      RefineParts(model);
      Model best = Better(model, Eliminations(model));
      best = Better(best, Swaps(best, kForwardWidth));
      if (best == model) break;
      model = best;
    }
    return model;
  }
  // A part of a model cannot be worse than the whole with one value at its null: where the whole
  // has found a better valley, its parts are refitted from there.
  void RefineParts(const Model& model) {
    const std::vector<Model> parts = Eliminations(model);
    RefitAll(parts);
    std::vector<Extension> refined(parts.size());
    ParallelFor(static_cast<int>(parts.size()), options_.jobs,
                [&](int i) { refined[i] = RefitWithout(At(model), i, null_.problem, refit_); });
    for (std::size_t i = 0; i < parts.size(); ++i) {
      Extension& known = models_.at(parts[i]);
      if (refined[i].ok() && (!known.ok() || refined[i].cost < known.cost)) known = refined[i];
    }
  }
  static std::vector<Model> Eliminations(const Model& model) {
    std::vector<Model> models;
    for (std::size_t i = 0; i < model.size() && model.size() > 1; ++i) {
      Model less = model;
      less.erase(less.begin() + static_cast<std::ptrdiff_t>(i));
      models.push_back(less);
    }
    return models;
  }
  // Models in which one member gives its place to another candidate that promises, by the linear
  // model, at least half of what that member gains.
  std::vector<Model> Swaps(const Model& model, int width) {
    if (model.size() < 2) return {};
    std::vector<Model> swaps;
    RefitAll(Eliminations(model));
    for (const Model& less : Eliminations(model)) {
      if (!Usable(less)) continue;
      int taken = 0;
      const double needed = 0.5 * std::max(At(less).cost - At(model).cost, naming_.penalty);
      for (const auto& [gain, i] : Ranked(less)) {
        if (taken >= width || gain < needed) break;
        if (std::find(model.begin(), model.end(), i) != model.end()) continue;
        swaps.push_back(With(less, i));
        ++taken;
      }
    }
    return swaps;
  }

  // ---- what can take a member's place
  void FindGroups(const Model& model) {
    const auto close = [&](const Model& other) {
      double extra = 0.0;  // a trial picked out of many must pay for the picking, a member too
      for (int i : other) extra += IsLocal(i) ? naming_.local_penalty - naming_.penalty : 0.0;
      for (int i : model) extra -= IsLocal(i) ? naming_.local_penalty - naming_.penalty : 0.0;
      return Usable(other) && At(other).cost + extra <= At(model).cost + kIndistinguishable;
    };
    if (model.size() > 1) RefitAll(Swaps(model, 3 * kForwardWidth));
    for (int member : model) {
      std::vector<int> group = {member};
      Model less = model;
      less.erase(std::find(less.begin(), less.end(), member));
      std::vector<std::pair<double, int>> others;
      for (int i = 0; i < static_cast<int>(naming_.candidates.size()); ++i) {
        if (std::find(model.begin(), model.end(), i) != model.end()) continue;
        const Model swapped = With(less, i);
        if (models_.count(swapped) && close(swapped)) others.emplace_back(At(swapped).cost, i);
      }
      std::stable_sort(others.begin(), others.end());
      std::vector<Extension> rivals = {At(model)};
      for (const auto& [cost, i] : others) {
        group.push_back(i);
        rivals.push_back(At(With(less, i)));
      }
      naming_.groups.push_back(std::move(group));
      naming_.rivals.push_back(std::move(rivals));
    }
  }

  void Judge(const Model& model) {
    std::set<int> doubtful, members(model.begin(), model.end());
    for (const std::vector<int>& group : naming_.groups) {
      if (group.size() > 1) doubtful.insert(group.begin(), group.end());
    }
    for (std::size_t n = 0; n < naming_.candidates.size(); ++n) {
      const int i = static_cast<int>(n);
      CandidateResult& c = naming_.candidates[n];
      c.bound95 = Eigen::VectorXd::Constant(c.candidate.parameter_count(), kNaN);
      if (doubtful.count(i)) {
        c.status = CandidateStatus::kIndistinguishable;
      } else if (members.count(i)) {
        c.status = CandidateStatus::kSupported;
      } else if (c.separable && c.power >= kTestable) {
        c.status = CandidateStatus::kExcluded;
      }
      if (!members.count(i) && c.separable) Bound(model, c);
    }
  }
  // What is left of a candidate once the accepted effects are in.
  void Bound(const Model& model, CandidateResult& c) const {
    const std::array one = {c.candidate};
    const Linearisation at = LineariseAt(At(model), one, train_, options_.jobs);
    const Score score = ScoreOf(at, HypothesesOf(one).front());
    for (int k = 0; k < c.candidate.parameter_count(); ++k) {
      // Of several parameters each is bounded with the others free.
      Eigen::VectorXd s = at.columns.col(k);
      for (int other = 0; other < c.candidate.parameter_count(); ++other) {
        const auto o = at.columns.col(other);
        if (other != k && Information(at, other) > 0.0) s -= o * (o.dot(s) / o.squaredNorm());
      }
      const double V = s.squaredNorm();
      if (Information(at, k) > 0.0 && V > kInseparable * at.length[k] * at.length[k])
        c.bound95[k] = std::abs(score.size[k]) + 1.96 / std::sqrt(V);
    }
  }

  const Extension& null_;
  const Linearisation& null_at_;
  const std::vector<TrialProblem>& train_;
  const NamingOptions& options_;
  RefitSettings refit_;
  Naming naming_;
  std::map<Model, Extension> models_;
  std::mutex mutex_;
};

}  // namespace

std::string_view NameOf(CandidateStatus status) {
  switch (status) {
    case CandidateStatus::kSupported:
      return "supported";
    case CandidateStatus::kIndistinguishable:
      return "indistinguishable";
    case CandidateStatus::kExcluded:
      return "excluded";
    case CandidateStatus::kNotTested:
      return "not_tested";
  }
  return "";
}

Naming NameCauses(const Extension& null, std::span<const Candidate> candidates,
                  const Linearisation& null_at, const std::vector<TrialProblem>& train,
                  const NamingOptions& options) {
  return Search(null, candidates, null_at, train, options).Run();
}

}  // namespace hoplab
