#pragma once

#include <vector>

#include "app/terminal/command.h"

namespace hoplab {

/// The commands of app/commands, in the order in which help lists them. Written by the build.
std::vector<const Command*> AllCommands();

}  // namespace hoplab
