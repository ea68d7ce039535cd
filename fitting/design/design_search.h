#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fitting/design/forecast.h"
#include "fitting/design/trial_design.h"

namespace hoplab {

/// A design and what it promises.
struct DesignTried {
  TrialDesign design;
  std::vector<double> point;  // in the searched ranges, 0..1
  /// Separating: expected fall of the entropy of the causes [nats]. Sharpening: share by which the
  /// interval shrinks, 0..1. NaN where it cannot be simulated under all models.
  double worth = 0.0;
  /// What the search makes small: logarithm of the entropy or interval that remains. It tells
  /// designs apart whose worth is nearly all there is to gain.
  double log_left = 0.0;
  std::optional<ForecastFailure> failure;  // none: it can be simulated
  bool fragile = false;                    // it cannot where a setting is off by kSettingError
  bool refitted = false;

  // Separating: the least expected log-likelihood ratio of the first rival to another [nats], and
  // which.
  double least_nats = 0.0;
  std::string closest_rival;
  // The least of all pairs: what is true, what is taken for it.
  double pair_nats = 0.0;
  std::string pair_truth, pair_other;
  double half_width = 0.0;  // sharpening: of the 95 % interval, the value's own unit
};

struct DesignSearchRequest {
  DesignSpace space;
  int budget = 300;  // linear forecasts
  std::uint64_t seed = 1;
  int settled = 6;   // of the most promising, those whose worth a refit settles (separating)
  int distinct = 5;  // designs told
  int map_size = 0;  // points along each axis of the maps; 0: none
  int jobs = 1;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(int done, int of)> progress = nullptr;
};

/// A point of a map: two settings moved, the others as in the best design.
struct DesignMapPoint {
  DesignSetting across, up;
  DesignTried tried;
};

struct DesignSearchResult {
  /// The best designs, no two of them alike, the best first; none is fragile unless every one that
  /// promises something is. Empty if none can be simulated.
  std::vector<DesignTried> best;
  std::vector<DesignTried> tried;  // in the order they were, by the linear forecast
  std::vector<DesignMapPoint> map;
  double before = 0.0;  // entropy of the causes [nats], or half width of the interval
  bool interrupted = false;
};

/// Nobody sets a trial exactly: one that falls where a setting is off by this share of its range is
/// no design to tell.
inline constexpr double kSettingError = 0.02;
/// Designs that differ by less than this share of every range count as one.
inline constexpr double kAlikePlans = 0.15;

/// Looks for the trial that leaves the least entropy of `weights` over the rivals (at least two): a
/// global search by the linear forecast, then a local one, then refits for the most promising,
/// since the linear forecast promises most where it fails: a steep drop far from the train trials
/// was given 893 nats and brought 32. The same request gives the same result, whatever `jobs`.
DesignSearchResult SearchSeparating(std::span<const FittedModel> rivals,
                                    std::span<const double> weights,
                                    const std::vector<TrialProblem>& train,
                                    const DesignSearchRequest& request);

/// Looks for the trial that makes the interval of a shared value of `model` narrowest, also where a
/// setting is off by kSettingError: next to a fall everything is very sensitive.
DesignSearchResult SearchSharpening(const FittedModel& model, int parameter,
                                    const std::vector<TrialProblem>& train,
                                    const DesignSearchRequest& request);

/// Probabilities of rivals by their evidence, each alike before; equal where one has none.
std::vector<double> WeightsOf(std::span<const FittedModel> rivals);

/// `base` with a candidate more, refitted under white noise and settled under `noise`'s kind.
FittedModel FitWith(const FittedModel& base, const Candidate& candidate, const NoiseModel& near,
                    const RefitSettings& settings);

}  // namespace hoplab
