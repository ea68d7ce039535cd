#include "app/completion.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/effect_words.h"
#include "app/explain.h"
#include "app/help_text.h"
#include "base/check.h"
#include "base/text.h"
#include "experiments/study/reproduction.h"
#include "model/effects/effect.h"

namespace hoplab {
namespace {

using Kind = ArgumentValues::Kind;
using Words = std::vector<std::string>;

Words EffectWords() {
  Words words;
  for (const Effect* effect : AllEffects()) words.emplace_back(effect->info.name);
  return words;
}

Words EffectAssignments() {
  Words words;
  for (const Effect* effect : AllEffects()) {
    for (const EffectParameter& p : effect->info.parameters)
      words.push_back(fmt::format("{}:{}=", effect->info.name, p.name));
  }
  return words;
}

Words LawWords() {
  Words words;
  for (const Law law : AllLaws()) words.emplace_back(NameOf(law));
  return words;
}

Words ParameterWords(const std::string& end) {
  Words words;
  for (const ParameterInfo& info : AllParameters()) words.push_back(std::string(info.name) + end);
  return words;
}

Words StudyWords() {
  Words words = StudyGroupNames();
  const Words items = StudyItemNames();
  words.insert(words.end(), items.begin(), items.end());
  return words;
}

// Options of a command that help shows, its positionals left out.
std::vector<const CLI::Option*> OptionsOf(const CLI::App& sub) {
  return sub.get_options(
      [](const CLI::Option* o) { return o->nonpositional() && !o->get_group().empty(); });
}

std::vector<const CLI::Option*> PositionalsOf(const CLI::App& sub) {
  return sub.get_options([](const CLI::Option* o) { return o->get_positional(); });
}

std::vector<const CLI::App*> CommandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* sub) { return !sub->get_group().empty(); });
}

std::string LongName(const CLI::Option& option) { return "--" + option.get_lnames().front(); }
bool TakesValue(const CLI::Option& option) { return option.get_expected_max() > 0; }

Words LongNames(const std::vector<const CLI::Option*>& options) {
  Words names;
  for (const CLI::Option* option : options) names.push_back(LongName(*option));
  return names;
}

// `text` with a backslash before each of `special`.
std::string Escaped(const std::string& text, std::string_view special) {
  std::string out;
  for (const char c : text) {
    if (special.find(c) != special.npos) out += '\\';
    out += c;
  }
  return out;
}

// In single quotes of a POSIX shell.
std::string Quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// ---- bash

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

std::string BashCase(const CLI::App& sub) {
  std::string text = "    " + sub.get_name() +
                     ")\n      options=" + Quoted(Join(LongNames(OptionsOf(sub)), " ")) + "\n";
  for (const CLI::Option* positional : PositionalsOf(sub))
    text += "      " + BashSettings(ValuesOf(*positional)) + "\n";
  text += "      case $before in\n";
  for (const CLI::Option* option : OptionsOf(sub)) {
    if (!TakesValue(*option)) continue;
    text += fmt::format("        {}) {} ;;\n", LongName(*option), BashSettings(ValuesOf(*option)));
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

std::string BashScript(const CLI::App& app) {
  Words commands;
  std::string cases;
  for (const CLI::App* sub : CommandsOf(app)) {
    commands.push_back(sub->get_name());
    cases += BashCase(*sub);
  }
  const Words options = LongNames(OptionsOf(app));
  commands.insert(commands.end(), options.begin(), options.end());
  std::string head(kBashHead);
  const std::string_view mark = "@COMMANDS@";
  head.replace(head.find(mark), mark.size(), Quoted(Join(commands, " ")));
  return head + cases + std::string(kBashTail);
}

// ---- zsh

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

std::string ZshCase(const CLI::App& sub) {
  std::string text = "    " + sub.get_name() + ")\n      _arguments";
  for (const CLI::Option* option : OptionsOf(sub)) {
    std::string line = LongName(*option) + "[" + Escaped(option->get_description(), ":[]") + "]";
    if (TakesValue(*option)) line += ZshAction(ValuesOf(*option), option->get_option_text());
    text += " \\\n        " + Quoted(line);
  }
  int place = 0;
  for (const CLI::Option* positional : PositionalsOf(sub)) {
    const bool repeated = positional->get_expected_max() > 1;
    text += " \\\n        " +
            Quoted((repeated ? "*" : std::to_string(++place)) +
                   ZshAction(ValuesOf(*positional), positional->get_name(true, false)));
  }
  return text + " ;;\n";
}

std::string ZshScript(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* sub : CommandsOf(app)) {
    commands +=
        "      " + Quoted(sub->get_name() + ":" + Escaped(sub->get_description(), ":")) + "\n";
    cases += ZshCase(*sub);
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

// ---- fish

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

std::string FishLines(const CLI::App& sub) {
  const std::string begin =
      "complete -c hoplab -n '__fish_seen_subcommand_from " + sub.get_name() + "'";
  std::string text;
  for (const CLI::Option* option : OptionsOf(sub)) {
    text += begin + " -l " + option->get_lnames().front() +
            (TakesValue(*option) ? FishValues(ValuesOf(*option)) : " -f") +
            FishDescription(option->get_description()) + "\n";
  }
  for (const CLI::Option* positional : PositionalsOf(sub)) {
    const ArgumentValues values = ValuesOf(*positional);
    if (values.kind == Kind::kAnything) continue;
    text += begin + (values.kind == Kind::kFiles ? " -F" : FishValues(values)) + "\n";
  }
  return text;
}

std::string FishScript(const CLI::App& app) {
  std::string text =
      "# Completion of hoplab in fish, written by `hoplab completion fish`.\n"
      "function __hoplab_list\n  set -l begun (string match -r '.*,' -- (commandline -ct))\n"
      "  for word in $argv\n    echo \"$begun$word\"\n  end\nend\n"
      "complete -c hoplab -f\n";
  for (const CLI::App* sub : CommandsOf(app)) {
    text += "complete -c hoplab -n __fish_use_subcommand -a " + sub->get_name() +
            FishDescription(sub->get_description()) + "\n";
  }
  for (const CLI::App* sub : CommandsOf(app)) text += FishLines(*sub);
  return text;
}

}  // namespace

ArgumentValues ValuesOf(const CLI::Option& option) {
  if (Words choices = ChoicesOf(option); !choices.empty())
    return {Kind::kWords, std::move(choices)};
  // What a placeholder stands for is the same in every command.
  const std::string& text = option.get_option_text();
  const std::string placeholder = text.empty() ? option.get_name(true, false) : text;
  if (placeholder == "LAW" || placeholder == "LAW+EFFECT...") return {Kind::kWords, LawWords()};
  if (placeholder == "EFFECT") return {Kind::kWords, EffectWords()};
  if (placeholder == "EFFECT,...") return {Kind::kWords, EffectWords(), true};
  if (placeholder == "EFFECT:PARAMETER=VALUE") return {Kind::kWords, EffectAssignments()};
  if (placeholder == "NAME,...") return {Kind::kWords, ParameterWords(""), true};
  if (placeholder == "NAME=VALUE") return {Kind::kWords, ParameterWords("=")};
  if (placeholder == "ITEM") return {Kind::kWords, StudyWords()};
  if (placeholder == "WORD") return {Kind::kWords, ExplainedWords()};
  if (placeholder == "SCENARIO" || placeholder == "FILE") return {Kind::kFiles};
  if (placeholder == "DATASET" || placeholder == "DIR" || placeholder == "RUN_DIR")
    return {Kind::kFolders};
  return {};
}

std::string CompletionScript(const CLI::App& app, std::string_view shell) {
  if (shell == "bash") return BashScript(app);
  if (shell == "zsh") return ZshScript(app);
  HOPLAB_CHECK(shell == "fish");
  return FishScript(app);
}

}  // namespace hoplab
