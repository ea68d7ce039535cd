#include <chrono>
#include <ostream>

#include "app/records/identify_record.h"
#include "app/reports/identify_report.h"
#include "app/reports/run_folder.h"
#include "app/runs/identify_work.h"
#include "app/terminal/command.h"
#include "app/terminal/interrupt.h"
#include "app/version.h"
#include "base/input_error.h"

namespace hoplab {
namespace {

ExitCode Lead(const IdentifySettings& settings, Console& console, MpiJob* job) {
  const auto begin = std::chrono::steady_clock::now();
  const InterruptGuard interrupt;
  IdentificationRequest request = IdentificationRequestOf(settings);
  const RunFolder folder(RunFolderOptionsOf(settings), "published", "identify");
  FitJournal journal(folder.Partial(), request.context, ProjectVersion(), settings.force);
  request.context.stop = interrupt.flag();
  Progress progress(console, settings.quiet);
  IdentificationResult result;
  {
    IdentifyWork work(request.context, journal,
                      {.jobs = JobsOf(settings.jobs), .job = job, .stop = interrupt.flag()},
                      progress, console);
    result = Identify(request, work.Fits());
  }
  progress.Clear();

  Json record = IdentifyRecord(settings, request, result);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  record["seconds"] = took.count();
  if (result.interrupted) {
    const std::string message = "interrupted; " + std::to_string(journal.size()) +
                                " fits are kept in " + journal.lines().file().string() +
                                ", the same command computes the others";
    SetFailed(record, message);
    if (settings.json) console.out << TextOf(record);
    console.err << "hoplab identify: " << message << '\n';
    return ExitCode::kInterrupted;
  }
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

// A rank other than 0: says nothing, rank 0 tells what is wrong with the settings.
ExitCode Follow(const IdentifySettings& settings, MpiJob& job) {
  try {
    const IdentificationRequest request = IdentificationRequestOf(settings);
    FollowIdentification(request.context, job);
    return ExitCode::kDone;
  } catch (const InputError&) {
    return ExitCode::kDone;
  }
}

ExitCode RunIdentify(const IdentifySettings& settings, Console& console) {
  if (!MpiJob::Launched()) return Lead(settings, console, nullptr);
  MpiJob job;
  return job.rank() == 0 ? Lead(settings, console, &job) : Follow(settings, job);
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
