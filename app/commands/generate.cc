#include "fitting/generate.h"

#include <chrono>
#include <ostream>

#include "app/records/generate_record.h"
#include "app/terminal/command.h"
#include "base/atomic_file.h"
#include "datasets/write_dataset.h"

namespace hoplab {
namespace {

ExitCode RunGenerate(const GenerateSettings& settings, Console& console) {
  const auto begin = std::chrono::steady_clock::now();
  CheckFolderIsFree(settings.out, {settings.force, "dataset.yaml"});
  const Scenario scenario = ReadScenarioOf(settings.scenario);
  GenerateOptions options;
  options.noise = settings.noise;
  options.seed = settings.seed;
  const GeneratedDataset made = GenerateDataset(scenario, options);
  WriteDataset(made.dataset, settings.out, {settings.force});
  for (const std::string& note : made.notes) console.err << "note: " << note << '\n';
  if (settings.json) {
    Json record = GenerateRecord(settings, scenario, made);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    record["seconds"] = took.count();
    console.out << TextOf(record);
    return ExitCode::kDone;
  }
  std::size_t rows = 0;
  for (const Trial& trial : made.dataset.trials) rows += trial.trace.time_s.size();
  console.out << Styled(made.dataset.name, Emphasis::kBold, console.out_colours) << "  "
              << made.dataset.trials.size()
              << (made.dataset.trials.size() == 1 ? " trial, " : " trials, ") << rows
              << " rows, seed " << settings.seed << "\n  dataset     " << settings.out << '\n';
  return ExitCode::kDone;
}

void AddGenerate(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<GenerateSettings>();
  AddGenerateOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunGenerate);
}

}  // namespace

namespace commands {
extern constexpr Command generate = {
    .place = 140,
    .name = "generate",
    .what = "Make a dataset from a scenario, with noise",
    .footer =
        "Examples:\n"
        "  hoplab generate experiments/three-drops.yaml --out my-hops\n"
        "  hoplab generate hopping.yaml --with air_drag:c_drag=0.05 --seed 7 --out windy",
    .add = AddGenerate};
}  // namespace commands
}  // namespace hoplab
