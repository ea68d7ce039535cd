#include "app/reports/optimize_report.h"

#include <fmt/format.h>

#include <cmath>

#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/text_table.h"

namespace hoplab {
namespace {

// "0.71 s after 2 hops", "falls (fell_no_return)".
std::string Worth(const SearchPoint& point) {
  switch (point.verdict) {
    case PointVerdict::kRunEnded:
      return "the run ends: it " + std::string(SentenceOf(point.outcome));
    case PointVerdict::kNoConvergence:
      return "does not converge";
    case PointVerdict::kConstraint:
      return "breaks " + point.violated;
    case PointVerdict::kGood:
    case PointVerdict::kWideBand:
      break;
  }
  std::string text;
  if (point.convergence.converged())
    text = fmt::format("{} s{}, {} hop{}", Fixed(point.convergence.time, 3),
                       point.verdict == PointVerdict::kWideBand ? "* (2 %)" : "",
                       point.convergence.hops, point.convergence.hops == 1 ? "" : "s");
  if (!std::isnan(point.spectral_radius))
    text += fmt::format("{}spectral radius {}", text.empty() ? "" : ", ",
                        Significant(point.spectral_radius, 4));
  text += fmt::format(", {} m/s", Fixed(point.speed, 3));
  if (point.gait.empty()) return text;
  return point.gait + ": " + text +
         fmt::format(", cost of transport {}, at most {} N m",
                     Significant(point.cost_of_transport, 3), Significant(point.torque, 3));
}

std::string WorstText(const WorstCase& worst) {
  std::string text = fmt::format("{} of {} converge", worst.converged, worst.runs);
  if (std::isfinite(worst.worst_time))
    text += fmt::format(", at worst in {} s", Fixed(worst.worst_time, 3));
  return text + (worst.ended > 0 ? fmt::format(", {} fall", worst.ended) : "");
}

std::string NoiseText(const NoisyHops& noise) {
  return fmt::format("{} of {} runs of 60 hops fall, speed varies by {} %", noise.fell, noise.runs,
                     Significant(100.0 * noise.speed_deviation, 2));
}

}  // namespace

std::string OptimizeReport(const std::string& name, const OptimizeRun& run, bool colours) {
  using enum TextTable::Align;
  const GainSearchResult& result = run.result;
  std::string text =
      Styled(name, Emphasis::kBold, colours) +
      fmt::format("  {} by {}, {} evaluations from {} seed{}\n\n", NameOf(run.problem.objective),
                  NameOf(run.options.algorithm), result.evaluations, result.seeds.size(),
                  result.seeds.size() == 1 ? "" : "s");
  if (!run.has_result()) return text;
  TextTable table({kLeft, kRight, kRight, kLeft});
  table.AddRow({"", "before", "best", "searched"});
  for (std::size_t i = 0; i < run.problem.variables.size(); ++i) {
    const SearchVariable& v = run.problem.variables[i];
    table.AddRow({v.name, Significant(run.scenario_x[i], 5), Significant(result.best.x[i], 5),
                  fmt::format("{} .. {}", Significant(v.low, 4), Significant(v.high, 4))});
  }
  const std::vector<std::string> lines = table.Lines();
  text += Styled(lines.front(), Emphasis::kFaint, colours) + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) text += lines[i] + "\n";
  text +=
      "\n  before         " + Worth(run.before) + "\n  best           " + Worth(result.best) + "\n";
  text += fmt::format("  how sure       {} of {} seeds end within 1 % of the best\n",
                      result.agreeing, result.seeds.size());
  text += "  stiffness 5 %  " + WorstText(run.best_robustness.stiffness) +
          " (before: " + WorstText(run.before_robustness.stiffness) + ")\n";
  text += "  25 starts      " + WorstText(run.best_robustness.initial_states) +
          " (before: " + WorstText(run.before_robustness.initial_states) + ")\n";
  if (run.best_robustness.noise.runs > 0)
    text += "  0.5 deg noise  " + NoiseText(run.best_robustness.noise) +
            " (before: " + NoiseText(run.before_robustness.noise) + ")\n";
  return text;
}

}  // namespace hoplab
