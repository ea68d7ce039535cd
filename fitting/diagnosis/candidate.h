#pragma once

#include <span>
#include <string>
#include <vector>

#include "fitting/problem.h"

namespace hoplab {

/// One explanation of a misfit: an effect of the catalogue that the simulation lacks, in every
/// trial or in some only.
struct Candidate {
  const Effect* effect = nullptr;
  Recordings only_recordings = {};             // that it acts in; empty: all
  std::vector<OpenParameter> parameters = {};  // that may be off their null, with their bounds
  /// Of another size in each trial: the model's trials have deviations of its first parameter
  /// (fitting/deviation.h). Extend does not add them.
  bool each_trial = false;
  /// Where a value of the plain model does what it would do with one size in all trials, their mean
  /// is none.
  bool mean_held = false;
  /// Nats by which it is less likely beforehand than the others.
  double price = 0.0;

  Candidate() = default;
  Candidate(const Effect* of, Recordings recordings = {}, const KnownCauses& known = {})
      : effect(of), only_recordings(std::move(recordings)), parameters(known.OpenParameters(*of)) {}
  bool operator==(const Candidate& other) const {
    return effect == other.effect && only_recordings == other.only_recordings;
  }
  bool in_all() const { return only_recordings.empty(); }
  int parameter_count() const { return static_cast<int>(parameters.size()); }
  const EffectParameter& Parameter(int i) const {
    return parameters[static_cast<std::size_t>(i)].info;
  }
  /// "air_drag", "air_drag in train-2.csv and train-3.csv" or "air_drag of each trial's own size".
  std::string Name() const;
};

/// Which effects are tried.
struct CandidateOptions {
  std::vector<std::string> only;     // empty: every effect that applies to the law
  std::vector<std::string> without;  // left out
};

/// The effects to try on `problem`, in the order of the catalogue; those it simulates already and
/// those that are known not to be there are not among them. Throws InputError (place: the option)
/// for names that are not effects, do not apply to the law, or are known not to be there.
std::vector<Candidate> CandidatesOf(const FitProblem& problem, const CandidateOptions& options);
/// Nats by which a filter is less likely beforehand than another cause if the noise does not tell
/// of it: most logs are filtered with their noise.
inline constexpr double kUnseenFilter = 3.0;
/// The filters that would be among them if the noise told of them, at that price: noise that came
/// in after a filter does not. None where `only` says what is tried.
std::vector<Candidate> UnseenFilters(const FitProblem& problem, const CandidateOptions& options);

/// `problem` with the candidates' parameters as further shared values, at their null.
FitProblem Extend(const FitProblem& problem, std::span<const Candidate> candidates);

/// Null values of the candidates' parameters, one after the other.
Eigen::VectorXd NullValues(std::span<const Candidate> candidates);

int ParameterCount(std::span<const Candidate> candidates);

}  // namespace hoplab
