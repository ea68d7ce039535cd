#include "app/terminal/completion.h"

#include <ostream>

#include "app/records/run_record.h"
#include "app/reports/argument_values.h"
#include "app/terminal/command.h"
#include "app/terminal/help_text.h"

namespace hoplab {
namespace {

struct CompletionSettings {
  std::string shell;
  bool json = false;
};

void AddCompletion(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<CompletionSettings>();
  sub.add_option("SHELL", settings->shell, "bash, zsh or fish")
      ->required()
      ->check(OneOf({std::begin(kShells), std::end(kShells)}));
  OnParsed(sub, invocation, settings,
           [&app = *sub.get_parent()](const CompletionSettings& s, Console& console) {
             const std::string script = CompletionScript(app, s.shell, ValuesOf);
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

}  // namespace

namespace commands {
extern constexpr Command completion = {
    .place = 200,
    .name = "completion",
    .what = "Print what makes a shell complete this command line",
    .footer =
        "Commands, options, laws, effects, parameters, files. An installed hoplab has it.\n"
        "Examples:\n"
        "  hoplab completion bash > ~/.local/share/bash-completion/completions/hoplab\n"
        "  hoplab completion zsh > ~/.zfunc/_hoplab\n"
        "  hoplab completion fish > ~/.config/fish/completions/hoplab.fish",
    .add = AddCompletion};
}  // namespace commands
}  // namespace hoplab
