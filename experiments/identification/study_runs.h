#pragma once

#include <vector>

#include "experiments/identification/controlled_run.h"
#include "experiments/identification/study_data.h"

namespace hoplab {

/// What a hopper makes of the tables, in the order of the data.
struct StudyRuns {
  std::vector<double> energy;  // percent; NaN where the jump falls
  std::vector<ControlledRun> modulus, initial_states;
};

/// Every run of the tables. Stiffness is had of every modulus.
StudyRuns RunTables(const StudyHopper& hopper, const StudyData& data, const RunWants& wants);

/// The same at a fraction of the cost, for a search: the moduli that stand for all ranges
/// (`SteadyData`). A massless leg's runs are predicted from its steady hops; one with a toe mass
/// runs the initial states at the middle speed alone.
StudyData SteadyData(const StudyData& data, bool has_toe_mass);
StudyRuns RunSteady(const StudyHopper& hopper, const StudyData& steady_data, const RunWants& wants);

/// The runs of table 6.5 alone.
std::vector<double> RunEnergy(const StudyHopper& hopper, const StudyData& data);

ControlledSettings SettingsOf(const ModulusRow& row);
ControlledSettings SettingsOf(const StartCell& cell);

}  // namespace hoplab
