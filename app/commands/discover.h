#pragma once

#include "app/command.h"

namespace hoplab {

/// `hoplab discover DATASET`: a formula for what no listed cause explains.
void AddDiscoverCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
