#include "app/terminal/completion_parts.h"
#include "base/text.h"

namespace hoplab {
namespace {

using Kind = ArgumentValues::Kind;

std::string ZshAction(const ArgumentValues& values, const std::string& placeholder) {
  const std::string message = Escaped(placeholder, ":[]");
  switch (values.kind) {
    case Kind::kAnything:
      return ":" + message + ": ";
    case Kind::kFiles:
      return ":" + message + ":_files";
    case Kind::kFolders:
      return ":" + message + ":_files -/";
    case Kind::kWords: {
      const std::string words = Escaped(Join(values.words, " "), ":");
      return values.is_list ? ":" + message + ":_values -s , word " + words
                            : ":" + message + ":(" + words + ")";
    }
  }
  return "";
}

std::string ZshCase(const CLI::App& sub, ValuesOfOption values_of) {
  std::string text = "    " + sub.get_name() + ")\n      _arguments";
  for (const CLI::Option* option : OptionsOf(sub)) {
    std::string line = LongName(*option) + "[" + Escaped(option->get_description(), ":[]") + "]";
    if (TakesValue(*option)) line += ZshAction(values_of(*option), option->get_option_text());
    text += " \\\n        " + Quoted(line);
  }
  int place = 0;
  for (const CLI::Option* positional : PositionalsOf(sub)) {
    const bool repeated = positional->get_expected_max() > 1;
    text += " \\\n        " +
            Quoted((repeated ? "*" : std::to_string(++place)) +
                   ZshAction(values_of(*positional), positional->get_name(true, false)));
  }
  return text + " ;;\n";
}

}  // namespace

std::string ZshScript(const CLI::App& app, ValuesOfOption values_of) {
  std::string commands, cases;
  for (const CLI::App* sub : CommandsOf(app)) {
    commands +=
        "      " + Quoted(sub->get_name() + ":" + Escaped(sub->get_description(), ":")) + "\n";
    cases += ZshCase(*sub, values_of);
  }
  return "#compdef hoplab\n# Completion of hoplab in zsh, written by `hoplab completion zsh`.\n"
         "_hoplab() {\n  if ((CURRENT == 2)); then\n    local -a commands=(\n" +
         commands +
         "    )\n    _describe command commands\n    return\n  fi\n  shift words\n"
         "  ((CURRENT--))\n  case $words[1] in\n" +
         cases +
         "  esac\n}\n"
         // As a file of the function path it is the function, sourced it is to be registered.
         "if [[ $funcstack[1] == _hoplab ]]; then\n  _hoplab \"$@\"\nelse\n"
         "  compdef _hoplab hoplab\nfi\n";
}

}  // namespace hoplab
