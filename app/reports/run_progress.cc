#include "app/reports/run_progress.h"

#include <cmath>

#include "app/terminal/quantity.h"
#include "app/terminal/warnings.h"

namespace hoplab {
namespace {

std::string StepText(int start, int restarts, std::string_view stage, int iteration, double cost) {
  std::string text = "fitting";
  if (start >= restarts) {
    text += ", beyond a threshold";
  } else if (restarts > 1) {
    text += ", start " + std::to_string(start + 1) + " of " + std::to_string(restarts);
  }
  text += ": " + std::string(stage) + ", iteration " + std::to_string(iteration);
  if (std::isfinite(cost)) text += ", cost " + Significant(cost, 5);
  return text;
}

}  // namespace

void ShowProgress(FitRunOptions& options, Progress& progress, const Console& console) {
  options.stage = [&progress](std::string_view stage) { progress.Stage(std::string(stage)); };
  options.checked = [&progress, &console](const CheckReport& check) {
    progress.Clear();
    for (const std::string& warning : CollapseWarnings(check.warnings)) Warn(console, warning);
  };
  const int restarts = options.fit.restarts;
  options.fit.progress = [&progress, restarts](int start, std::string_view stage, int iteration,
                                               double cost) {
    progress.Step(StepText(start, restarts, stage, iteration, cost), start, restarts);
  };
}

void ShowProgress(DiagnosisOptions& options, Progress& progress, const Console& console) {
  options.warned = [&progress, &console](const std::vector<std::string>& warnings) {
    progress.Clear();
    for (const std::string& warning : CollapseWarnings(warnings)) Warn(console, warning);
  };
  options.stage = [&progress](std::string_view stage) { progress.Stage(std::string(stage)); };
  options.step = [&progress](const std::string& text, int done, int of) {
    progress.Step(text, done, of);
  };
  const int restarts = options.fit.restarts;
  options.fit.progress = [&progress, restarts](int start, std::string_view stage, int iteration,
                                               double cost) {
    std::string text = "fitting the model as it is";
    if (restarts > 1)
      text += ", start " + std::to_string(start + 1) + " of " + std::to_string(restarts);
    text += ": " + std::string(stage) + ", iteration " + std::to_string(iteration);
    if (std::isfinite(cost)) text += ", cost " + Significant(cost, 5);
    progress.Step(text);
  };
}

void ShowProgress(ReproductionRequest& request, Progress& progress) {
  const std::size_t items = request.items.size();
  progress.Stage("reproducing " + std::to_string(items) + " items");
  request.progress = [&progress, items](int done, const std::string& item) {
    progress.Step(
        "reproducing: " + std::to_string(done) + " of " + std::to_string(items) + ", last " + item,
        done, static_cast<long>(items));
  };
}

}  // namespace hoplab
