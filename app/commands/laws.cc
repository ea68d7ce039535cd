#include <ostream>

#include "app/records/law_record.h"
#include "app/reports/law_list.h"
#include "app/terminal/command.h"

namespace hoplab {
namespace {

struct LawsSettings {
  bool json = false;
};

ExitCode RunLaws(const LawsSettings& settings, Console& console) {
  console.out << (settings.json ? TextOf(LawsRecord()) : LawListText(console.out_colours));
  return ExitCode::kDone;
}

void AddLaws(CLI::App& sub, Invocation& invocation) {
  OnParsed(sub, invocation, std::make_shared<LawsSettings>(), RunLaws);
}

}  // namespace

namespace commands {
extern constexpr Command laws = {.place = 170,
                                 .name = "laws",
                                 .what = "Leg laws and parameters of each mechanism",
                                 .footer = "Example:\n  hoplab laws",
                                 .add = AddLaws};
}  // namespace commands
}  // namespace hoplab
