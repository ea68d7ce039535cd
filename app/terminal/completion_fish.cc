#include <fmt/format.h>

#include "app/terminal/completion_parts.h"
#include "base/text.h"

namespace hoplab {
namespace {

using Kind = ArgumentValues::Kind;

std::string FishWords(const ArgumentValues& values) {
  const std::string words = Escaped(Join(values.words, " "), "\\'");
  // Of a list the last word is completed.
  if (values.is_list) return fmt::format(" -xa '(__hoplab_list {})'", words);
  return fmt::format(" -xa '{}'", words);
}

std::string FishValues(const ArgumentValues& values) {
  switch (values.kind) {
    case Kind::kAnything:
      return " -x";
    case Kind::kFiles:
      return " -rF";
    case Kind::kFolders:
      return " -xa '(__fish_complete_directories)'";
    case Kind::kWords:
      return FishWords(values);
  }
  return "";
}

std::string FishDescription(const std::string& text) {
  return " -d '" + Escaped(text, "\\'") + "'";
}

std::string FishLines(const CLI::App& sub, ValuesOfOption values_of) {
  const std::string begin =
      "complete -c hoplab -n '__fish_seen_subcommand_from " + sub.get_name() + "'";
  std::string text;
  for (const CLI::Option* option : OptionsOf(sub)) {
    text += begin + " -l " + option->get_lnames().front() +
            (TakesValue(*option) ? FishValues(values_of(*option)) : " -f") +
            FishDescription(option->get_description()) + "\n";
  }
  for (const CLI::Option* positional : PositionalsOf(sub)) {
    const ArgumentValues values = values_of(*positional);
    if (values.kind == Kind::kAnything) continue;
    text += begin + (values.kind == Kind::kFiles ? " -F" : FishValues(values)) + "\n";
  }
  return text;
}

}  // namespace

std::string FishScript(const CLI::App& app, ValuesOfOption values_of) {
  std::string text =
      "# Completion of hoplab in fish, written by `hoplab completion fish`.\n"
      "function __hoplab_list\n  set -l begun (string match -r '.*,' -- (commandline -ct))\n"
      "  for word in $argv\n    echo \"$begun$word\"\n  end\nend\n"
      "complete -c hoplab -f\n";
  for (const CLI::App* sub : CommandsOf(app)) {
    text += "complete -c hoplab -n __fish_use_subcommand -a " + sub->get_name() +
            FishDescription(sub->get_description()) + "\n";
  }
  for (const CLI::App* sub : CommandsOf(app)) text += FishLines(*sub, values_of);
  return text;
}

}  // namespace hoplab
