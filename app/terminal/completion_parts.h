#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/terminal/completion.h"

namespace hoplab {

// What the scripts of the shells are written with.

using Words = std::vector<std::string>;

/// Options of a command that help shows, its positionals left out.
std::vector<const CLI::Option*> OptionsOf(const CLI::App& sub);

std::vector<const CLI::Option*> PositionalsOf(const CLI::App& sub);
std::vector<const CLI::App*> CommandsOf(const CLI::App& app);
std::string LongName(const CLI::Option& option);
bool TakesValue(const CLI::Option& option);
Words LongNames(const std::vector<const CLI::Option*>& options);
/// `text` with a backslash before each of `special`.
std::string Escaped(const std::string& text, std::string_view special);

/// In single quotes of a POSIX shell.
std::string Quoted(const std::string& text);

/// The scripts; `values_of` says what may stand in the place of an option's value.
std::string BashScript(const CLI::App& app, ValuesOfOption values_of);
std::string ZshScript(const CLI::App& app, ValuesOfOption values_of);
std::string FishScript(const CLI::App& app, ValuesOfOption values_of);

}  // namespace hoplab
