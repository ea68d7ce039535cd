#include "app/records/candidate_record.h"

#include "app/records/record_parts.h"

namespace hoplab {
namespace {

Json GainInterval(const std::optional<HeldOutGain>& gain) {
  return gain ? IntervalRecord(gain->ci95) : Json(nullptr);
}

Json RefitRecord(const CandidateResult& c, const std::optional<HeldOutGain>& gain) {
  if (!c.alone.ok()) return nullptr;
  Json parameters = Json::array();
  for (int i = 0; i < c.alone.problem.shared_count(); ++i) {
    const SharedParameter& s = c.alone.problem.shared[static_cast<std::size_t>(i)];
    parameters.push_back(
        {{"name", s.name}, {"unit", s.unit}, {"value", NumberOrNull(c.alone.shared[i])}});
  }
  return {{"parameters", parameters},
          {"heldout_gain", gain ? NumberOrNull(gain->nats_per_sample) : Json(nullptr)},
          {"ci95", GainInterval(gain)},
          {"gain_nats", NumberOrNull(c.gain)},
          {"at_bound", c.alone.AtPhysicalBound(0)}};
}

// One entry a parameter of the candidate's effect.
template <class Values>
Json ByEffectParameter(const Candidate& candidate, const Values& values) {
  Json out = Json::object();
  for (int i = 0; i < candidate.parameter_count(); ++i) {
    out[std::string(candidate.Parameter(i).name)] =
        i < values.size() ? NumberOrNull(values[i]) : Json(nullptr);
  }
  return out;
}

}  // namespace

Json CandidatesRecord(const Diagnosis& d) {
  Json out = Json::array();
  for (std::size_t i = 0; i < d.naming.candidates.size(); ++i) {
    const CandidateResult& c = d.naming.candidates[i];
    const bool seen = c.score.rank > 0;
    const std::optional<HeldOutGain> gain =
        i < d.candidate_gains.size() ? d.candidate_gains[i] : std::nullopt;
    out.push_back({{"effect", c.candidate.effect->info.name},
                   {"score", seen ? NumberOrNull(c.score.score) : Json(nullptr)},
                   {"p_value", seen ? NumberOrNull(c.score.p_value) : Json(nullptr)},
                   {"predicted_gain", seen ? NumberOrNull(c.score.predicted_gain) : Json(nullptr)},
                   {"refit", RefitRecord(c, gain)},
                   {"only_in_trial", OneTrial(c.candidate)},
                   {"only_in_trials", c.candidate.only_recordings},
                   {"status", NameOf(c.status)},
                   {"gain_nats", c.alone.ok() ? NumberOrNull(c.gain) : Json(nullptr)},
                   {"probability", NumberOrNull(c.probability)},
                   {"power", NumberOrNull(c.power)},
                   {"separable", c.separable},
                   {"expected_size", ByEffectParameter(c.candidate, c.score.size)},
                   {"bound95", ByEffectParameter(c.candidate, c.bound95)}});
  }
  return out;
}

}  // namespace hoplab
