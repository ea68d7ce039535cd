#pragma once

#include "app/command.h"

namespace hoplab {

/// `hoplab diagnose DATASET`.
void AddDiagnoseCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
