#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace hoplab {

/// The manual page hoplab(1) in man(7) macros, from the program's own tree of commands.
std::string ManPage(const CLI::App& app);

}  // namespace hoplab
