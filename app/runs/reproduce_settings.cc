#include "app/runs/reproduce_settings.h"

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
                 "key=value over the constants, as mechanism.body_mass_kg=0.5; repeatable")
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
