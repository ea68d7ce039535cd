#include <ostream>
#include <set>

#include "app/records/law_comparison_record.h"
#include "app/reports/law_comparison_report.h"
#include "app/runs/compare_settings.h"
#include "app/terminal/command.h"
#include "app/terminal/progress.h"
#include "base/input_error.h"
#include "base/text.h"
#include "datasets/read_dataset.h"

namespace hoplab {
namespace {

// What is known from elsewhere is a value that some model fits. Asked before anything is fitted.
void CheckTruth(const std::map<std::string, double>& truth, const Dataset& dataset,
                const std::vector<ComparedModel>& models, const ProblemOptions& options) {
  if (truth.empty()) return;
  std::set<std::string> fitted;
  for (const ComparedModel& model : models)
    for (const SharedParameter& s : MakeProblem(dataset, OptionsOf(model, options)).shared)
      fitted.insert(s.name);
  const std::vector<std::string> known(fitted.begin(), fitted.end());
  for (const auto& [name, value] : truth) {
    if (!fitted.contains(name))
      throw InputError(
          {"--true", Printable(name), "is no value that is fitted", DidYouMean(name, known)});
  }
}

// Laws and effects of the models were told by `--variant`: a message speaks of it.
InputError OfVariant(const InputError& error) {
  InputError::Parts parts = error.parts();
  if (parts.place == "--law" || parts.place == "--with") parts.place = "--variant";
  return InputError(parts);
}

LawComparison Compared(const Dataset& dataset, const std::vector<ComparedModel>& models,
                       const CompareSettings& settings, Progress& progress) {
  FitOptions fit;
  fit.jobs = JobsOf(settings.problem.jobs);
  const auto step = [&](int done) {
    progress.Step(
        "fitting each model: " + std::to_string(done) + " of " + std::to_string(models.size()),
        done, static_cast<long>(models.size()));
  };
  return CompareLaws(dataset, models, ProblemOptionsOf(settings.problem), fit, Segmentation::kAuto,
                     step);
}

ExitCode RunCompare(const CompareSettings& settings, Console& console) {
  const Dataset dataset = ReadDataset(settings.problem.dataset);
  const std::map<std::string, double> truth = ParseAssignments(settings.truth, "--true");
  const std::vector<ComparedModel> models = ComparedModels(settings, dataset);
  Progress progress(console, settings.quiet);
  const LawComparison comparison = [&] {
    try {
      CheckTruth(truth, dataset, models, ProblemOptionsOf(settings.problem));
      progress.Stage("fitting each model");
      return Compared(dataset, models, settings, progress);
    } catch (const InputError& error) {
      throw OfVariant(error);
    }
  }();
  progress.Clear();
  if (!settings.json) {
    console.out << LawComparisonReport(comparison, truth);
    return ExitCode::kDone;
  }
  console.out << TextOf(LawComparisonRecord(dataset.name, comparison, truth));
  return ExitCode::kDone;
}

void AddCompare(CLI::App& sub, Invocation& invocation) {
  auto settings = std::make_shared<CompareSettings>();
  AddCompareOptions(sub, *settings);
  OnParsed(sub, invocation, settings, RunCompare);
}

}  // namespace

namespace commands {
extern constexpr Command compare = {
    .place = 70,
    .name = "compare",
    .what = "Fit the same hops with every law of the leg",
    .footer =
        "Examples:\n"
        "  hoplab compare datasets/rig-drops --true E=21.991e9\n"
        "  hoplab compare my-hops --variant consistent\n"
        "  hoplab compare my-hops --variant large_deflection+leg_material_damping",
    .add = AddCompare};
}  // namespace commands
}  // namespace hoplab
