#pragma once

#include <string>

#include "app/export/exported_model.h"

namespace hoplab {

struct MjcfOptions {
  int arcs = 24;          // rigid arcs the leg is cut into
  double step = 5e-5;     // of MuJoCo's integrator [s]
  double leg_mass = 0.0;  // where the fit has none [kg]; 0: a thousandth of the body's
};

/// Half-circular leg and rig as an MJCF model (docs/export.md): the body on slide joints, the leg a
/// chain of rigid arcs on hinges of stiffness E I/s, s the length of an arc, damping tau E I/s, on
/// a frictional floor; a key for each recorded start. Throws InputError (place `place`) for a leg
/// that is no beam, and for effects that change the leg beyond what the beam knows.
std::string MjcfOf(const ExportedModel& given, const MjcfOptions& options,
                   const std::string& place);

}  // namespace hoplab
