#pragma once

#include <string>
#include <vector>

#include "datasets/dataset.h"

namespace hoplab {

/// Sentences about trials that hold the samples of a trial before them, each beginning with its
/// place: every sample of every channel that both have is the same, and one of these channels has
/// so many different ones that chance does not do it. A copy of a train trial that is held out
/// confirms whatever was fitted.
std::vector<std::string> CopiedTrials(const Dataset& dataset);

}  // namespace hoplab
