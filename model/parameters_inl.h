#pragma once

#include "model/jet.h"
#include "model/parameters.h"

namespace hoplab {

template <class To, class From>
Parameters<To> ConvertParameters(const Parameters<From>& from) {
  Parameters<To> to;
  for (const ParameterInfo& info : AllParameters()) {
    if (info.id >= ParameterId::kPitchInertia) break;  // a robot's own, below
    Field(to, info.id) = To(Value(Field(from, info.id)));
  }
  if (from.robot) to.robot = ConvertRobot<To>(*from.robot);
  to.slope = To(Value(from.slope));
  to.inertia_x = To(Value(from.inertia_x));
  to.inertia_y = To(Value(from.inertia_y));
  to.torque_lag = To(Value(from.torque_lag));
  to.contact_time = To(Value(from.contact_time));
  to.rest_length_step = To(Value(from.rest_length_step));
  to.has_rest_length_step = from.has_rest_length_step;
  const LawTerms<From>& terms = from.law_terms;
  to.law_terms.active = terms.active;
  to.law_terms.rolling_active = terms.rolling_active;
  to.law_terms.torque_active = terms.torque_active;
  to.law_terms.second_order_active = terms.second_order_active;
  to.law_terms.slopes_active = terms.slopes_active;
  to.law_terms.leg_mass_active = terms.leg_mass_active;
  to.law_terms.foot_friction_active = terms.foot_friction_active;
  to.law_terms.higher_order_active = terms.higher_order_active;
  to.law_terms.material_damping_active = terms.material_damping_active;
  to.law_terms.sole_active = terms.sole_active;
  to.law_terms.uneven_active = terms.uneven_active;
  to.law_terms.uneven = To(Value(terms.uneven));
  to.law_terms.sole = To(Value(terms.sole));
  to.law_terms.material_damping = To(Value(terms.material_damping));
  to.law_terms.leg_mass = To(Value(terms.leg_mass));
  to.law_terms.foot_friction = To(Value(terms.foot_friction));
  to.law_terms.higher_order = To(Value(terms.higher_order));
  to.law_terms.hardening = To(Value(terms.hardening));
  to.law_terms.rolling = To(Value(terms.rolling));
  to.law_terms.tip = To(Value(terms.tip));
  to.law_terms.torque_bending = To(Value(terms.torque_bending));
  to.law_terms.second_order = To(Value(terms.second_order));
  to.law_terms.stiffness_drift = To(Value(terms.stiffness_drift));
  to.law_terms.ground_compliance = To(Value(terms.ground_compliance));
  to.law_terms.foot_slip = To(Value(terms.foot_slip));
  for (int k = 0; k < kInputFamilies; ++k) {
    to.input_delay[k] = To(Value(from.input_delay[k]));
    to.input_scale[k] = To(Value(from.input_scale[k]));
  }
  to.on_guide = from.on_guide;
  to.reading = from.reading;
  to.air_density = from.air_density;
  to.time_origin = from.time_origin;
  to.torque_limit = from.torque_limit;
  to.fall_height = from.fall_height;
  to.start_angle = from.start_angle;
  return to;
}

}  // namespace hoplab
