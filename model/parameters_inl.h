#pragma once

#include "model/jet.h"
#include "model/parameters.h"

namespace hoplab {

template <class To, class From>
Parameters<To> ConvertParameters(const Parameters<From>& from) {
  Parameters<To> to;
  for (const ParameterInfo& info : AllParameters()) {
    Field(to, info.id) = To(Value(Field(from, info.id)));
  }
  to.slope = To(Value(from.slope));
  to.inertia_x = To(Value(from.inertia_x));
  to.inertia_y = To(Value(from.inertia_y));
  to.torque_lag = To(Value(from.torque_lag));
  to.rest_length_step = To(Value(from.rest_length_step));
  to.has_rest_length_step = from.has_rest_length_step;
  to.torque_limit = from.torque_limit;
  to.fall_height = from.fall_height;
  return to;
}

}  // namespace hoplab
