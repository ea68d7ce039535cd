#include "fitting/diagnosis/name.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "fitting/diagnosis/pool.h"
#include "fitting/diagnosis/refits.h"

namespace hoplab {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// Models tried at each step of the search beyond the single ones.
constexpr int kForwardWidth = 5;
constexpr int kPairWidth = 8;

class Search {
 public:
  Search(const Extension& null, std::span<const Candidate> candidates, const Linearisation& null_at,
         const std::vector<TrialProblem>& train, const NamingOptions& options)
      : null_(null),
        null_at_(null_at),
        train_(train),
        options_(options),
        refits_(null, train, options, naming_) {
    FillPool(naming_, candidates, null_at, train);
  }

  Naming Run() {
    if (options_.max_effects < 1) {
      naming_.best = null_;
      Judge({});
      return std::move(naming_);
    }
    Model current = refits_.Better({}, Singles(), Effort::kWhileInContention);
    current = refits_.Better(current, PairsFromNull(), Effort::kWhileInContention);
    while (!current.empty() && static_cast<int>(current.size()) < options_.max_effects &&
           !Stopped()) {
      Model grown = refits_.Better(current, Forward(current), Effort::kWhileInContention);
      if (grown == current) break;
      current = Tidy(grown);
    }
    if (!current.empty()) current = Tidy(current);
    naming_.best = refits_.At(current);
    for (std::size_t i = 0; i < naming_.candidates.size(); ++i) {
      CandidateResult& c = naming_.candidates[i];
      if (!c.separable) continue;
      c.alone = refits_.At({static_cast<int>(i)});
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
    const Linearisation at = LineariseAt(refits_.At(model), tested, train_, options_.jobs);
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
      refits_.RefineParts(model);
      Model best = refits_.Better(model, Eliminations(model), Effort::kToTheEnd);
      best = refits_.Better(best, Swaps(best, kForwardWidth), Effort::kWhileInContention);
      if (best == model) break;
      model = best;
    }
    return model;
  }
  // Models in which one member gives its place to another candidate that promises, by the linear
  // model, at least half of what that member gains.
  std::vector<Model> Swaps(const Model& model, int width) {
    if (model.size() < 2) return {};
    std::vector<Model> swaps;
    refits_.RefitAll(Eliminations(model), Effort::kToTheEnd);
    for (const Model& less : Eliminations(model)) {
      if (!refits_.Usable(less)) continue;
      int taken = 0;
      const double needed =
          0.5 * std::max(refits_.At(less).cost - refits_.At(model).cost, naming_.penalty);
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
      return refits_.Usable(other) &&
             refits_.At(other).cost + extra <= refits_.At(model).cost + kIndistinguishable;
    };
    if (model.size() > 1)
      refits_.RefitAll(Swaps(model, 3 * kForwardWidth), Effort::kWhileInContention);
    for (int member : model) {
      std::vector<int> group = {member};
      Model less = model;
      less.erase(std::find(less.begin(), less.end(), member));
      std::vector<std::pair<double, int>> others;
      for (int i = 0; i < static_cast<int>(naming_.candidates.size()); ++i) {
        if (std::find(model.begin(), model.end(), i) != model.end()) continue;
        const Model swapped = With(less, i);
        if (refits_.Has(swapped) && close(swapped))
          others.emplace_back(refits_.At(swapped).cost, i);
      }
      std::stable_sort(others.begin(), others.end());
      std::vector<Extension> rivals = {refits_.At(model)};
      for (const auto& [cost, i] : others) {
        group.push_back(i);
        rivals.push_back(refits_.At(With(less, i)));
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
    const Linearisation at = LineariseAt(refits_.At(model), one, train_, options_.jobs);
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
  Naming naming_;
  Refits refits_;
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
