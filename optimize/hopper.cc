#include "optimize/hopper.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace hoplab {
namespace {

// Parameters that may well be 0, in their units: torque per speed, speed, rad, N s/m.
double UsualSize(ParameterId id) {
  switch (id) {
    case ParameterId::kThetaTd:
      return 0.1;
    case ParameterId::kKp:
    case ParameterId::kVDes:
    case ParameterId::kD:
      return 1.0;
    default:
      return 0.1;
  }
}

}  // namespace

SimulationRequest RequestOf(const Hopper& hopper) {
  SimulationRequest request = hopper.request;
  request.effects = hopper.effects;
  request.directions = {};
  request.row_times = {};
  request.channels = {};
  return request;
}

double ValueOf(const Hopper& hopper, const SensitivityDirection& direction) {
  switch (direction.of) {
    case SensitivityDirection::Of::kParameter:
      return Field(hopper.request.parameters, direction.parameter);
    case SensitivityDirection::Of::kInitialState:
      return hopper.request.initial[direction.index];
    case SensitivityDirection::Of::kEffect:
      return hopper.effects[direction.index].values[direction.component];
    default:
      break;  // no log drives a gait
  }
  HOPLAB_CHECK(false);
}

void SetValue(Hopper& hopper, const SensitivityDirection& direction, double value) {
  switch (direction.of) {
    case SensitivityDirection::Of::kParameter:
      Field(hopper.request.parameters, direction.parameter) = value;
      return;
    case SensitivityDirection::Of::kInitialState:
      hopper.request.initial[direction.index] = value;
      return;
    case SensitivityDirection::Of::kEffect:
      hopper.effects[direction.index].values[direction.component] = value;
      return;
    default:
      HOPLAB_CHECK(false);
  }
}

double ScaleOf(const Hopper& hopper, const SensitivityDirection& direction) {
  const double size = std::abs(ValueOf(hopper, direction));
  switch (direction.of) {
    case SensitivityDirection::Of::kParameter:
      return size > 0.0 ? size : UsualSize(direction.parameter);
    case SensitivityDirection::Of::kInitialState:
      return std::max(size, 0.1);
    case SensitivityDirection::Of::kEffect: {
      const EffectInfo& info = hopper.effects[direction.index].effect->info;
      return std::max(size, std::abs(info.parameters[direction.component].typical));
    }
    default:
      break;
  }
  HOPLAB_CHECK(false);
}

}  // namespace hoplab
