#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "fitting/diagnosis/name.h"

namespace hoplab {

/// Places of an extension's members among the candidates, ascending; empty: the null fit.
using Model = std::vector<int>;

/// Whether a refit goes on that, by its pace, will not come near the best model known.
enum class Effort { kToTheEnd, kWhileInContention };

/// The models a search has fitted so far, each once. What it holds does not depend on the number
/// of jobs.
class Refits {
 public:
  /// All arguments have to outlive this. `naming` gives the candidates and penalties, and counts
  /// the refits.
  Refits(const Extension& null, const std::vector<TrialProblem>& train,
         const NamingOptions& options, Naming& naming);

  /// A fitted model.
  const Extension& At(const Model& model) const {
    return model.empty() ? null_ : models_.at(model);
  }
  bool Has(const Model& model) const { return models_.count(model) > 0; }
  bool Usable(const Model& model) const {
    return model.empty() || (models_.count(model) && models_.at(model).ok());
  }
  /// Log-likelihood over the null fit less what its parameters must pay [nats].
  double Worth(const Model& model) const { return At(model).GainOver(null_) - PenaltyOf(model); }
  /// The best of `current` and the given models by worth, after refitting those.
  Model Better(Model current, const std::vector<Model>& models, Effort effort);
  /// Refits the models not refitted yet, in parallel, each from its best known part; those near the
  /// best to their end.
  void RefitAll(const std::vector<Model>& models, Effort effort);
  /// A part of a model cannot be worse than the whole with one value at its null: where the whole
  /// has found a better valley, its parts are refitted from there.
  void RefineParts(const Model& model);

 private:
  bool Stopped() const { return options_.stop && *options_.stop; }
  double PenaltyOf(const Model& model) const;
  void Finish(const std::vector<Model>& models, Effort effort);
  std::string NamesOf(const Model& model) const;
  double BestCost() const;
  Extension RefitModel(const Model& model, const RefitSettings& settings) const;
  std::vector<double> LinearWorth(const Extension& e) const;
  Extension Ordered(Extension e, const Model& part, const std::vector<int>& added,
                    const Model& model) const;
  const Candidate& CandidateAt(int i) const {
    return naming_.candidates[static_cast<std::size_t>(i)].candidate;
  }

  const Extension& null_;
  const std::vector<TrialProblem>& train_;
  const NamingOptions& options_;
  Naming& naming_;
  RefitSettings refit_;
  std::map<Model, Extension> models_;
  std::mutex mutex_;
};

/// The models with one member less; none for a model of one.
std::vector<Model> Eliminations(const Model& model);

}  // namespace hoplab
