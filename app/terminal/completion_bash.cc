#include <fmt/format.h>

#include "app/terminal/completion_parts.h"
#include "base/text.h"

namespace hoplab {
namespace {

using Kind = ArgumentValues::Kind;

std::string BashSettings(const ArgumentValues& values) {
  switch (values.kind) {
    case Kind::kAnything:
      return "kind=anything";
    case Kind::kFiles:
      return "kind=files";
    case Kind::kFolders:
      return "kind=folders";
    case Kind::kWords:
      return (values.is_list ? "kind=list words=" : "kind=words words=") +
             Quoted(Join(values.words, " "));
  }
  return "";
}

std::string BashCase(const CLI::App& sub, ValuesOfOption values_of) {
  std::string text = "    " + sub.get_name() +
                     ")\n      options=" + Quoted(Join(LongNames(OptionsOf(sub)), " ")) + "\n";
  for (const CLI::Option* positional : PositionalsOf(sub))
    text += "      " + BashSettings(values_of(*positional)) + "\n";
  text += "      case $before in\n";
  for (const CLI::Option* option : OptionsOf(sub)) {
    if (!TakesValue(*option)) continue;
    text += fmt::format("        {}) {} ;;\n", LongName(*option), BashSettings(values_of(*option)));
  }
  return text +
         "        *) [[ $current == -* ]] && kind=words words=$options ;;\n"
         "      esac ;;\n";
}

constexpr std::string_view kBashHead =
    R"(# Completion of hoplab in bash, written by `hoplab completion bash`.
_hoplab() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
  # bash cuts --law=thesis into three words.
  if [[ $current == '=' ]]; then
    current=
  elif [[ $before == '=' ]] && ((COMP_CWORD > 2)); then
    before=${COMP_WORDS[COMP_CWORD-2]}
  fi
  local kind=anything words= options= prefix= IFS=$'\n'
  if ((COMP_CWORD == 1)); then
    kind=words words=@COMMANDS@
  else
  case ${COMP_WORDS[1]} in
)";
constexpr std::string_view kBashTail = R"(  esac
  fi
  if [[ $kind == list ]]; then
    # Of a list the last word is completed.
    [[ $current == *,* ]] && prefix=${current%,*},
    current=${current##*,}
  fi
  case $kind in
    words | list)
      COMPREPLY=($(compgen -P "$prefix" -W "${words// /$'\n'}" -- "$current"))
      [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *= ]] && compopt -o nospace 2>/dev/null ;;
    files) COMPREPLY=($(compgen -f -- "$current")); compopt -o filenames 2>/dev/null ;;
    folders) COMPREPLY=($(compgen -d -- "$current")); compopt -o filenames 2>/dev/null ;;
    *) COMPREPLY=() ;;
  esac
  return 0
}
complete -F _hoplab hoplab
)";

}  // namespace

std::string BashScript(const CLI::App& app, ValuesOfOption values_of) {
  Words commands;
  std::string cases;
  for (const CLI::App* sub : CommandsOf(app)) {
    commands.push_back(sub->get_name());
    cases += BashCase(*sub, values_of);
  }
  const Words options = LongNames(OptionsOf(app));
  commands.insert(commands.end(), options.begin(), options.end());
  std::string head(kBashHead);
  const std::string_view mark = "@COMMANDS@";
  head.replace(head.find(mark), mark.size(), Quoted(Join(commands, " ")));
  return head + cases + std::string(kBashTail);
}

}  // namespace hoplab
