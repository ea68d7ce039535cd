#pragma once

#include <string>

#include "datasets/import/import.h"

namespace hoplab {

/// What was taken for what, and the options that say the same.
std::string GuessesText(const ImportResult& made);

/// The dataset that was made in the folder `out`: its columns and trials, and what is to be filled
/// in.
std::string ImportReport(const std::string& name, const std::string& out, const ImportResult& made,
                         bool colours);

}  // namespace hoplab
