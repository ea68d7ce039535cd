#pragma once

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// Squared misfit beyond noise that a model with `parameters` more values leaves, `square` in all,
/// as a share of the plain model's, 0..1.
double LeftShare(const Detection& seen, double square, int parameters);

/// Weighs what is left, gives the verdict with its reason, and withdraws exclusions that are not
/// earned: they are beside a sure name or an adequate model, and where nothing is left of which the
/// share is above `material`.
void Judge(Diagnosis& diagnosis, double material);

/// What the model misses, root mean square over the noise; 0 where it misses no more than that.
double MisfitOverNoise(const Detection& seen);

/// What is left of that, a share of its square, root mean square over the noise.
double LeftOverNoise(const Detection& seen, double share);

/// Whether the model leaves something smooth that is not much less than the noise (kSlight):
/// however small a part of the misfit it is, it is seen.
bool LeavesSeen(const Detection& seen, const FittedModel& model);

/// Whether something stands out that is much less than the noise (kSlight), and no cause that
/// `report` tells has a probability of `likely`.
bool IsSlight(const Detection& seen, const ExtensionReport& report, double likely);

/// What an extension that is beyond physics needs, after its name.
std::string WhatItNeeds(const ExtensionReport& e);

/// Whether causes are told.
bool NamesSomething(const Diagnosis& diagnosis);

}  // namespace hoplab
