#pragma once

#include <optional>
#include <string>

#include "app/records/run_record.h"
#include "experiments/study/reproduction.h"

namespace hoplab {

/// Runs to be seen in motion: rows of trajectories.csv told apart by a column `run`, and what hops
/// in each (MechanismRecord) by the run's name.
struct RunsInMotion {
  std::string table;
  Json mechanisms = Json::object();
};

/// The half-circular and the straight leg of the first figure that compares them; absent where none
/// was asked for.
std::optional<RunsInMotion> ComparedLegs(const Study& study, const Reproduction& reproduction);

}  // namespace hoplab
