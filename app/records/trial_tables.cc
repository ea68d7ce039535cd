#include "app/records/trial_tables.h"

#include "app/records/trajectory_tables.h"
#include "fitting/driven_trial.h"
#include "fitting/trial_evaluator.h"

namespace hoplab {
namespace {

constexpr double kTrajectoryRate = 500.0;  // Hz

RunLabels LabelsOf(const AssessedModel& model, std::size_t trial) {
  RunLabels labels = {(*model.trials)[trial].file};
  if (!model.label.empty()) labels.push_back(model.label);
  return labels;
}

// Calls `body` with a trial's request at the fitted values; what it points into lives as long as
// the call.
template <class Body>
void WithRequest(const AssessedModel& model, std::size_t place, const Body& body) {
  const FitProblem& problem = *model.problem;
  const TrialProblem& trial = problem.trials[place];
  TrialRequest whole;
  FillTrialRequest(problem, trial, *model.shared, (*model.trials)[place].start, whole);
  SimulationRequest& request = whole.request;
  request.channel_clocks = {};  // a trajectory, no readings
  request.horizon = trial.row_times.back();
  request.integrator = problem.integrator;
  body(request);
}

}  // namespace

std::vector<std::string> TrialLabels(bool several_models) {
  if (several_models) return {"trial", "model"};
  return {"trial"};
}

void AddTrialTrajectories(const AssessedModel& model, CsvText& csv) {
  for (std::size_t i = 0; i < model.trials->size(); ++i) {
    WithRequest(model, i, [&](const SimulationRequest& request) {
      AddTrajectoryRows(request, kTrajectoryRate, LabelsOf(model, i),
                        model.problem->trials[i].begin_s, csv);
    });
  }
}

void AddTrialEvents(const AssessedModel& model, CsvText& csv) {
  for (std::size_t i = 0; i < model.trials->size(); ++i) {
    AddEventRows((*model.trials)[i].trajectory, LabelsOf(model, i),
                 model.problem->trials[i].begin_s, csv,
                 RobotLegsOf(model.problem->trials[i].parameters));
  }
}

Json FittedMechanismRecord(const AssessedModel& model) {
  Json record = nullptr;
  if (model.trials->empty()) return record;
  WithRequest(model, 0,
              [&](const SimulationRequest& request) { record = MechanismRecord(request); });
  return record;
}

}  // namespace hoplab
