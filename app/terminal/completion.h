#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace hoplab {

// Completion of the command line in a shell, written from the program's own tree of commands:
// commands, options, and the values that a placeholder stands for.

/// What may stand in the place of an argument.
struct ArgumentValues {
  enum class Kind { kAnything, kWords, kFiles, kFolders };
  Kind kind = Kind::kAnything;
  std::vector<std::string> words = {};  // of kWords; one that ends in '=' wants a value behind it
  bool is_list = false;                 // several, separated by commas
};
using ValuesOfOption = ArgumentValues (*)(const CLI::Option& option);

inline constexpr std::string_view kShells[] = {"bash", "zsh", "fish"};

/// The script that one of kShells reads.
std::string CompletionScript(const CLI::App& app, std::string_view shell, ValuesOfOption values_of);

}  // namespace hoplab
