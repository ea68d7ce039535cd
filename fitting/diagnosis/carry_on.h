#pragma once

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// Fits what a diagnosis of first parts named to `problem`, longer parts of the same trials or all
/// of them, more and more rows at a time: beyond what is known; where that leads to no minimum,
/// from the first rows on, and from values that are as likely. `last` has an extension.
CarriedOn CarryOn(const Diagnosis& last, const FitProblem& problem,
                  const DiagnosisOptions& options);

/// The same of a model that was as good there, in one search.
CarriedOn CarryOnRival(const FittedModel& rival, const Diagnosis& last, const FitProblem& problem,
                       const DiagnosisOptions& options);

/// The diagnosis of first parts with what it named fitted to the whole trials. Causes that these do
/// not confirm are set aside (unconfirmed.h). `whole`: the model without causes, all rows.
Diagnosis WithWholeTrials(Diagnosis d, const FitProblem& whole, const DiagnosisOptions& options);

}  // namespace hoplab
