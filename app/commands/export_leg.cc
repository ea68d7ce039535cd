#include <ostream>

#include "app/export/c_law.h"
#include "app/export/exported_model.h"
#include "app/export/mjcf.h"
#include "app/reports/run_folder.h"
#include "app/terminal/command.h"
#include "app/terminal/usage_error.h"
#include "base/atomic_file.h"
#include "base/text.h"

namespace hoplab {
namespace {

struct ExportSettings {
  std::string folder, c_file, mjcf_file;
  MjcfOptions mjcf;
  bool force = false, json = false;
};

Json RecordOf(const ExportSettings& settings, const StoredRun& run, const ExportedModel& model) {
  RecordHeader header;
  header.command = "export";
  const Json dataset = run.record.value("dataset", Json());
  if (dataset.is_string()) header.dataset = dataset.get<std::string>();
  header.law = std::string(NameOf(model.law));
  header.variant = model.parameters.variant;
  header.options = {{"run", settings.folder},
                    {"arcs", settings.mjcf.arcs},
                    {"step_s", settings.mjcf.step},
                    {"leg_mass_kg", settings.mjcf.leg_mass}};
  Json record = NewRecord(header);
  record["origin"] = model.origin;
  record["files"] = Json::array();
  for (const std::string& file : {settings.c_file, settings.mjcf_file}) {
    if (!file.empty()) record["files"].push_back(file);
  }
  record["effects"] = Json::array();
  for (const EffectSetting& e : model.effects) record["effects"].push_back(e.effect->info.name);
  return record;
}

ExitCode RunExport(const ExportSettings& settings, Console& console) {
  if (settings.c_file.empty() && settings.mjcf_file.empty())
    throw UsageError("say what to write: --c leg.c, --mujoco leg.xml");
  const StoredRun run = ReadRunFolder(settings.folder);
  const ExportedModel model = ModelOfRun(settings.folder, run);
  const std::string place =
      Printable((std::filesystem::path(settings.folder) / "run.json").string(), 200);
  // Both are made before one is written.
  std::string c_text, mjcf_text;
  if (!settings.c_file.empty()) c_text = CSourceOf(model, place);
  if (!settings.mjcf_file.empty()) mjcf_text = MjcfOf(model, settings.mjcf, place);
  const OverwriteOptions options{.force = settings.force};
  if (!settings.c_file.empty()) WriteFileAtomically(settings.c_file, c_text, options);
  if (!settings.mjcf_file.empty()) WriteFileAtomically(settings.mjcf_file, mjcf_text, options);
  if (settings.json) {
    console.out << TextOf(RecordOf(settings, run, model));
    return ExitCode::kDone;
  }
  if (!settings.c_file.empty()) console.out << settings.c_file << '\n';
  if (!settings.mjcf_file.empty()) console.out << settings.mjcf_file << '\n';
  return ExitCode::kDone;
}

void AddExport(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<ExportSettings>();
  sub.add_option("RUN_DIR", settings->folder, "A folder that fit, diagnose or simulate wrote")
      ->required();
  sub.add_option("--c", settings->c_file, "The law with its values as one C99 file")
      ->option_text("FILE");
  sub.add_option("--mujoco", settings->mjcf_file, "Leg and rig as an MJCF model: a beam of arcs")
      ->option_text("FILE");
  sub.add_option("--arcs", settings->mjcf.arcs, "Arcs of the MJCF leg (default 24)")
      ->check(CLI::Range(4, 80))
      ->option_text("N");
  sub.add_option("--step", settings->mjcf.step, "Of MuJoCo's integrator [s] (default 5e-5)")
      ->check(CLI::Range(1e-7, 1e-3))
      ->option_text("SECONDS");
  sub.add_option("--leg-mass", settings->mjcf.leg_mass,
                 "Of the MJCF leg [kg] where none was fitted (default a thousandth of the body)")
      ->check(CLI::PositiveNumber)
      ->option_text("KG");
  sub.add_flag("--force", settings->force, "Replace a file that stands there");
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
