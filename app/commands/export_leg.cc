#include <ostream>

#include "app/export/c_law.h"
#include "app/export/export_settings.h"
#include "app/export/mjcf.h"
#include "app/reports/run_folder.h"
#include "app/terminal/command.h"
#include "app/terminal/usage_error.h"
#include "base/atomic_file.h"
#include "base/text.h"

namespace hoplab {
namespace {

ExitCode RunExport(const ExportSettings& settings, Console& console) {
  if (settings.c_file.empty() && settings.mjcf_file.empty())
    throw UsageError("say what to write: --c leg.c, --mujoco leg.xml");
  if (settings.c_file == settings.mjcf_file)
    throw UsageError("--c and --mujoco name the same file; give each its own");
  const StoredRun run = ReadRunFolder(settings.folder);
  const ExportedModel model = ModelOfRun(settings.folder, run);
  const std::string place =
      Printable((std::filesystem::path(settings.folder) / "run.json").string(), 200);
  // Both are made before one is written.
  std::string c_text, mjcf_text;
  if (!settings.c_file.empty()) c_text = CSourceOf(model, place);
  if (!settings.mjcf_file.empty()) mjcf_text = MjcfOf(model, settings.mjcf, place);
  const OverwriteOptions options{.force = settings.force};
  for (const std::string& file : {settings.c_file, settings.mjcf_file})
    if (!file.empty()) CheckFileIsFree(file, options);
  if (!settings.c_file.empty()) WriteFileAtomically(settings.c_file, c_text, options);
  if (!settings.mjcf_file.empty()) WriteFileAtomically(settings.mjcf_file, mjcf_text, options);
  if (settings.json) {
    console.out << TextOf(ExportRecord(settings, run, model));
    return ExitCode::kDone;
  }
  if (!settings.c_file.empty()) console.out << settings.c_file << '\n';
  if (!settings.mjcf_file.empty()) console.out << settings.mjcf_file << '\n';
  return ExitCode::kDone;
}

void AddExport(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<ExportSettings>();
  AddExportOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunExport);
}

}  // namespace

namespace commands {
extern constexpr Command export_leg = {
    .place = 160,
    .name = "export",
    .what = "Write a run's leg for other programs: C, MuJoCo",
    .footer =
        "Examples:\n"
        "  hoplab export runs/rig-drops-fit-001 --c leg.c\n"
        "  hoplab export runs/rig-drops-diagnose-001 --mujoco leg.xml --arcs 48\n"
        "docs/export.md says what the files hold.",
    .add = AddExport};
}  // namespace commands
}  // namespace hoplab
