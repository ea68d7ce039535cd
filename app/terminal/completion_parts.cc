#include "app/terminal/completion_parts.h"

namespace hoplab {

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

}  // namespace hoplab
