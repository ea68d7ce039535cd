#include "app/commands/completion.h"

#include <ostream>

#include "app/completion.h"
#include "app/help_text.h"
#include "app/run_record.h"

namespace hoplab {
namespace {

struct CompletionSettings {
  std::string shell;
  bool json = false;
};

}  // namespace

void AddCompletionCommand(CLI::App& app, Invocation& invocation) {
  auto settings = std::make_shared<CompletionSettings>();
  CLI::App& sub =
      *app.add_subcommand("completion", "Print what makes a shell complete this command line");
  sub.add_option("SHELL", settings->shell, "bash, zsh or fish")
      ->required()
      ->check(OneOf({std::begin(kShells), std::end(kShells)}));
  sub.footer(
      "Commands, options, laws, effects, parameters, files. An installed hoplab has it.\n"
      "Examples:\n"
      "  hoplab completion bash > ~/.local/share/bash-completion/completions/hoplab\n"
      "  hoplab completion zsh > ~/.zfunc/_hoplab\n"
      "  hoplab completion fish > ~/.config/fish/completions/hoplab.fish");
  OnParsed(sub, invocation, settings, [&app](const CompletionSettings& s, Console& console) {
    const std::string script = CompletionScript(app, s.shell);
    if (!s.json) {
      console.out << script;
      return ExitCode::kDone;
    }
    RecordHeader header;
    header.command = "completion";
    Json record = NewRecord(header);
    record["shell"] = s.shell;
    record["script"] = script;
    console.out << TextOf(record);
    return ExitCode::kDone;
  });
}

}  // namespace hoplab
