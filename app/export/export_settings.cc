#include "app/export/export_settings.h"

#include "app/terminal/help_text.h"

namespace hoplab {

void AddExportOptions(CLI::App& sub, ExportSettings& settings) {
  sub.add_option("RUN_DIR", settings.folder, "A folder that fit, diagnose or simulate wrote")
      ->required();
  sub.add_option("--c", settings.c_file, "The law with its values as one C99 file")
      ->option_text("FILE");
  sub.add_option("--mujoco", settings.mjcf_file, "Leg and rig as an MJCF model: a beam of arcs")
      ->option_text("FILE");
  sub.add_option("--arcs", settings.mjcf.arcs, "Arcs of the MJCF leg (default 24)")
      ->check(CLI::Range(4, 80))
      ->option_text("N");
  sub.add_option("--step", settings.mjcf.step, "Of MuJoCo's integrator [s] (default 5e-5)")
      ->check(NumberIn(1e-7, 1e-3))
      ->option_text("SECONDS");
  sub.add_option("--leg-mass", settings.mjcf.leg_mass,
                 "Of the MJCF leg [kg] where none was fitted (default a thousandth of the body)")
      ->check(NumberAbove0(1e6, 1e-12))
      ->option_text("KG");
  sub.add_flag("--force", settings.force, "Replace a file that stands there");
}

Json ExportRecord(const ExportSettings& settings, const StoredRun& run,
                  const ExportedModel& model) {
  RecordHeader header;
  header.command = "export";
  const Json dataset = run.record.value("dataset", Json());
  if (dataset.is_string()) header.dataset = dataset.get<std::string>();
  header.law = std::string(NameOf(model.law));
  header.reading = model.parameters.reading;
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

}  // namespace hoplab
