#pragma once

#include <string>
#include <vector>

#include "app/records/run_record.h"
#include "app/runs/gait_run.h"

namespace hoplab {

/// A section's state by the names of its components; all null where there is none.
Json StateRecord(const std::vector<SectionComponent>& components, const SectionState& state);
/// Mean speed of a hop or stride along the ground [m/s].
double SpeedOf(const Hop& hop);

/// What run.json tells of a robot's stride beside what it tells of every gait: `stride` with its
/// kind, speed, cost, torque and when each leg stands.
void AddStride(const GaitRun& run, Json& record);

}  // namespace hoplab
