#include "app/records/diagnosis_tables.h"

#include <algorithm>
#include <array>

#include "app/records/csv.h"
#include "app/records/trajectory_tables.h"
#include "app/records/trial_tables.h"
#include "base/nan.h"
#include "base/text.h"
#include "fitting/trial_noise.h"

namespace hoplab {
namespace {

std::string_view ChannelNameOf(const FitProblem& problem, int channel) {
  return NameOf(channel < 0 ? Channel::kContact
                            : problem.channels[static_cast<std::size_t>(channel)].channel);
}

// One row a candidate's parameter.
std::string Candidates(const Diagnosis& d) {
  CsvText csv({"effect", "only_in_trial", "status", "score", "p_value", "predicted_gain_nats",
               "refit_gain_nats", "heldout_gain_nats_per_sample", "heldout_low", "heldout_high",
               "power", "parameter", "unit", "typical", "expected_size", "refit_value", "bound95"});
  for (std::size_t i = 0; i < d.naming.candidates.size(); ++i) {
    const CandidateResult& c = d.naming.candidates[i];
    const bool seen = c.score.rank > 0, refitted = c.alone.ok();
    const std::optional<HeldOutGain> gain =
        i < d.candidate_gains.size() ? d.candidate_gains[i] : std::nullopt;
    const auto ci = gain ? gain->ci95 : std::nullopt;
    for (int k = 0; k < c.candidate.parameter_count(); ++k) {
      const EffectParameter& p = c.candidate.Parameter(k);
      const auto at = [k](const Eigen::VectorXd& v) { return k < v.size() ? v[k] : kNaN; };
      csv.Cell(c.candidate.effect->info.name)
          .Cell(Join(c.candidate.only_recordings, "+"))
          .Cell(NameOf(c.status))
          .Cell(seen ? c.score.score : kNaN)
          .Cell(seen ? c.score.p_value : kNaN)
          .Cell(seen ? c.score.predicted_gain : kNaN)
          .Cell(refitted ? c.gain : kNaN)
          .Cell(gain ? gain->nats_per_sample : kNaN)
          .Cell(ci ? ci->first : kNaN)
          .Cell(ci ? ci->second : kNaN)
          .Cell(c.power)
          .Cell(p.name)
          .Cell(p.unit)
          .Cell(p.typical)
          .Cell(at(c.score.size))
          .Cell(refitted ? at(c.alone.ValuesOf(0)) : kNaN)
          .Cell(at(c.bound95))
          .EndRow();
    }
  }
  return csv.text();
}

std::string Misfit(const Diagnosis& d) {
  CsvText csv({"by", "mode", "phase", "channel", "hop", "trial", "share", "rows", "chi2",
               "expected", "p_value"});
  const auto numbers = [&](const auto& part) {
    csv.Cell(part.share)
        .Cell(static_cast<double>(part.rows))
        .Cell(part.chi2)
        .Cell(part.expected)
        .Cell(part.p_value)
        .EndRow();
  };
  const std::string_view none;
  for (const MisfitCell& c : d.localisation.cells) {
    csv.Cell(std::string_view("cell")).Cell(NameOf(c.mode)).Cell(c.phase);
    csv.Cell(ChannelNameOf(d.problem, c.channel)).Cell(none).Cell(none);
    numbers(c);
  }
  for (const MisfitPart& p : d.localisation.hops) {
    csv.Cell(std::string_view("hop")).Cell(none).Cell(none).Cell(none);
    csv.Cell(static_cast<double>(p.index)).Cell(none);
    numbers(p);
  }
  const std::vector<TrialProblem> train = TrialsOf(d.problem, TrialRole::kTrain);
  for (const MisfitPart& p : d.localisation.trials) {
    csv.Cell(std::string_view("trial")).Cell(none).Cell(none).Cell(none).Cell(none);
    csv.Cell(train[static_cast<std::size_t>(p.index)].file);
    numbers(p);
  }
  return csv.text();
}

}  // namespace

std::string ResidualsTable(const Diagnosis& d, const HeldOutErrors* extended) {
  CsvText csv({"trial", "role", "time_s", "channel", "measured", "before", "after", "sigma"});
  const std::size_t width = d.problem.channels.size();
  for (std::size_t i = 0; i < d.before.trials.size(); ++i) {
    const TrialProblem& trial = d.problem.trials[i];
    const std::vector<double>& before = d.before.trials[i].trajectory.samples;
    const std::vector<double>* after = extended ? &extended->trials[i].trajectory.samples : nullptr;
    for (std::size_t cell = 0; cell < trial.data.size(); ++cell) {
      csv.Cell(trial.file)
          .Cell(std::string_view(RoleName(trial.role)))
          .Cell(trial.begin_s + trial.row_times[cell / width])
          .Cell(NameOf(d.problem.channels[cell % width].channel))
          .Cell(trial.data[cell])
          .Cell(before[cell])
          .Cell(after ? (*after)[cell] : kNaN)
          .Cell(SigmaIn(d.problem, trial, cell % width))
          .EndRow();
    }
  }
  return csv.text();
}

std::string EvidenceTable(const FittedModel& null, std::span<const Candidate> members,
                          const std::vector<std::string>& names) {
  CsvText csv({"effect", "parameter", "trial", "time_s", "channel", "mode", "running", "evidence"});
  const std::vector<TrialProblem> train = TrialsOf(null.problem, TrialRole::kTrain);
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Candidate& member = members[m];
    const std::array one = {member};
    const FitProblem problem = Extend(null.problem, one);
    Eigen::VectorXd shared(problem.shared_count());
    shared << null.shared, NullValues(one);
    const Linearisation at =
        Linearise(problem, null.problem.shared_count(), train, shared, null.initial_states, 1);
    for (int k = 0; k < member.parameter_count(); ++k) {
      const Eigen::VectorXd evidence = RunningEvidence(at, k);
      double running = 0.0;
      int running_trial = -1;
      for (int row = 0; row < at.rows(); ++row) {
        const RowLabel& label = at.labels[static_cast<std::size_t>(row)];
        const TrialProblem& trial = train[static_cast<std::size_t>(label.trial)];
        if (label.of == RowLabel::Of::kPrior) continue;
        if (!Holds(member.only_recordings, trial.recording)) continue;
        running = evidence[row] + (label.trial == running_trial ? running : 0.0);
        running_trial = label.trial;
        csv.Cell(names[m])
            .Cell(member.Parameter(k).name)
            .Cell(trial.file)
            .Cell(trial.begin_s + label.time)
            .Cell(ChannelNameOf(null.problem, label.channel))
            .Cell(NameOf(label.mode))
            .Cell(running)
            .Cell(evidence[row])
            .EndRow();
      }
    }
  }
  return csv.text();
}

namespace {

std::string Forces(const FreeForces& free_forces) {
  CsvText csv({"force", "unit", "against", "at", "value", "band95"});
  for (const ReconstructedForce& f : free_forces.forces) {
    for (const ForcePoint& p : f.points) {
      csv.Cell(f.group.name).Cell(f.group.unit).Cell(f.group.against);
      csv.Cell(p.at).Cell(p.value).Cell(p.band95).EndRow();
    }
  }
  return csv.text();
}

std::string EnergyTable(const EnergyLedger& ledger) {
  CsvText csv({"trial", "hop", "measured_begin_J", "measured_end_J", "before_begin_J",
               "before_end_J", "after_begin_J", "after_end_J"});
  for (std::size_t k = 0; k < ledger.hops.size(); ++k) {
    const HopEnergy& h = ledger.hops[k];
    csv.Cell(ledger.recording).Cell(static_cast<double>(k));
    const HopBalance after = h.after.value_or(HopBalance{kNaN, kNaN});
    for (const HopBalance& b : {h.measured, h.before, after}) csv.Cell(b.begin).Cell(b.end);
    csv.EndRow();
  }
  return csv.text();
}

// The model as it was and, if there is one, the extended one, on every trial.
std::vector<AssessedModel> ModelsOf(const Diagnosis& d) {
  std::vector<AssessedModel> models = {{&d.problem, &d.null.shared, &d.before.trials, "before"}};
  if (d.extension) {
    const FittedModel& best = d.naming.best;
    models.push_back({&best.problem, &best.shared, &d.extension->after.trials, "after"});
  }
  return models;
}

std::string Trajectories(const Diagnosis& d) {
  CsvText csv(
      TrajectoryHeader(TrialLabels(true), RobotLegsOf(d.problem.trials.front().parameters)));
  for (const AssessedModel& model : ModelsOf(d)) AddTrialTrajectories(model, csv);
  return csv.text();
}

std::string Events(const Diagnosis& d) {
  CsvText csv(EventHeader(TrialLabels(true), RobotLegsOf(d.problem.trials.front().parameters)));
  for (const AssessedModel& model : ModelsOf(d)) AddTrialEvents(model, csv);
  return csv.text();
}

}  // namespace

std::map<std::string, std::string> DiagnosisTables(const DiagnosisRun& run) {
  const Diagnosis& d = run.diagnosis;
  std::map<std::string, std::string> tables;
  if (!d.naming.candidates.empty()) tables["candidates.csv"] = Candidates(d);
  if (!d.localisation.cells.empty()) tables["misfit.csv"] = Misfit(d);
  if (!d.before.trials.empty()) {
    tables["residuals.csv"] = ResidualsTable(d, d.extension ? &d.extension->after : nullptr);
    tables["trajectories.csv"] = Trajectories(d);
    tables["events.csv"] = Events(d);
  }
  if (const std::vector<Candidate>& members = d.naming.best.members; !members.empty()) {
    std::vector<std::string> names;
    for (const Candidate& c : members) names.emplace_back(c.effect->info.name);
    tables["evidence.csv"] = EvidenceTable(d.null, members, names);
  }
  if (d.free_forces) tables["forces.csv"] = Forces(*d.free_forces);
  if (!run.energy.hops.empty()) tables["energy.csv"] = EnergyTable(run.energy);
  return tables;
}

}  // namespace hoplab
