#include "app/records/fit_tables.h"

#include "app/records/csv.h"
#include "app/records/trajectory_tables.h"
#include "app/records/trial_tables.h"
#include "fitting/trial_noise.h"

namespace hoplab {
namespace {

std::string Residuals(const FitRun& run) {
  CsvText csv({"trial", "time_s", "channel", "measured", "simulated", "whitened"});
  const std::size_t width = run.problem.channels.size();
  for (std::size_t i = 0; i < run.trials.size(); ++i) {
    const TrialProblem& trial = run.problem.trials[i];
    const std::vector<double>& samples = run.trials[i].trajectory.samples;
    for (std::size_t cell = 0; cell < trial.data.size(); ++cell) {
      const double measured = trial.data[cell], simulated = samples[cell];
      csv.Cell(trial.file)
          .Cell(trial.begin_s + trial.row_times[cell / width])
          .Cell(NameOf(run.problem.channels[cell % width].channel))
          .Cell(measured)
          .Cell(simulated)
          .Cell((simulated - measured) / SigmaIn(run.problem, trial, cell % width))
          .EndRow();
    }
  }
  return csv.text();
}

std::string Hops(const FitRun& run) {
  CsvText csv({"trial", "hop", "begin_s", "end_s", "channel", "rmse"});
  for (std::size_t i = 0; i < run.trials.size(); ++i) {
    const double offset = run.problem.trials[i].begin_s;
    const std::vector<HopErrors>& hops = run.trials[i].hops;
    for (std::size_t h = 0; h < hops.size(); ++h) {
      for (std::size_t c = 0; c < run.problem.channels.size(); ++c) {
        csv.Cell(run.trials[i].file)
            .Cell(static_cast<double>(h))
            .Cell(hops[h].begin + offset)
            .Cell(hops[h].end + offset)
            .Cell(NameOf(run.problem.channels[c].channel))
            .Cell(hops[h].rmse[c])
            .EndRow();
      }
    }
  }
  return csv.text();
}

std::string Events(const FitRun& run) {
  CsvText csv(EventHeader(TrialLabels(false), RobotLegsOf(run.problem.trials.front().parameters)));
  AddTrialEvents({&run.problem, &run.fit.shared, &run.trials, ""}, csv);
  return csv.text();
}

std::string Trajectories(const FitRun& run) {
  CsvText csv(
      TrajectoryHeader(TrialLabels(false), RobotLegsOf(run.problem.trials.front().parameters)));
  AddTrialTrajectories({&run.problem, &run.fit.shared, &run.trials, ""}, csv);
  return csv.text();
}

std::string Profiles(const FitRun& run) {
  CsvText csv({"parameter", "value", "delta_chi2"});
  for (const Profile& profile : run.profiles) {
    for (const ProfilePoint& p : profile.points) {
      csv.Cell(run.problem.shared[profile.parameter].name).Cell(p.value).Cell(p.delta_chi2);
      csv.EndRow();
    }
  }
  return csv.text();
}

}  // namespace

std::map<std::string, std::string> FitTables(const FitRun& run) {
  std::map<std::string, std::string> tables;
  if (!run.has_result) return tables;
  tables["residuals.csv"] = Residuals(run);
  tables["hops.csv"] = Hops(run);
  tables["events.csv"] = Events(run);
  tables["trajectories.csv"] = Trajectories(run);
  if (!run.profiles.empty()) tables["profile.csv"] = Profiles(run);
  return tables;
}

}  // namespace hoplab
