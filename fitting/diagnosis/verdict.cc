#include "fitting/diagnosis/verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace hoplab {
namespace {

// Whether some free force gains more than it must: the chi-square its dimensions reach once in
// twenty searches over all groups.
bool FreeForcePays(const Detection& detection) {
  const std::size_t groups = detection.tests.size() - detection.candidates;
  for (std::size_t i = detection.candidates; i < detection.tests.size(); ++i) {
    if (detection.tests[i].p_value < 0.05 / static_cast<double>(std::max<std::size_t>(groups, 1)))
      return true;
  }
  return false;
}

std::string NamesOf(const FittedModel& e) {
  std::string names;
  for (const Candidate& c : e.members) names += (names.empty() ? "" : " + ") + c.Name();
  return names;
}

void WeighWhatIsLeft(Diagnosis& d, double material) {
  const FittedModel& best = d.naming.best;
  d.left.noise = best.problem.noise;
  d.left.probability = best.evidence.discrepancy_probability();
  d.left.share = d.extension ? 1.0 - d.extension->explained : 1.0;
  d.left.material = d.left.probability > 0.5 && d.left.share > material;
}

// Something stands out, but it is much less than the noise and no main cause is likely.
void JudgeSlight(Diagnosis& d) {
  constexpr double kLeastTold = 0.005;
  d.verdict = Verdict::kAdequate;
  const double over_noise = MisfitOverNoise(d.detection);
  char text[120];
  std::snprintf(
      text, sizeof text, "what stands out is %s%.2f of the noise, and %s",
      over_noise < kLeastTold ? "under " : "", std::max(over_noise, 2.0 * kLeastTold),
      d.ShowsLateAlone() ? "late alone, as a model's own error does" : "no main cause is likely");
  d.reason = text;
}

// Where something stands out of the noise.
void JudgeWhatIsSeen(Diagnosis& d) {
  const Detection& seen = d.detection;
  if (!d.extension) {
    if (!d.set_aside.empty()) return JudgeSlight(d);
    if (d.left.material && FreeForcePays(seen)) {
      d.verdict = Verdict::kUnexplained;
      d.reason =
          "a free force or reading is needed, and no effect of the catalogue pays for "
          "its parameters";
    } else {
      d.verdict = Verdict::kAdequate;
      d.reason = "a test stands out, but no effect gains what it must";
    }
    return;
  }
  const ExtensionReport& e = *d.extension;
  const double chance = e.Probability();
  const bool remains = d.left.material;
  // Where what is left is more than the noise itself, even odds are not enough.
  const bool likely =
      chance >= (LeftOverNoise(d.detection, d.left.share) > 1.0 ? kProbable : kLikely);
  if (e.IsBeyondPhysics()) {
    d.verdict = Verdict::kUnexplained;
    d.reason = "the best extension, " + NamesOf(d.naming.best) + ", " + WhatItNeeds(e);
  } else if (remains && e.explained < kExplained && chance < kProbable) {
    d.verdict = Verdict::kUnexplained;
    char text[96];
    std::snprintf(text, sizeof text, " explains only %.0f %% of the misfit", 100.0 * e.explained);
    d.reason = "the best extension, " + NamesOf(d.naming.best) + "," + text;
  } else if (chance < kUnlikely || (!likely && (remains || e.InDoubt()))) {
    d.verdict = Verdict::kUnexplained;
    char text[160];
    std::snprintf(text, sizeof text,
                  chance < kLikely
                      ? " is less likely than something outside the catalogue (probability %.2f)"
                      : " leaves more than the noise and is too unsure for that (probability %.2f)",
                  chance);
    d.reason = "the best extension, " + NamesOf(d.naming.best) + "," + text;
  } else {
    const bool alone = e.Alone(d.naming), sure = e.Probability() >= kSure;
    d.verdict = alone && sure ? Verdict::kNamed : Verdict::kConfounded;
    d.reason = !alone ? "several effects do as well within the noise"
               : sure ? "nothing else in the catalogue does as well"
                      : "something outside the catalogue may do as well";
    if (e.InDoubt()) d.reason += remains ? "; some misfit remains" : "; some misfit may remain";
  }
}

// What is left may hide a cause, or stand for one, and so may a name in doubt.
void WithdrawExclusions(Diagnosis& d) {
  for (CandidateResult& c : d.naming.candidates) {
    if (c.status == CandidateStatus::kExcluded) c.status = CandidateStatus::kNotNeeded;
    c.bound95.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
}

}  // namespace

double MisfitOverNoise(const Detection& seen) {
  const double excess = seen.chi2 - seen.degrees_of_freedom;
  return excess > 0.0 ? std::sqrt(excess / seen.degrees_of_freedom) : 0.0;
}

double LeftOverNoise(const Detection& seen, double share) {
  return std::sqrt(std::max(share, 0.0)) * MisfitOverNoise(seen);
}

bool LeavesSeen(const Detection& seen, const FittedModel& model) {
  const double share = LeftShare(seen, 2.0 * model.cost, model.parameter_count());
  return model.evidence.discrepancy_probability() > 0.5 && LeftOverNoise(seen, share) >= kSlight;
}

bool IsSlight(const Detection& seen, const ExtensionReport& report, double likely) {
  const std::vector<const CauseReport*> told = report.ToldCauses();
  const double square = seen.chi2 / seen.degrees_of_freedom - 1.0;
  return std::abs(square) < kSlight * kSlight &&
         std::none_of(told.begin(), told.end(),
                      [&](const CauseReport* c) { return c->group_probability >= likely; });
}

std::string WhatItNeeds(const ExtensionReport& e) {
  return e.at_bound ? "needs a size beyond what is physical"
                    : "leaves " + e.at_wall.front() + " at the end of its range";
}

bool NamesSomething(const Diagnosis& d) { return d.extension && d.verdict != Verdict::kAdequate; }

double LeftShare(const Detection& seen, double square, int parameters) {
  const double excess = seen.chi2 - seen.degrees_of_freedom;
  const double left = square - (seen.degrees_of_freedom - parameters);
  return excess > 0.0 ? std::clamp(left / excess, 0.0, 1.0) : 0.0;
}

void Judge(Diagnosis& d, double material) {
  WeighWhatIsLeft(d, material);
  if (d.detection.p_value > kDetectionLevel) {
    d.left.material = false;
    d.verdict = Verdict::kAdequate;
    d.reason = "no test stands out of what noise alone gives";
    return;
  }
  JudgeWhatIsSeen(d);
  const bool earned =
      d.verdict == Verdict::kNamed || (d.verdict == Verdict::kAdequate && d.set_aside.empty());
  if (!earned || d.left.material) WithdrawExclusions(d);
}

std::string_view NameOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kAdequate:
      return "adequate";
    case Verdict::kNamed:
      return "named";
    case Verdict::kConfounded:
      return "confounded";
    case Verdict::kUnexplained:
      return "unexplained";
  }
  return "";
}

std::vector<const CauseReport*> ExtensionReport::MainCauses() const {
  std::vector<const CauseReport*> main;
  for (const CauseReport& c : causes) {
    if (c.main) main.push_back(&c);
  }
  return main;
}

std::vector<const CauseReport*> ExtensionReport::ToldCauses() const {
  std::vector<const CauseReport*> told = MainCauses();
  if (told.empty()) {
    for (const CauseReport& c : causes) told.push_back(&c);
  }
  return told;
}

bool ExtensionReport::TellsSizesOf(const CauseReport& cause, std::size_t k) const {
  if (cause.cause.each_trial) return true;
  if (!sizes || !Differs(cause.sizes[k])) return false;
  return sizes->refitted && sizes->pays && sizes->matters && cause.refitted[k];
}

double ExtensionReport::ToldProbability() const {
  double least = 1.0;
  for (const CauseReport* c : ToldCauses()) least = std::min(least, c->group_probability);
  return least;
}

double ExtensionReport::Probability() const {
  double least = ToldProbability();
  for (const CauseReport& c : causes)
    if (c.stands_in) least = std::min(least, c.group_probability);
  return least;
}

bool ExtensionReport::Alone(const Naming& naming) const {
  const std::vector<const CauseReport*> told = ToldCauses();
  return std::all_of(told.begin(), told.end(),
                     [&](const CauseReport* c) { return naming.GroupOf(c->candidate).size() < 2; });
}

std::optional<int> Diagnosis::Cause() const {
  if (!extension || extension->causes.empty()) return std::nullopt;
  return extension->ToldCauses().front()->candidate;
}

double Diagnosis::UnlistedProbability() const {
  return extension ? 1.0 - extension->Probability() : naming.unlisted_probability;
}

bool Diagnosis::ShowsLateAlone() const {
  return nothing_seen_before && !extension &&
         std::any_of(set_aside.begin(), set_aside.end(),
                     [](const SetAside& s) { return s.group_probability >= kLikely; });
}

bool Diagnosis::CausesMayStandIn() const {
  return verdict == Verdict::kUnexplained ||
         (verdict == Verdict::kConfounded && UnlistedProbability() > 0.5);
}

}  // namespace hoplab
