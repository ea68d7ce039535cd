#include "app/records/diagnosis_parts.h"

#include "app/records/record_parts.h"

namespace hoplab {

Json HeldOutRecord(const FitProblem& problem, const HeldOutErrors& errors) {
  Json record = RoleRecord(problem, errors.trials, TrialRole::kTest);
  const FeatureErrors& f = errors.features;
  const auto computed = [&](double value) {
    return errors.trials.empty() ? Json(nullptr) : NumberOrNull(value);
  };
  record["apex_height_rmse_m"] = computed(f.apex_height_rmse);
  record["apex_time_rmse_s"] = computed(f.apex_time_rmse);
  record["touchdown_time_rmse_s"] = computed(f.touchdown_time_rmse);
  record["stance_time_rmse_s"] = computed(f.stance_time_rmse);
  return record;
}

Json ForceRecord(const ReconstructedForce& f) {
  Json points = Json::array(), terms = Json::array();
  for (const ForcePoint& p : f.points) {
    points.push_back({{"at", NumberOrNull(p.at)},
                      {"value", NumberOrNull(p.value)},
                      {"band95", NumberOrNull(p.band95)}});
  }
  for (const RegressionTerm& t : f.terms) {
    terms.push_back({{"term", t.term},
                     {"coefficient", NumberOrNull(t.coefficient)},
                     {"inclusion", NumberOrNull(t.inclusion)}});
  }
  return {{"name", f.group.name},
          {"against", TextOrNull(f.group.against)},
          {"unit", f.group.unit},
          {"score", NumberOrNull(f.score)},
          {"p_value", NumberOrNull(f.p_value)},
          {"points", points},
          {"terms", terms}};
}

Json ForcesRecord(const std::optional<FreeForces>& free_forces) {
  if (!free_forces) return nullptr;
  Json out = Json::array();
  for (const ReconstructedForce& f : free_forces->forces) out.push_back(ForceRecord(f));
  return out;
}

}  // namespace hoplab
