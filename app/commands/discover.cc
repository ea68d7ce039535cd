#include <ostream>

#include "app/export/discovered_code.h"
#include "app/records/discovery_record.h"
#include "app/reports/discovery_report.h"
#include "app/reports/run_folder.h"
#include "app/runs/discover_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress.h"
#include "app/terminal/report_text.h"
#include "app/terminal/stopwatch.h"
#include "base/text.h"
#include "datasets/read_dataset.h"

namespace hoplab {
namespace {

ExitCode RunDiscover(const DiscoverSettings& settings, Console& console) {
  const Stopwatch watch;
  DiagnosisOptions options = DiscoveryOptionsOf(settings);
  const Dataset dataset = ReadDataset(settings.problem.dataset);
  const RunFolder folder(RunFolderOptionsOf(settings), dataset.name, "discover");

  const InterruptGuard interrupt;
  Progress progress(console, settings.quiet);
  options.fit.stop = interrupt.flag();
  options.stage = [&](std::string_view stage) { progress.Stage(std::string(stage)); };
  options.step = [&](const std::string& text, int done, int of) { progress.Step(text, done, of); };
  const Discovery found = Discover(dataset, options);
  progress.Clear();

  Json record = DiscoveryRecord(dataset, settings.problem.dataset, options, found);
  record["seconds"] = watch.Seconds();
  std::map<std::string, std::string> files = DiscoveryFiles(found);
  if (settings.code) files.merge(DiscoveryCode(found));
  files["run.json"] = TextOf(record);
  const std::string kept = folder.Write(files).string();
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << Styled(Printable(dataset.name, 100), Emphasis::kBold, console.out_colours)
                << "\n\n";
    for (const std::string& note : found.base.notes)
      console.out << Labelled("note", note, console.out_colours);
    console.out << DiscoveryReport(found, console.out_colours)
                << (settings.code ? CodeReport(found, console.out_colours) : "")
                << Styled("\n  run folder   ", Emphasis::kFaint, console.out_colours) << kept
                << '\n';
  }
  const std::string failure = FailureOf(found);
  if (!failure.empty()) console.err << "hoplab discover: " << failure << '\n';
  return ExitCodeOf(found.base.interrupted, failure);
}

void AddDiscover(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<DiscoverSettings>();
  AddDiscoverOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunDiscover);
}

}  // namespace

namespace commands {
extern constexpr Command discover = {
    .place = 50,
    .name = "discover",
    .what = "Look for a formula of what the simulation lacks and no listed cause explains",
    .footer =
        "Examples:\n"
        "  hoplab discover datasets/rig-drops --law large_deflection\n"
        "  hoplab discover my-hops --with air_drag --jobs 4\n"
        "  hoplab fit my-hops --with runs/my-hops-discover-001/discovered.yaml",
    .add = AddDiscover};
}  // namespace commands
}  // namespace hoplab
