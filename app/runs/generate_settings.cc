#include "app/runs/generate_settings.h"

#include "app/terminal/help_text.h"
#include "base/channel.h"

namespace hoplab {

void AddGenerateOptions(CLI::App& sub, GenerateSettings& settings) {
  AddScenarioOptions(sub, settings.scenario);
  sub.add_option("--noise", settings.noise,
                 "1 standard deviation of every channel, in its unit (default: the scenario's)")
      ->check(NumberAbove0(kMostSigma, kLeastSigma))
      ->option_text("SIGMA");
  AddSeedOption(sub, settings.seed, "Of the noise");
  sub.add_option("--out", settings.out, "Folder of the new dataset")
      ->required()
      ->option_text("DATASET");
  sub.add_flag("--force", settings.force, "Replace the dataset that stands there");
}

}  // namespace hoplab
