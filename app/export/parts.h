#pragma once

#include <string_view>

namespace hoplab {

/// A part of an exported file, as it was when the program was built: "head.c", "shapes.c", ... of
/// app/export/c. Anything else is a bug.
std::string_view ExportPart(std::string_view name);

}  // namespace hoplab
