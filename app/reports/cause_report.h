#pragma once

#include <string>

#include "fitting/diagnosis/diagnosis.h"

namespace hoplab {

/// The causes of an extension: a table of the told ones with sizes, shares and probabilities, what
/// their names mean, sizes that differ between trials, and small corrections in one line.
std::string CauseLines(const Diagnosis& diagnosis, bool colours);

/// What the evidence wanted and the model is told without, in one line; empty if nothing.
std::string LeftOutLine(const Diagnosis& diagnosis, bool colours);

/// What the extension leaves, and how likely it is that the cause is in no list.
std::string DoubtLines(const Diagnosis& diagnosis, bool colours);

}  // namespace hoplab
