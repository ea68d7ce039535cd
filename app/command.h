#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "app/console.h"
#include "app/exit_code.h"

namespace hoplab {

/// What the command line asked for: filled while it is parsed, run afterwards.
struct Invocation {
  std::string command;
  bool json = false;  // run.json on standard output, and nothing else there
  std::function<ExitCode(Console&)> run;
};

/// Adds the options every subcommand has (its settings live in `Settings`, with a `json` among
/// them;
/// `--quiet` is taken by those without progress, too), and lets `invocation` run `body` with them.
template <class Settings, class Body>
void OnParsed(CLI::App& sub, Invocation& invocation, std::shared_ptr<Settings> settings,
              Body body) {
  if (sub.get_option_no_throw("--quiet") == nullptr)
    sub.add_flag("--quiet")->description("No progress on standard error");
  sub.add_flag("--json", settings->json, "Print run.json on standard output, nothing else");
  sub.callback([name = sub.get_name(), &invocation, settings, body] {
    invocation.command = name;
    invocation.json = settings->json;
    invocation.run = [settings, body](Console& console) { return body(*settings, console); };
  });
}

}  // namespace hoplab
