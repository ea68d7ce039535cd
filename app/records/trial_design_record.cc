#include "app/records/trial_design_record.h"

namespace hoplab {
namespace {

Json SettingsRecord(const TrialDesign& design) {
  return {{"like", design.like},
          {"touchdown_angle_rad", NumberOrNull(design.touchdown_angle)},
          {"height_m", NumberOrNull(design.height)},
          {"speed_m_per_s", NumberOrNull(design.speed)},
          {"kp_N_s", NumberOrNull(design.kp)}};
}

}  // namespace

Json SearchRecord(const Diagnosis& d) {
  if (!d.experiment) return nullptr;
  const SeparatingExperiment& e = *d.experiment;
  return {{"description", Describe(e.design)},
          {"settings", SettingsRecord(e.design)},
          {"expected_nats", NumberOrNull(e.expected_nats)},
          {"closest_rival", e.closest_rival},
          {"designs_tried", e.designs_tried},
          {"separates", e.Separates()}};
}

Json ExperimentRecord(const Diagnosis& d) {
  if (!d.experiment || !d.experiment->Separates()) return nullptr;
  return {{"description", Describe(d.experiment->design)},
          {"settings", SettingsRecord(d.experiment->design)},
          {"expected_nats", NumberOrNull(d.experiment->expected_nats)},
          {"closest_rival", d.experiment->closest_rival}};
}

}  // namespace hoplab
