#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/diagnosis/diagnosis.h"
#include "fitting/discovery/library.h"

namespace hoplab {

enum class DiscoveryVerdict {
  kFound,          // a formula that stays when trials are drawn anew; of one fitted trial, that
                   // held-out trials confirm
  kNothingStable,  // something is missing, and no formula stays
  kNotNeeded       // nothing is missing that these data could show
};
std::string_view NameOf(DiscoveryVerdict verdict);

/// Share of the resamples in which a term must be picked to be told as found.
inline constexpr double kStable = 0.7;
/// Most terms of a formula that is looked for.
inline constexpr int kMostTerms = 3;

/// A parameter of a found term.
struct FoundValue {
  std::string name, unit;
  double value = 0.0;
  std::optional<std::pair<double, double>> ci95;
};

/// The exponent of a term, freed.
struct FreedExponent {
  double taken = 0.0;  // the whole number the term has
  FoundValue value;
  double gain = 0.0;  // nats over the whole number
};

/// A term of the formula that was found. `values` has its shape, too, where it has one.
struct FoundTerm {
  Term term;
  std::vector<FoundValue> values;
  std::optional<FreedExponent> exponent;
  double share = 0.0;                  // of the misfit it explains, 0..1
  std::optional<double> selected_in;   // share of the resamples; absent with one trial
  std::vector<const Effect*> equal;    // terms these data cannot tell from it, itself left out
  std::vector<const Effect*> as_good;  // terms that do as well in its place
  /// What acts there free of the formula, over its variable; absent where that cannot be drawn.
  std::optional<ReconstructedForce> free_curve;
  /// Ready for --with: the typical size is the one found.
  FormulaSource source;
};

/// A search for a formula. What was not reached is empty.
struct Discovery {
  Diagnosis base;                   // up to its null fits: the model that a formula is sought for
  bool in_place_of_causes = false;  // the diagnosis has causes that this model has not
  std::size_t library = 0;          // terms tried
  std::vector<Term> terms;  // of these, those that can be told from each other and the model
  Naming naming;
  std::vector<FoundTerm> found;
  Uncertainty uncertainty;  // of the model with them
  HeldOutErrors after;
  HeldOutGain gain;
  std::vector<std::string> left_out;
  std::optional<FreeForces> free_forces;
  DiscoveryVerdict verdict = DiscoveryVerdict::kNotNeeded;
  std::string reason;
};

/// Looks for a formula that a model lacks: `options.problem` says which; its candidates are not
/// used. Throws InputError for options that do not suit the dataset.
Discovery Discover(const Dataset& dataset, const DiagnosisOptions& options);

/// The same from the null fits of `base`, on its train trials.
Discovery DiscoverFrom(const Diagnosis& base, const DiagnosisOptions& options);

/// The same for the model that a diagnosis ended with, its causes among it. Where these do not
/// explain the misfit, also for the model without them, and what does better on held-out trials is
/// told.
Discovery DiscoverBeside(const Diagnosis& diagnosis, const DiagnosisOptions& options);

}  // namespace hoplab
