#pragma once

#include <string>

#include "app/export/exported_model.h"

namespace hoplab {

/// The law with its values as one C99 file that needs the C library alone: the force on the hip,
/// the contact, the torque, and when stance and flight begin (docs/export.md). Sections 3 and 4 of
/// the equation sheet, written out. Effects on the body or the sensors are told in its head, not in
/// it. Throws InputError (place `place`) for an effect that changes the law in a way the file does
/// not know.
std::string CSourceOf(const ExportedModel& model, const std::string& place);

}  // namespace hoplab
