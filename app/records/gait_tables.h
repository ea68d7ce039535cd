#pragma once

#include <string>
#include <vector>

#include "app/records/run_record.h"
#include "optimize/fixed_point.h"

namespace hoplab {

/// A steady hop and what it belongs to, as "steady hop", "before", "best".
struct LabelledGait {
  std::string label;
  const Hopper* hopper = nullptr;
  const FixedPoint* point = nullptr;
};

/// One steady hop of each gait from apex to apex, as CSV: run, then the columns of a trajectory.
/// Gaits that were not found have no rows.
std::string CycleTable(const std::vector<LabelledGait>& gaits);
/// The hopper's own run from its start, as CSV; at most `longest` s of it.
std::string OwnRunTable(const Hopper& hopper, double longest);

/// A steady hop as an object of run.json: {vx_m_per_s, y_m, period_s, advance_m, multipliers,
/// spectral_radius, stable, events}; null if it was not found.
Json GaitPointRecord(const FixedPoint& point);

}  // namespace hoplab
