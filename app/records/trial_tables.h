#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "app/records/csv.h"
#include "app/records/run_record.h"
#include "fitting/trial_errors.h"

namespace hoplab {

/// A model with fitted values, and the trials it was assessed on.
struct AssessedModel {
  const FitProblem* problem = nullptr;
  const Eigen::VectorXd* shared = nullptr;
  const std::vector<TrialErrors>* trials = nullptr;  // in the problem's order
  std::string label;                                 // "before", "after"; empty: the only one
};

/// Names of the labels of such tables: trial, and model where there are several.
std::vector<std::string> TrialLabels(bool several_models);

/// Rows of trajectories.csv and events.csv, at the times of the dataset's own files.
void AddTrialTrajectories(const AssessedModel& model, CsvText& csv);
void AddTrialEvents(const AssessedModel& model, CsvText& csv);

/// What hops in the first trial, at the fitted values; see MechanismRecord.
Json FittedMechanismRecord(const AssessedModel& model);

}  // namespace hoplab
