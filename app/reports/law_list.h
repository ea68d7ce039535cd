#pragma once

#include <string>

namespace hoplab {

/// Laws and parameters of each mechanism, for a terminal.
std::string LawListText(bool colours);

}  // namespace hoplab
