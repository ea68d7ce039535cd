#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fitting/diagnosis/name.h"
#include "fitting/diagnosis/own_sizes.h"
#include "fitting/diagnosis/varying.h"

namespace hoplab {

/// Nats of evidence, over the best of one size for all, from which a cause of each trial's own size
/// is told. Where what acts is not in the catalogue, sizes that are free in each trial stand in for
/// it, with gains of 5 to 33 nats in the calibration's cases; three of sixteen gained more than
/// this. (What leaves more than details is not told either: docs/decisions/0022.)
inline constexpr double kOwnSizesPay = 20.0;

/// What a search found in which one cause has a size of each trial's own.
struct EachTrialFound {
  /// Of that search. The cause is the first member of every model but the one without it; among
  /// the candidates it stands behind the others, and behind it what does as well so.
  Naming naming;
  VaryingValue value;               // the cause's sizes
  std::vector<TrialProblem> train;  // with its deviations: what the models were fitted to
  double gain = 0.0;                // nats over the search with one size for all
};

/// What a search for such a cause begins with.
struct EachTrialRequest {
  NullFits null;                                       // without causes
  std::span<const Candidate> candidates;               // of the search with one size for all
  std::span<const OwnSizes> promising;                 // the best first
  const Naming* with_one_size = nullptr;               // what that search found
  const std::vector<double>* noise_squares = nullptr;  // Diagnosis::noise_squares
  NamingOptions naming;
};

/// Searches anew, causes as before, beside a cause with a size in each trial: N(mean, spread^2),
/// the spread by restricted likelihood, of the cause alone and again beside what is found; so of up
/// to three that promise. Absent where none gains kOwnSizesPay; with less than five trials; and
/// where the sizes go with what the trials are set up with (their starts, their touch-down angles),
/// by a correlation with any of it that chance gives once in ten: something may be missing that
/// depends on it, a friction of another law, say.
std::optional<EachTrialFound> NameEachTrial(const EachTrialRequest& request,
                                            const RefitSettings& settings);

}  // namespace hoplab
