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
  to.torque_limit = from.torque_limit;
  to.fall_height = from.fall_height;
  return to;
}

}  // namespace hoplab
