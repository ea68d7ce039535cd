#include "app/runs/reproduce_settings.h"

#include <filesystem>

#include "base/input_error.h"
#include "base/range.h"
#include "base/text.h"

namespace hoplab {
namespace {

void CheckLength(const std::string& option, double value) {
  constexpr Range kLength = Positive(1e3, "m");
  if (!kLength.Contains(value))
    throw InputError(
        {option, FormatDouble(value), "must be in " + kLength.Text(), RangeRemedy(value, kLength)});
}

// The constants that come along lie in the project's folder, or where they were installed.
std::string ConstantsFile(const std::string& said) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (said != kConstants || fs::exists(said, error)) return said;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / "share/hoplab" / kConstants;
  if (fs::exists(installed, error)) return installed.string();
  throw InputError({kConstants, "", "the constants of the study are not in this folder",
                    "Run this in the project's folder, or give a scenario of your own, as "
                    "--constants FILE."});
}

}  // namespace

void AddReproduceOptions(CLI::App& sub, ReproduceSettings& settings) {
  sub.add_option("ITEM", settings.items,
                 "table-6.1, figure-6.23, claim-a ...; or tables, figures, kinematics, claims, all "
                 "(default)");
  sub.add_option("--constants", settings.constants.scenario,
                 std::string("What the study does not print, a scenario (default ") + kConstants +
                     "); its start is that of table 6.5")
      ->option_text("FILE");
  sub.add_option("--set", settings.constants.set,
                 "key=value over the constants, as mechanism.body_mass_kg=0.5; repeatable, of one "
                 "key the last holds")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false);
  sub.add_option("--law", settings.constants.law, "Another law than the constants have")
      ->option_text("LAW");
  sub.add_option("--hip-distance", settings.legs.hip_distance,
                 "Kinematics: between the hips, m (default 0.4)")
      ->option_text("M");
  sub.add_option("--leg-diameter", settings.legs.leg_diameter,
                 "Kinematics: of a leg's half circle, m (default 0.18)")
      ->option_text("M");
  AddJobsOption(sub, settings.jobs);
  AddSolverOptions(sub, settings.solver);
  AddRunFolderOptions(sub, settings, "Run folder (default runs/<constants>-reproduce-NNN)");
}

ScenarioDocument ConstantsOf(const ReproduceSettings& settings) {
  ScenarioSettings constants = settings.constants;
  constants.scenario = ConstantsFile(constants.scenario);
  return ScenarioDocumentOf(constants);
}

ReproductionRequest ReproductionRequestOf(const ReproduceSettings& settings) {
  CheckLength("--hip-distance", settings.legs.hip_distance);
  CheckLength("--leg-diameter", settings.legs.leg_diameter);
  ReproductionRequest request;
  request.items =
      ResolveStudyItems(settings.items.empty() ? std::vector<std::string>{"all"} : settings.items);
  request.legs = settings.legs;
  request.jobs = JobsOf(settings.jobs);
  return request;
}

}  // namespace hoplab
