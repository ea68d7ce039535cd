#pragma once

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// What is told beside a verdict, once it stands: a mass or shapes that are taken as given, what
/// each candidate gains alone on held-out trials and, where a name is told and others do as well,
/// the trial that would tell them apart. A diagnosis that is stopped goes without.
void TellBesides(Diagnosis& diagnosis, const DiagnosisOptions& options);

}  // namespace hoplab
