#pragma once

#include "app/terminal/completion.h"

namespace hoplab {

/// What may stand in the place of an option's value, by its placeholder.
ArgumentValues ValuesOf(const CLI::Option& option);

}  // namespace hoplab
