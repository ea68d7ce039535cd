#include "app/commands/man.h"

#include <ostream>

#include "app/man_page.h"
#include "app/run_record.h"

namespace hoplab {
namespace {

struct ManSettings {
  bool json = false;
};

}  // namespace

void AddManCommand(CLI::App& app, Invocation& invocation) {
  // What the build installs; readers say `man hoplab`.
  CLI::App& sub = *app.add_subcommand("man", "Print the manual page")->group("");
  sub.footer("Example:\n  hoplab man | man -l -");
  OnParsed(sub, invocation, std::make_shared<ManSettings>(),
           [&app](const ManSettings& settings, Console& console) {
             if (!settings.json) {
               console.out << ManPage(app);
               return ExitCode::kDone;
             }
             RecordHeader header;
             header.command = "man";
             Json record = NewRecord(header);
             record["page"] = ManPage(app);
             console.out << TextOf(record);
             return ExitCode::kDone;
           });
}

}  // namespace hoplab
