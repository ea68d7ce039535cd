#include <ostream>

#include "app/records/identify_record.h"
#include "app/reports/identify_report.h"
#include "app/reports/kept_work.h"
#include "app/reports/run_folder.h"
#include "app/runs/identify_work.h"
#include "app/runs/on_ranks.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/stopwatch.h"
#include "app/version.h"

namespace hoplab {
namespace {

// The other ranks, which wait for work: where none is begun they are told so.
struct WaitingRanks {
  MpiJob* job;
  ~WaitingRanks() {
    if (job) job->Share("");
  }
};

ExitCode Lead(const IdentifySettings& settings, Console& console, MpiJob* job) {
  const Stopwatch watch;
  const InterruptGuard interrupt;
  IdentificationRequest request = IdentificationRequestOf(settings);
  WaitingRanks waiting{job};
  const RunFolder folder(RunFolderOptionsOf(settings), "published", "identify");
  FitJournal journal(folder.Partial(), request.context, ProjectVersion(), settings.force);
  request.context.stop = interrupt.flag();
  Progress progress(console, settings.quiet);
  IdentificationResult result;
  {
    waiting.job = nullptr;
    IdentifyWork work(request.context, journal,
                      {.jobs = JobsOf(settings.jobs), .job = job, .stop = interrupt.flag()},
                      progress, console);
    result = Identify(request, work.Fits());
  }
  progress.Clear();

  Json record = IdentifyRecord(settings, request, result);
  record["seconds"] = watch.Seconds();
  if (result.interrupted)
    return TellKeptWork(std::to_string(journal.size()) + " fits", journal.lines().file().string(),
                        std::move(record), settings.json, console);
  const std::string written =
      folder.Write(IdentifyFiles(settings, result, record, journal)).string();
  journal.Remove();
  if (settings.json) {
    console.out << TextOf(record);
  } else {
    console.out << IdentifyReport(request, result, console.out_colours) << "  run folder  "
                << written << '\n';
  }
  return ExitCode::kDone;
}

ExitCode RunIdentify(const IdentifySettings& settings, Console& console) {
  return OnRanks(
      [&](MpiJob* job) { return Lead(settings, console, job); },
      [&](MpiJob& job) { FollowIdentification(IdentificationRequestOf(settings).context, job); });
}

void AddIdentify(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<IdentifySettings>();
  AddIdentifyOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunIdentify);
}

}  // namespace

namespace commands {
extern constexpr Command identify = {
    .place = 120,
    .name = "identify",
    .what = "Find what the published study does not print, from its tables",
    .footer =
        "An interrupted run goes on where it was: start the same command again.\n"
        "Examples:\n"
        "  hoplab identify --tables 6.5 --budget 40\n"
        "  hoplab identify --budget 2000 --free-damping-scale --out constants\n"
        "  mpirun -n 4 hoplab identify --tables all --free-toe-mass",
    .add = AddIdentify};
}  // namespace commands
}  // namespace hoplab
