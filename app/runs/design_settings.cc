#include "app/runs/design_settings.h"

#include <cmath>

#include "app/terminal/usage_error.h"
#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

// "angle=10:50", or "mass=0" for a setting that is held.
DesignRange RangeOf(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name(Trim(text.substr(0, equals)));
  if (equals != text.npos) {
    const std::string range = text.substr(equals + 1);
    const std::size_t colon = range.find(':');
    const auto low = ParseDouble(Trim(range.substr(0, colon)));
    const auto high = colon == range.npos ? low : ParseDouble(Trim(range.substr(colon + 1)));
    if (low && high && std::isfinite(*low) && std::isfinite(*high)) {
      const std::optional<DesignSetting> setting = FindDesignSetting(name);
      if (setting) {
        const double si = InfoOf(*setting).si;
        return {*setting, *low * si, *high * si};
      }
      std::vector<std::string> known;
      for (int i = 0; i < kDesignSettings; ++i)
        known.emplace_back(InfoOf(static_cast<DesignSetting>(i)).name);
      throw InputError({"--space", Printable(name), "is no setting of a trial to record",
                        DidYouMean(name, known)});
    }
  }
  throw UsageError("--space: " + Printable(text) +
                   "; must be setting=low:high, or setting=value to hold it, as angle=10:50");
}

}  // namespace

void AddDesignOptions(CLI::App& sub, DesignSettings& settings) {
  AddProblemOptions(sub, settings.problem);
  CLI::Option* cause =
      sub.add_option("--cause", settings.cause,
                     "Effects to tell apart, each added to the model; one: from none of it")
          ->delimiter(',')
          ->option_text("EFFECT,...")
          ->allow_extra_args(false);
  sub.add_option("--sharpen", settings.sharpen,
                 "Fitted value whose interval is to shrink (default of both: diagnose decides)")
      ->option_text("NAME")
      ->excludes(cause);
  sub.add_option(
         "--space", settings.space,
         "Ranges of angle [deg], height [m], speed [m/s], mass [kg] added, throw [m/s] "
         "up, gain [N s], of a robot pitch [deg] and the motors' angles leg_1, ... [deg]; as "
         "angle=10:50,mass=0")
      ->delimiter(',')
      ->option_text("SETTING=LOW:HIGH,...")
      ->allow_extra_args(false);
  sub.add_option("--budget", settings.budget, "Designs to try (default 300)")
      ->check(CLI::Range(1, 1000000))
      ->option_text("N");
  sub.add_option("--map", settings.map_size, "Points along each axis of the maps (default 13)")
      ->check(CLI::Range(0, 200))
      ->option_text("N");
  AddDiscrepancyOption(sub, settings.discrepancy);
  AddSeedOption(sub, settings.seed, "Of the search");
  AddRunFolderOptions(sub, settings, "Run folder (default runs/<dataset>-design-NNN)");
}

DesignRunOptions DesignRunOptionsOf(const DesignSettings& settings) {
  DesignRunOptions options;
  options.problem = ProblemOptionsOf(settings.problem);
  options.fit.seed = settings.seed;
  options.fit.jobs = JobsOf(settings.problem.jobs);
  options.fit.discrepancy = *FindDiscrepancy(settings.discrepancy);
  options.causes = settings.cause;
  options.sharpen = settings.sharpen;
  for (const std::string& text : settings.space) options.space.push_back(RangeOf(text));
  options.budget = settings.budget;
  options.map_size = settings.map_size;
  return options;
}

}  // namespace hoplab
