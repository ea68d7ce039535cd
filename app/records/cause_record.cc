#include "app/records/cause_record.h"

#include <cmath>

namespace hoplab {
namespace {

Json SizesOfCause(const Candidate& c, const Eigen::VectorXd& values) {
  Json out = Json::array();
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

Json GainRecord(const HeldOutGain& gain) {
  return {{"nats_per_sample", NumberOrNull(gain.nats_per_sample)},
          {"ci95", IntervalRecord(gain.ci95)}};
}

// What a size in each trial is worth; null without a refit.
Json SizesWorth(const Diagnosis& d, const SizesReport& sizes) {
  return {{"evidence_nats", NumberOrNull(sizes.gain)},
          {"pays", sizes.pays},
          {"matters", sizes.matters},
          {"explained", NumberOrNull(sizes.explained)},
          {"explained_one_size", NumberOrNull(d.extension->explained)},
          {"held_out_rmse", ByChannel(d.problem, sizes.held_out_rmse)},
          {"held_out_rmse_one_size", ByChannel(d.problem, d.extension->after.test.rmse)},
          {"held_out_gain", GainRecord(sizes.held_out_gain)}};
}

// Of one parameter: of the refit if there is one, else to first order.
Json VariesOf(const EffectParameter& p, const Heterogeneity& h, const VaryingValue* refitted,
              const std::vector<TrialProblem>& train) {
  const std::vector<double>& sizes = refitted ? refitted->sizes : h.sizes;
  const std::vector<double>& errors = refitted ? refitted->std_errors : h.std_errors;
  Json trials = Json::array();
  for (std::size_t i = 0; i < sizes.size(); ++i)
    trials.push_back({{"trial", train[i].file},
                      {"value", NumberOrNull(sizes[i])},
                      {"std_error", NumberOrNull(errors[i])}});
  return {{"name", p.name},
          {"unit", p.unit},
          {"refitted", refitted != nullptr},
          {"mean", NumberOrNull(refitted ? refitted->mean : h.mean)},
          {"ci95", refitted ? IntervalRecord(refitted->ci95) : Json(nullptr)},
          {"spread", NumberOrNull(refitted ? refitted->spread : h.spread)},
          {"p_value", NumberOrNull(h.p_value)},
          {"gain_nats", NumberOrNull(h.gain)},
          {"trials", trials}};
}

// Sizes trial by trial where trials do not agree on one; null where they do.
Json VariesRecord(const Diagnosis& d, const CauseReport& c) {
  if (!c.Varies() && !c.cause.each_trial) return nullptr;
  const ExtensionReport& e = *d.extension;
  const std::vector<TrialProblem> train = TrialsOf(d.problem, TrialRole::kTrain);
  Json out = Json::array();
  for (std::size_t k = 0; k < c.sizes.size(); ++k) {
    const VaryingValue* refitted =
        k < c.refitted.size() && c.refitted[k] ? &*c.refitted[k] : nullptr;
    Json one = VariesOf(c.cause.Parameter(static_cast<int>(k)), c.sizes[k], refitted, train);
    one["told"] = (c.main || e.MainCauses().empty()) && e.TellsSizesOf(c, k);
    one["in_the_model"] = c.cause.each_trial;
    one["with_sizes"] = refitted && !c.cause.each_trial ? SizesWorth(d, *e.sizes) : Json(nullptr);
    out.push_back(one);
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
           {"only_in_trial", OneTrial(c)},
           {"only_in_trials", c.only_recordings},
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
      const auto member = static_cast<int>(d.naming.MemberOf(c.candidate));
      out.push_back({{"name", c.cause.effect->info.name},
                     {"only_in_trial", OneTrial(c.cause)},
                     {"only_in_trials", c.cause.only_recordings},
                     {"each_trial", c.cause.each_trial},
                     {"parameters", SizesOfCause(c.cause, best.ValuesOf(member))},
                     {"probability", NumberOrNull(c.probability)},
                     {"probability_group", NumberOrNull(c.group_probability)},
                     {"probability_by_evidence", NumberOrNull(c.evidence_probability)},
                     {"seen", SeenRecord(c.features)},
                     {"varies", VariesRecord(d, c)},
                     {"share", NumberOrNull(c.share)},
                     {"share_of_misfit", NumberOrNull(d.extension->OfMisfit(c.share))},
                     {"main", c.main},
                     {"stands_in", c.stands_in},
                     {"held_out_rmse_without", ByChannel(d.problem, c.rmse_without)},
                     {"held_out_gain", GainRecord(c.gain)}});
    }
  }
  return out;
}

Json SetAsideRecord(const Diagnosis& d) {
  Json out = Json::array();
  for (const SetAside& s : d.set_aside)
    out.push_back({{"name", s.cause.effect->info.name},
                   {"only_in_trial", OneTrial(s.cause)},
                   {"only_in_trials", s.cause.only_recordings},
                   {"parameters", SizesOfCause(s.cause, s.values)},
                   {"probability", NumberOrNull(s.probability)},
                   {"probability_group", NumberOrNull(s.group_probability)},
                   {"share", NumberOrNull(s.share)},
                   {"share_of_misfit", NumberOrNull(s.of_misfit)},
                   {"parameters_by_whole_trials",
                    s.by_whole_trials ? SizesOfCause(s.cause, *s.by_whole_trials) : Json()}});
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
