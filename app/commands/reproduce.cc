#include <ostream>

#include "app/records/reproduction_record.h"
#include "app/records/reproduction_runs.h"
#include "app/reports/reproduction_report.h"
#include "app/reports/run_folder.h"
#include "app/reports/run_progress.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/stopwatch.h"

namespace hoplab {
namespace {

ExitCode RunReproduceCommand(const ReproduceSettings& settings, Console& console) {
  const Stopwatch watch;
  ReproductionRequest request = ReproductionRequestOf(settings);
  const ScenarioDocument document = ConstantsOf(settings);
  request.study = StudyOfScenario(document.Read(), IntegratorOptionsOf(settings.solver));
  const std::string& name = request.study.constants.name;
  const RunFolder folder(RunFolderOptionsOf(settings), name, "reproduce");

  const InterruptGuard interrupt;
  request.stop = interrupt.flag();
  Progress progress(console, settings.quiet);
  ShowProgress(request, progress);
  const Reproduction reproduction = Reproduce(request);
  progress.Clear();

  Json record =
      NewReproductionRecord(settings, request.study, request.items, document.ResolvedText());
  AddReproduction(reproduction, record);
  const std::string failure = FailureOf(reproduction);
  if (!failure.empty()) SetFailed(record, failure);
  record["seconds"] = watch.Seconds();
  std::map<std::string, std::string> files = ReproductionTables(reproduction);
  if (const auto runs = ComparedLegs(request.study, reproduction)) {
    files["trajectories.csv"] = runs->table;
    record["mechanisms"] = runs->mechanisms;
  }
  files["run.json"] = TextOf(record);
  const std::string written = folder.Write(files).string();
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << ReproductionReport(name, reproduction, console.out_colours) << "  run folder  "
                << written << '\n';
  }
  if (failure.empty()) return ExitCode::kDone;
  console.err << "hoplab reproduce: " << failure << '\n';
  return ExitCode::kInterrupted;
}

void AddReproduce(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<ReproduceSettings>();
  AddReproduceOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunReproduceCommand);
}

}  // namespace

namespace commands {
extern constexpr Command reproduce = {
    .place = 110,
    .name = "reproduce",
    .what = "Tables, figures and claims of the published study beside ours",
    .footer =
        "A verdict is \"reproduced\", \"only under stated settings\" or \"not reproduced\";\n"
        "the exit code is 0 with any of them. See docs/published-study.md.\n"
        "Examples:\n"
        "  hoplab reproduce table-6.5 claim-h\n"
        "  hoplab reproduce all --out runs/study\n"
        "  hoplab reproduce kinematics --hip-distance 0.5\n"
        "  hoplab reproduce claims --law consistent --set mechanism.leg.variant=null",
    .add = AddReproduce};
}  // namespace commands
}  // namespace hoplab
