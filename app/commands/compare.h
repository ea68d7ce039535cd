#pragma once

#include "app/command.h"

namespace hoplab {

/// `hoplab compare DATASET`: the same dataset fitted with every law, and with effects.
void AddCompareCommand(CLI::App& app, Invocation& invocation);

}  // namespace hoplab
