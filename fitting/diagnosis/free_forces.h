#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fitting/diagnosis/linearisation.h"
#include "fitting/diagnosis/probes.h"

namespace hoplab {

/// One bump of a reconstructed force with its 95 % band.
struct ForcePoint {
  double at = 0.0;      // where, in the group's `against`
  double value = 0.0;   // in the group's unit
  double band95 = 0.0;  // half width; NaN where the data do not determine it
};

/// A simple term of a sparse regression and how often resampling keeps it. Descriptive: it tells
/// what the missing force looks like, not what causes it.
struct RegressionTerm {
  std::string term;  // "1", "s", "s^2", ...: s the group's coordinate
  double coefficient = 0.0;
  double inclusion = 0.0;  // share of the resampled reconstructions that keep it, 0..1
};

struct ReconstructedForce {
  ProbeGroup group;
  double score = 0.0;  // chi-square of the whole group beside the fitted values
  double p_value = 1.0;
  std::vector<ForcePoint> points;
  std::vector<RegressionTerm> terms;  // empty where there is nothing to lay them over
};

/// Forces, impulses and readings that would close the gap, each group alone.
struct FreeForces {
  std::vector<ReconstructedForce> forces;  // the most significant first
};

/// `at`: a linearisation whose columns are the probes of `basis`.
FreeForces Reconstruct(const Linearisation& at, const ProbeBasis& basis, std::uint64_t seed);

}  // namespace hoplab
