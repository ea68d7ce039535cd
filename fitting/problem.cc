#include "fitting/problem.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/check.h"
#include "base/input_error.h"
#include "base/nan.h"
#include "base/text.h"
#include "fitting/driven_trial.h"
#include "fitting/filtered_noise.h"
#include "fitting/model_of_spec.h"
#include "fitting/robot_problem.h"
#include "fitting/shared_parameters.h"
#include "fitting/trial_noise.h"
#include "fitting/trial_start.h"
#include "model/mechanism_traits.h"

namespace hoplab {
namespace {

class Builder {
 public:
  Builder(const Dataset& dataset, const ProblemOptions& options)
      : dataset_(dataset), options_(options), mechanism_(dataset.mechanism.type) {}

  FitProblem Build() {
    problem_.law = ResolveLaw(options_.law, mechanism_, "--law");
    problem_.integrator = options_.integrator;
    problem_.clocks = ClocksOf(dataset_);
    AddFormulas();
    problem_.known = KnownCauses(WithFactsOf(dataset_.mechanism, dataset_.known), problem_.formulas,
                                 ParametersOfSpec(dataset_.mechanism, std::nullopt, 0.0));
    if (const std::string known = problem_.known.Text(); !known.empty())
      problem_.notes.push_back("known of the set-up: " + known);
    NoteDisplacedAir();
    AddTrials();
    AddChannels();
    FillTrials();
    for (std::size_t c = 0; c < problem_.channels.size(); ++c) {
      if (!problem_.channels[c].sigma_estimated) continue;
      for (std::string& found : FindTrialNoise(problem_, c))
        problem_.notes.push_back(std::move(found));
    }
    ChooseModuli(options_, problem_);
    AddSharedParameters(dataset_, options_, problem_);
    if (const std::vector<std::string> stand = AddStandingFeet(problem_); !stand.empty())
      problem_.notes.push_back(
          std::to_string(stand.size()) + (stand.size() == 1 ? " trial begins" : " trials begin") +
          " with a foot on the ground (" + stand.front() + (stand.size() > 1 ? ", ..." : "") +
          "): how far each such foot is ahead of its place below the leg, and how far its motor is "
          "turned, is fitted (foot_ahead_1, motor_ahead_1, ...)");
    return std::move(problem_);
  }

 private:
  void NoteDisplacedAir() {
    const MechanismSpec& m = dataset_.mechanism;
    const double slower = 1.0 - FreeFall(m) / m.gravity_m_per_s2;
    if (slower < 1e-3) return;
    char note[160];
    std::snprintf(note, sizeof note,
                  "the air that the ball displaces makes it fall %.1f %% slower, as modelled "
                  "(ball.air_density_kg_per_m3 is %g)",
                  100.0 * slower, *m.ball.air_density_kg_per_m3);
    problem_.notes.emplace_back(note);
  }

  void AddTrials() {
    for (const Trial& trial : dataset_.trials) {
      TrialProblem t;
      t.file = t.recording = trial.file;
      t.role = trial.role;
      t.parameters = ParametersOfSpec(trial.mechanism, trial.controller, trial.touchdown_angle_rad);
      CheckReading(trial.mechanism.reading, problem_.law, dataset_.origin.place);
      t.liftoff = trial.mechanism.liftoff;
      const std::vector<double>& time = trial.trace.time_s;
      t.begin_s = time.front();
      t.row_times.reserve(time.size());
      for (double s : time) t.row_times.push_back(s - time.front());
      problem_.trials.push_back(std::move(t));
    }
  }

  void AddChannels() {
    std::optional<NoiseShape> noise;
    for (const ChannelSpec& spec : dataset_.channels) {
      if (spec.id == Channel::kContact) {
        problem_.uses_contact = true;
        problem_.contact_clock = ClockOf(spec);
        if (spec.sigma)
          problem_.notes.push_back(
              "the sigma of contact is not used: a time of contact is known to "
              "within the rows it lies between");
        continue;
      }
      if (IsContact(spec.id)) {
        problem_.notes.push_back(std::string(ChannelName(spec.id)) + " is not compared");
        continue;
      }
      ChannelProblem c{spec.id, spec.sigma.value_or(kNaN), !spec.sigma};
      c.clock = ClockOf(spec);
      if (!spec.sigma) {
        if (!noise) noise = NoiseShapeOf(dataset_);
        c.sigma = NoiseInTraces(dataset_, spec.id, *noise);
        if (!(c.sigma > 0.0)) {
          throw InputError(
              {spec.origin.place, std::string(ChannelName(spec.id)) + ": {sigma: estimate}",
               "the noise cannot be estimated from so few (or constant) samples",
               "State sigma, one standard deviation in the channel's unit, or look with "
               "--keep-stray whether samples that were set aside are missed."});
        }
        problem_.notes.push_back("noise of " + std::string(ChannelName(spec.id)) +
                                 " estimated from the traces: " + Rounded(c.sigma));
      }
      problem_.channels.push_back(c);
    }
    if (problem_.channels.empty() && !problem_.uses_contact) {
      throw InputError({dataset_.origin.place, "channels", "names nothing to compare", ""});
    }
  }

  int ClockOf(const ChannelSpec& spec) const {
    for (std::size_t i = 0; i < problem_.clocks.size(); ++i)
      if (problem_.clocks[i].name == spec.clock) return static_cast<int>(i);
    return -1;
  }

  void FillTrials() {
    const std::size_t width = problem_.channels.size();
    for (std::size_t i = 0; i < problem_.trials.size(); ++i) {
      const Trial& trial = dataset_.trials[i];
      TrialProblem& t = problem_.trials[i];
      t.data.assign(t.row_times.size() * width, kNaN);
      for (std::size_t c = 0; c < width; ++c) {
        const std::vector<double>* values = trial.trace.Find(NameOf(problem_.channels[c].channel));
        if (!values) continue;
        for (std::size_t row = 0; row < values->size(); ++row) {
          t.data[row * width + c] = (*values)[row];
          if (!std::isnan((*values)[row])) ++t.sample_count;
        }
      }
      if (problem_.uses_contact) ReadContact(trial, t);
      SetStart(trial, problem_, t);
      AddDriven(trial, problem_, t);
    }
  }

  // Switching times of a contact column. What bounces has left the ground as soon as it meets it.
  void ReadContact(const Trial& trial, TrialProblem& t) const {
    const std::vector<double>* contact = trial.trace.Find(Channel::kContact);
    if (!contact) return;
    int last = -1;
    for (std::size_t row = 0; row < contact->size(); ++row) {
      if (std::isnan((*contact)[row])) continue;
      const bool down = (*contact)[row] > 0.5;
      const bool compared = down || TraitsOf(problem_.law).has_stance;
      if (last >= 0 && (*contact)[row] != (*contact)[last] && compared) {
        const double a = t.row_times[last], b = t.row_times[row];
        (down ? t.contact.touchdown_s : t.contact.liftoff_s).push_back(0.5 * (a + b));
        (down ? t.contact.touchdown_sigma_s : t.contact.liftoff_sigma_s)
            .push_back((b - a) / std::sqrt(12.0));
        ++t.sample_count;
      }
      last = static_cast<int>(row);
    }
  }

  // The dataset's formulas, and those that --with names by their files.
  void AddFormulas() {
    for (const EffectFile& file : dataset_.effects)
      AddFormula(EffectOfFile(file), file.origin.place);
    for (const std::string& name : options_.with_effects)
      if (IsEffectFile(name)) AddFormula(ResolveEffect(name, "--with"), name);
  }
  void AddFormula(const Effect& effect, const std::string& place) {
    for (const Effect* other : problem_.formulas) {
      if (other == &effect) return;
      if (other->info.name == effect.info.name)
        throw InputError({place, "name = " + std::string(effect.info.name),
                          "is the name of another formula of this dataset",
                          "Call one of the two otherwise."});
    }
    problem_.formulas.push_back(&effect);
  }

  const Dataset& dataset_;
  const ProblemOptions& options_;
  MechanismKind mechanism_;
  FitProblem problem_;
};

}  // namespace

bool Holds(const Recordings& of, const std::string& recording) {
  return of.empty() || std::find(of.begin(), of.end(), recording) != of.end();
}

LegMass FitProblem::leg_mass() const {
  const bool any = std::any_of(trials.begin(), trials.end(),
                               [](const TrialProblem& t) { return t.parameters.m_toe > 0.0; });
  return any ? LegMass::kAtToe : LegMass::kNone;
}

ProblemOptions WithLegsAlike(ProblemOptions options) {
  options.legs_alike = true;
  return options;
}

RobotLegs FitProblem::robot_legs() const {
  if (trials.empty() || !trials.front().parameters.robot) return 0;
  const RobotParameters<double>& robot = *trials.front().parameters.robot;
  return {robot.legs, robot.straight_legs};
}

InputSet FitProblem::inputs() const {
  InputSet set = 0;
  for (const TrialProblem& t : trials)
    for (const DrivenColumn& column : t.inputs) set |= BitOf(column.kind);
  return set;
}

std::vector<std::string> FitProblem::shared_names() const {
  std::vector<std::string> names;
  for (const SharedParameter& s : shared) names.push_back(s.name);
  return names;
}

FitProblem MakeProblem(const Dataset& dataset, const ProblemOptions& options) {
  std::vector<TraceFault> faults = FindTraceFaults(dataset);
  FitProblem problem = options.keep_stray || faults.empty()
                           ? Builder(dataset, options).Build()
                           : Builder(WithoutFaults(dataset, faults), options).Build();
  const std::vector<std::string> sentences = FaultSentences(dataset, faults, options.keep_stray);
  problem.notes.insert(problem.notes.begin(), sentences.begin(), sentences.end());
  problem.trace_faults = std::move(faults);
  problem.keeps_stray = options.keep_stray;
  return problem;
}

std::vector<std::vector<double>> SamplesOf(const FitProblem& problem, std::size_t channel) {
  std::vector<std::vector<double>> samples;
  for (const TrialProblem& t : problem.trials) {
    std::vector<double>& column = samples.emplace_back();
    for (std::size_t cell = channel; cell < t.data.size(); cell += problem.channels.size())
      column.push_back(t.data[cell]);
  }
  return samples;
}

Eigen::VectorXd InitialShared(const FitProblem& problem) {
  Eigen::VectorXd values(problem.shared_count());
  for (int i = 0; i < problem.shared_count(); ++i) {
    const SharedParameter& s = problem.shared[i];
    // A start on a bound has only one side to go to: begin a tenth of a typical size inside.
    const double room = std::min(0.1 * s.scale, 0.25 * (s.upper - s.lower));
    values[i] = std::clamp(s.initial, s.lower + room, s.upper - room);
  }
  return values;
}

}  // namespace hoplab
