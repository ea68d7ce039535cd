#include "fitting/diagnosis/after_verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/text.h"
#include "fitting/diagnosis/candidate.h"

namespace hoplab {
namespace {

// Of the most that a cause gains alone: below that it is not measured on held-out trials.
constexpr double kLeastGain = 0.01;

// Sizes and intervals are those for the shapes that are given.
void NoteShapes(Diagnosis& d) {
  if (!d.extension) return;
  std::string what, free;
  for (const SharedParameter& s : d.naming.best.problem.shared)
    free += (free.empty() ? "" : ",") + s.name;
  std::vector<const Effect*> noted;
  for (const CauseReport* c : d.extension->ToldCauses()) {
    const Effect* effect = c->cause.effect;
    if (std::find(noted.begin(), noted.end(), effect) != noted.end()) continue;
    noted.push_back(effect);
    for (const EffectParameter& p : effect->info.parameters) {
      if (!p.is_shape) continue;
      const std::string name = std::string(effect->info.name) + "." + std::string(p.name);
      char value[32];
      std::snprintf(value, sizeof value, " %.4g", p.null);
      what += (what.empty() ? "" : ", ") + name + value;
      if (p.unit != "-") what += " " + std::string(p.unit);
      free += "," + name;
    }
  }
  if (!what.empty())
    d.notes.push_back("sizes are told for " + what + ", which are taken as given; `hoplab fit " +
                      "--free " + free + "` fits them, too");
}

// A model whose own noise was not sought is measured under that of the model without causes, which
// it is compared with.
HeldOutErrors ErrorsOf(const FittedModel& alone, const Diagnosis& d, int jobs) {
  if (alone.settled) return MeasureHeldOut(alone, jobs, /*test_only=*/true, &d.before);
  FittedModel alike = alone;
  alike.problem.noise = d.null.problem.noise;
  return MeasureHeldOut(alike, jobs, /*test_only=*/true, &d.before);
}

// Filters that are told, where the noise does not tell of them.
void NoteUnseenFilters(Diagnosis& d) {
  if (!d.extension) return;
  std::vector<const CauseReport*> filters = d.extension->ToldCauses();
  std::erase_if(filters, [](const CauseReport* c) {
    return c->cause.effect->info.filter == RecordFilter::kNone;
  });
  if (filters.empty()) return;
  std::vector<std::string> told;
  for (const Candidate& unseen : UnseenFilters(d.problem, {}))
    for (const CauseReport* c : filters)
      if (c->cause.effect == unseen.effect) told.push_back(c->cause.Name());
  if (!told.empty())
    d.notes.push_back("the noise alone does not tell of " + Join(told) +
                      ": it may have come in after the filter");
}

// A stiffness or a damping of the mechanism, by its unit.
bool GoesWithMass(const SharedParameter& s) {
  return s.direction.of == SensitivityDirection::Of::kParameter &&
         (s.unit.starts_with("Pa") || s.unit.starts_with("N"));
}

// Whether the data know the body's mass at all, as a share of what is stated.
bool IsWeighed(const CandidateResult& mass) {
  constexpr double kWorst = 1.0;
  const double typical = mass.candidate.Parameter(0).typical;
  return mass.separable && 1.96 * typical < kWorst * std::sqrt(mass.power);
}

// Motion alone tells forces per mass: where nothing weighs the body, what is fitted goes with the
// stated mass, and no interval holds that.
void NoteMass(Diagnosis& d) {
  const std::vector<SharedParameter>& shared = d.problem.shared;
  const auto force = std::find_if(shared.begin(), shared.end(), GoesWithMass);
  if (d.problem.trials.empty() || force == shared.end()) return;
  const Effect* scale = FindEffect("body_mass_scale");
  const bool unseen = std::any_of(d.naming.candidates.begin(), d.naming.candidates.end(),
                                  [&](const CandidateResult& c) {
                                    return c.candidate.effect == scale && c.candidate.in_all() &&
                                           c.status == CandidateStatus::kNotTested && !IsWeighed(c);
                                  });
  if (!unseen) return;
  const std::string& first = force->name;
  char text[200];
  std::snprintf(text, sizeof text,
                "%s is that of a body of %.4g kg: nothing here weighs it, and a body 1 %% heavier "
                "would have %s 1 %% larger",
                first.c_str(), d.problem.trials.front().parameters.m, first.c_str());
  d.notes.emplace_back(text);
}

// Gravity that is turned looks like a steady force: the camera was turned with its track.
void NoteTilt(Diagnosis& d) {
  if (!d.extension || d.problem.trials.empty()) return;
  constexpr double kMostTilt = 0.2;  // rad
  const FittedModel& model = d.naming.best;
  const Parameters<double>& p = d.problem.trials.front().parameters;
  for (const CauseReport* c : d.extension->ToldCauses()) {
    const auto at = std::find_if(model.members.begin(), model.members.end(),
                                 [&](const auto& m) { return m == c->cause; });
    if (c->cause.effect != FindEffect("constant_force") || at == model.members.end()) continue;
    if (c->cause.each_trial) continue;  // no tilt is another one in each trial
    const double force = model.ValuesOf(static_cast<int>(at - model.members.begin()))[0];
    const double tilt = -force / (p.m * p.g);
    if (!(std::abs(tilt) < kMostTilt)) continue;
    char text[240];
    std::snprintf(text, sizeof text,
                  "a ground that rises by %.3g deg does the same as %s where the camera is turned "
                  "with it: look whether plumb lines are upright in the picture",
                  tilt * 180.0 / std::numbers::pi, c->cause.Name().c_str());
    d.notes.emplace_back(text);
  }
}

void MeasureCandidates(Diagnosis& d, const DiagnosisOptions& options) {
  d.candidate_gains.resize(d.naming.candidates.size());
  double most = 0.0;
  for (const CandidateResult& c : d.naming.candidates) most = std::max(most, c.gain);
  ParallelFor(static_cast<int>(d.candidate_gains.size()), options.fit.jobs, [&](int i) {
    const CandidateResult& c = d.naming.candidates[static_cast<std::size_t>(i)];
    // What gained nothing on the fitted trials has nothing to show on the others.
    if (!c.alone.ok() || c.gain < std::max(1.0, kLeastGain * most) || options.fit.IsStopped())
      return;
    d.candidate_gains[static_cast<std::size_t>(i)] =
        CompareHeldOut(d.null, d.before, ErrorsOf(c.alone, d, options.fit.jobs),
                       options.Seed(Draws::kBootstrap), nullptr);
  });
}

void ProposeNextTrial(Diagnosis& d, const DiagnosisOptions& options) {
  if (!d.extension || d.verdict == Verdict::kUnexplained) return;
  const std::vector<TrialProblem> train = TrialsOf(d.problem, TrialRole::kTrain);
  for (const std::vector<FittedModel>& rivals : d.naming.rivals) {
    // A trial to come has a size of its own, which nobody knows.
    if (rivals.size() < 2 || d.experiment || rivals.front().has_own_sizes() ||
        options.fit.IsStopped())
      continue;
    if (options.stage) options.stage("looking for the trial that would tell the causes apart");
    d.experiment = ProposeExperiment(rivals, train, options.fit.jobs);
  }
}

}  // namespace

void TellBesides(Diagnosis& d, const DiagnosisOptions& options) {
  if (!d.refusal.empty()) return;
  if (!d.interrupted) NoteMass(d);
  if (!d.extension && d.set_aside.empty()) return;
  NoteShapes(d);
  NoteUnseenFilters(d);
  NoteTilt(d);
  if (options.fit.IsStopped()) return;
  MeasureCandidates(d, options);
  ProposeNextTrial(d, options);
}

}  // namespace hoplab
