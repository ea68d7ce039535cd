#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

#include "app/terminal/console.h"
#include "app/terminal/exit_code.h"

namespace hoplab {

/// What the command line asked for: filled while it is parsed, run afterwards.
struct Invocation {
  std::string command;
  bool json = false;   // run.json on standard output, and nothing else there
  bool plain = false;  // no escape sequence anywhere
  std::function<ExitCode(Console&)> run;
};

/// A command of the program: a constant in `commands`, named as its file in app/commands. Nothing
/// else lists it.
struct Command {
  int place;           // in `hoplab --help`, the smallest first
  const char* name;    // as it is typed
  const char* what;    // what it does, in a line
  const char* footer;  // examples, below the options in its help
  /// Adds options to `sub` and calls OnParsed.
  void (*add)(CLI::App& sub, Invocation& invocation);
};

/// Adds the options every subcommand has, `--quiet` and `--plain` to those without progress, too,
/// and lets `invocation` run `body` with its settings, `json` and perhaps `quiet` among them.
template <class Settings, class Body>
void OnParsed(CLI::App& sub, Invocation& invocation, std::shared_ptr<Settings> settings,
              Body body) {
  const char* const kQuiet = "No progress on standard error";
  if constexpr (requires { settings->quiet; })
    sub.add_flag("--quiet", settings->quiet, kQuiet);
  else
    sub.add_flag("--quiet")->description(kQuiet);
  sub.add_flag("--plain", invocation.plain, "No colours, no line that is written over");
  sub.add_flag("--json", settings->json, "Print run.json on standard output, nothing else");
  sub.callback([name = sub.get_name(), &invocation, settings, body] {
    invocation.command = name;
    invocation.json = settings->json;
    invocation.run = [settings, body](Console& console) { return body(*settings, console); };
  });
}

}  // namespace hoplab
