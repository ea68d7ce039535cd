#pragma once

#include "app/command.h"

namespace hoplab {

/// Adds `hoplab design`.
void AddDesignCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
