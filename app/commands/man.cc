#include <ostream>

#include "app/records/run_record.h"
#include "app/terminal/command.h"
#include "app/terminal/man_page.h"

namespace hoplab {
namespace {

struct ManSettings {
  bool json = false;
};

void AddMan(CLI::App& sub, Invocation& invocation) {
  sub.group("");  // what the build installs; readers say `man hoplab`
  OnParsed(sub, invocation, std::make_shared<ManSettings>(),
           [&app = *sub.get_parent()](const ManSettings& settings, Console& console) {
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

}  // namespace

namespace commands {
extern constexpr Command man = {.place = 210,
                                .name = "man",
                                .what = "Print the manual page",
                                .footer = "Example:\n  hoplab man | man -l -",
                                .add = AddMan};
}  // namespace commands
}  // namespace hoplab
