#pragma once

#include <cstdint>
#include <vector>

#include "fitting/diagnosis/calibration.h"
#include "fitting/diagnosis/heterogeneity.h"
#include "fitting/diagnosis/measure.h"
#include "fitting/diagnosis/name.h"
#include "fitting/diagnosis/varying.h"

namespace hoplab {

/// What one cause of the extension explains.
struct CauseReport {
  int candidate = 0;  // place in Naming::candidates
  Candidate cause;
  double probability = 0.0;           // that the name is right, calibrated (NameFeatures)
  double group_probability = 0.0;     // that it or a name that does as well is, likewise
  double evidence_probability = 0.0;  // that it acts, if only what is listed can
  NameFeatures features;
  /// Rise of the squared misfit without it over the fall from the plain model to the extension;
  /// shares of causes that overlap do not add to one.
  double share = 0.0;
  bool main = false;  // IsMainCause, and not in place of something else
  /// It would be main, and its name is most likely wrong, while that of another main cause is
  /// likely right: the model needs it, so something acts that it stands in for.
  bool stands_in = false;
  std::vector<double> rmse_without;  // held-out, per channel; NaN where not computed
  HeldOutGain gain;                  // held-out, of the extension over the model without it
  /// One a parameter: whether trials agree on its size.
  std::vector<Heterogeneity> sizes;
  /// One a parameter: its sizes of the refit with one in each trial; absent where trials agree on
  /// it, or no such refit was made, or none came to rest.
  std::vector<std::optional<VaryingValue>> refitted;
  /// Some size differs between trials for certain.
  bool Varies() const;
};

/// Trials do not agree on this value for certain.
bool Differs(const Heterogeneity& sizes);

/// By what factor some channel's held-out error is larger without something. Channels without an
/// error, NaN, are passed over; 0 where all are.
double ErrorGrowsBy(const std::vector<double>& without, const std::vector<double>& with);

/// Share of the misfit below which a cause, or what is left, is of no consequence.
inline constexpr double kMaterial = 0.02;

/// Whether a cause is a main one. It explains a `material` share of the misfit, or some held-out
/// error is more than a tenth larger without it; and held-out trials confirm it: its gain may be
/// claimed, or it explains a material share and some held-out error is more than a quarter larger
/// without it. Where no gain could be measured nothing need confirm it. (Nor need held-out trials
/// confirm a cause in several trials alone: TakeApart.) `error_grows`: the largest of the held-out
/// errors without it over those with it.
bool IsMainCause(double share, double error_grows, const HeldOutGain& gain,
                 double material = kMaterial);

/// What a sharing out is asked with.
struct SharesRequest {
  double plain_square = 0.0;             // squares the plain model leaves, under white noise
  double extended_square = 0.0;          // the extension
  const HeldOutErrors* after = nullptr;  // held-out errors of the extension
  double material = kMaterial;
  std::uint64_t seed = 1;
};

/// The extension `naming.best` taken apart, the largest share first. Squares are compared between
/// models fitted under white noise.
std::vector<CauseReport> TakeApart(const Naming& naming, const SharesRequest& request,
                                   const RefitSettings& settings);

}  // namespace hoplab
