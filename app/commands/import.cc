#include <chrono>
#include <ostream>

#include "app/records/import_record.h"
#include "app/reports/import_report.h"
#include "app/terminal/command.h"
#include "app/terminal/usage_error.h"
#include "base/atomic_file.h"

namespace hoplab {
namespace {

ExitCode RunImport(const ImportSettings& settings, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  const ImportRequest request = ImportRequestOf(settings);
  const OverwriteOptions overwrite{settings.force, "dataset.yaml"};
  CheckFolderIsFree(settings.out, overwrite);
  const ImportResult made = ImportLogs(request);
  for (const std::string& note : made.notes) console.err << "note: " << note << '\n';
  if (made.map.HasGuesses() && !settings.accept_guesses) {  // nobody has looked at them
    console.err << GuessesText(made);
    throw UsageError(
        "columns or units are guessed, so nothing was written. Add --accept-guesses if they are "
        "right, or say them by --map.");
  }
  WriteFolderAtomically(
      settings.out,
      [&](const std::filesystem::path& staged) {
        for (const auto& [name, text] : made.files) WriteFileAtomically(staged / name, text);
      },
      overwrite);
  if (settings.json) {
    Json record = ImportRecord(request, settings, made);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    record["seconds"] = took.count();
    console.out << TextOf(record);
    return ExitCode::kDone;
  }
  console.out << ImportReport(request.name, settings.out, made, console.out_colours);
  return ExitCode::kDone;
}

void AddImport(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<ImportSettings>();
  AddImportOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunImport);
}

}  // namespace

namespace commands {
extern constexpr Command import = {
    .place = 10,
    .name = "import",
    .what = "Make a dataset of recordings: CSV, Motive, OpenSim, MATLAB, HDF5",
    .footer =
        "Channels: t x y vx ax leg_angle fx torque body_pitch leg_angle_1 reference_1, ..\n"
        "Without --accept-guesses it shows what it would take for what.\n"
        "Examples:\n"
        "  hoplab import docs/tutorial/run-1.csv --accept-guesses --out mine\n"
        "  hoplab import run17.csv run18.csv --map t=Time:ms --map y=z:mm --out mine",
    .add = AddImport};
}  // namespace commands
}  // namespace hoplab
