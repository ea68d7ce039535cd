#include "experiments/study/energy_causes.h"

#include "experiments/study/study_tables.h"

namespace hoplab {
namespace {

// The law with a massless leg: a toe's mass loses energy of its own at touch-down.
Study Massless(Study study) {
  study.constants.mechanism.toe_mass_kg.reset();
  study.constants.mechanism.placement.reset();
  return study;
}

void AddBlend(Scenario& scenario, const std::string& effect) {
  scenario.effects.push_back({effect, {{"blend", 1.0}}, {}});
}

}  // namespace

EnergyCauses EnergyCausesAt(const Study& study, double touchdown_angle_rad) {
  const auto percent = [&](const Study& s) { return EnergyPercent(s, touchdown_angle_rad, 0.0); };
  const Study thesis = Massless(WithLaw(study, Law::kThesis));
  Study rolling = thesis, tip = thesis, both = thesis, fine = thesis;
  AddBlend(rolling.constants, "rolling_law");
  AddBlend(tip.constants, "tip_rotation");
  AddBlend(both.constants, "rolling_law");
  AddBlend(both.constants, "tip_rotation");
  fine.integrator.relative_tolerance *= 1e-2;
  fine.integrator.absolute_tolerance *= 1e-2;

  EnergyCauses causes{};
  causes.study = percent(study);
  causes.thesis = percent(thesis);
  causes.with_rolling = percent(rolling);
  causes.with_tip = percent(tip);
  causes.with_both = percent(both);
  causes.consistent = percent(Massless(WithLaw(study, Law::kConsistent)));
  causes.removed_by_rolling =
      0.5 * ((causes.thesis - causes.with_rolling) + (causes.with_tip - causes.with_both));
  causes.removed_by_tip =
      0.5 * ((causes.thesis - causes.with_tip) + (causes.with_rolling - causes.with_both));
  causes.integration_error = percent(fine) - causes.thesis;
  return causes;
}

}  // namespace hoplab
