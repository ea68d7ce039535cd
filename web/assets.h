#pragma once

#include <string_view>

namespace hoplab {

/// A file that reports are made of, as it was when the program was built: "page.html",
/// "report.css", "report.js" (every script of this folder, one after the other), "plotly.js",
/// "plotly-3d.js", "plotly-license.txt", "hoplab-license.txt". Anything else is a bug.
std::string_view WebAsset(std::string_view name);

}  // namespace hoplab
