#pragma once

#include "optimize/search_point.h"
#include "optimize/stride_map.h"

namespace hoplab {

/// Scores a robot whose motors follow a clock: it runs for some strides from its start, and where
/// it does not fall the steady stride it comes to is measured.
void ScoreStride(const SearchProblem& problem, const Hopper& at, SearchPoint& point);

/// How a robot ends that starts as it is told: whether it falls, else whether it has settled: from
/// one of its last strides to the next nothing changes by more than 2 % of SectionComponent::size.
struct StrideEnd {
  bool ended = false, settled = false;
};
StrideEnd EndOfStrides(const Hopper& hopper);

}  // namespace hoplab
