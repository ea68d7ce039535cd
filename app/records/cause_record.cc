#include "app/records/cause_record.h"

#include <cmath>

namespace hoplab {
namespace {

Json ParametersOfMember(const FittedModel& e, std::size_t member) {
  Json out = Json::array();
  const Candidate& c = e.members[member];
  const Eigen::VectorXd values = e.ValuesOf(static_cast<int>(member));
  for (int k = 0; k < c.parameter_count(); ++k) {
    const EffectParameter& p = c.Parameter(k);
    out.push_back({{"name", p.name}, {"unit", p.unit}, {"value", NumberOrNull(values[k])}});
  }
  return out;
}

// What its probability goes by, and what that was made of.
Json SeenRecord(const NameFeatures& features) {
  Json out = {{"left_gain", NumberOrNull(features.left_gain)},
              {"left_share", NumberOrNull(features.left_share)},
              {"remainder", NumberOrNull(features.remainder)}};
  const auto values = features.Values();
  for (std::size_t k = 0; k < values.size(); ++k)
    out[std::string(NameFeatures::Names()[k])] = NumberOrNull(values[k]);
  return out;
}

// Sizes trial by trial where trials do not agree on one; null where they do.
Json VariesRecord(const Diagnosis& d, const CauseReport& c) {
  if (!c.Varies()) return nullptr;
  const std::vector<TrialProblem> train = TrialsOf(d.problem, TrialRole::kTrain);
  Json out = Json::array();
  for (std::size_t k = 0; k < c.sizes.size(); ++k) {
    const Heterogeneity& h = c.sizes[k];
    const EffectParameter& p = c.cause.Parameter(static_cast<int>(k));
    Json trials = Json::array();
    for (std::size_t i = 0; i < h.sizes.size(); ++i)
      trials.push_back({{"trial", train[i].file}, {"value", NumberOrNull(h.sizes[i])}});
    out.push_back({{"name", p.name},
                   {"unit", p.unit},
                   {"mean", NumberOrNull(h.mean)},
                   {"spread", NumberOrNull(h.spread)},
                   {"p_value", NumberOrNull(h.p_value)},
                   {"gain_nats", NumberOrNull(h.gain)},
                   {"trials", trials}});
  }
  return out;
}

}  // namespace

Json MembersRecord(const std::vector<Candidate>& members) {
  Json names = Json::array();
  for (const Candidate& c : members) names.push_back(c.effect->info.name);
  return names;
}

Json GroupsRecord(const Diagnosis& d) {
  Json out = Json::array();
  for (std::size_t m = 0; m < d.naming.groups.size(); ++m) {
    Json members = Json::array();
    for (std::size_t k = 0; k < d.naming.groups[m].size(); ++k) {
      const auto place = static_cast<std::size_t>(d.naming.groups[m][k]);
      const Candidate& c = d.naming.candidates[place].candidate;
      const bool fitted = m < d.naming.rivals.size() && k < d.naming.rivals[m].size();
      members.push_back(
          {{"effect", c.effect->info.name},
           {"only_in_trial", TextOrNull(c.only_recording)},
           {"nats_behind",
            NumberOrNull(std::log(d.naming.group_weights[m][0] / d.naming.group_weights[m][k]))},
           {"with", fitted ? MembersRecord(d.naming.rivals[m][k].members) : Json(nullptr)}});
    }
    out.push_back(members);
  }
  return out;
}

Json CausesRecord(const Diagnosis& d) {
  Json out = Json::array();
  if (!d.extension) return out;
  const FittedModel& best = d.naming.best;
  for (const bool main : {true, false}) {
    for (const CauseReport& c : d.extension->causes) {
      if (c.main != main) continue;
      const std::size_t member = d.naming.MemberOf(c.candidate);
      out.push_back({{"name", c.cause.effect->info.name},
                     {"only_in_trial", TextOrNull(c.cause.only_recording)},
                     {"parameters", ParametersOfMember(best, member)},
                     {"probability", NumberOrNull(c.probability)},
                     {"probability_group", NumberOrNull(c.group_probability)},
                     {"probability_by_evidence", NumberOrNull(c.evidence_probability)},
                     {"seen", SeenRecord(c.features)},
                     {"varies", VariesRecord(d, c)},
                     {"share", NumberOrNull(c.share)},
                     {"main", c.main},
                     {"held_out_rmse_without", ByChannel(d.problem, c.rmse_without)},
                     {"held_out_gain",
                      {{"nats_per_sample", NumberOrNull(c.gain.nats_per_sample)},
                       {"ci95", IntervalRecord(c.gain.ci95)}}}});
    }
  }
  return out;
}

Json PosteriorRecord(const Diagnosis& d) {
  Json out = Json::array();
  for (const auto& [set, weight] : d.naming.posterior) {
    Json names = Json::array();
    for (const int i : set)
      names.push_back(d.naming.candidates[static_cast<std::size_t>(i)].candidate.Name());
    out.push_back({{"causes", names}, {"probability", NumberOrNull(weight)}});
  }
  return out;
}

}  // namespace hoplab
