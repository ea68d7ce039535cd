#include "app/reports/simulation_report.h"

#include <fmt/format.h>

#include "app/records/simulation_record.h"
#include "app/terminal/console.h"
#include "app/terminal/quantity.h"
#include "app/terminal/text_table.h"
#include "fitting/run_end.h"

namespace hoplab {

std::string SimulationReport(const std::string& name, const SimulationRequest& request,
                             const Trajectory& run, bool colours) {
  using enum TextTable::Align;
  std::string text = Styled(name, Emphasis::kBold, colours) +
                     fmt::format("  law {}: {} at {} s, {} hop{}\n\n", NameOf(request.law),
                                 WhyEnded(run, request.effects, request.initial),
                                 Fixed(run.end_time, 4), run.hops, run.hops == 1 ? "" : "s");
  TextTable table({kRight, kLeft, kLeft, kRight, kRight, kRight, kRight, kRight});
  table.AddRow({"time s", "event", "to", "x m", "y m", "vx m/s", "vy m/s", "energy J"});
  const std::vector<std::pair<double, double>> energies = ApexEnergies(request, run);
  const auto row = [&](double time, std::string_view event, std::string_view to, double x, double y,
                       double vx, double vy, const std::string& energy) {
    table.AddRow({Fixed(time, 4), std::string(event), std::string(to), Fixed(x, 4), Fixed(y, 4),
                  Fixed(vx, 4), Fixed(vy, 4), energy});
  };
  const auto& s = request.initial;
  const auto energy = [&energies](std::size_t apex) {
    return apex < energies.size() ? Fixed(energies[apex].second, 6) : "";
  };
  const bool robot = request.law == Law::kRobot;
  row(0.0, "start", robot ? "" : "flight", s[0], s[1], s[2], s[3], energy(0));
  std::size_t apex = 1;
  for (const Event& e : run.events) {
    const bool is_apex = e.kind == EventKind::kApex;
    std::string event(NameOf(e.kind));
    if (robot && !is_apex) event += fmt::format(" {}", e.leg + 1);
    row(e.time, event, NameOf(e.mode_after), e.x, e.y, e.vx_after, e.vy_after,
        is_apex ? energy(apex++) : "");
  }
  if (run.final_state.size() >= 4) {
    const std::vector<double>& f = run.final_state;
    row(run.end_time, "end", NameOf(run.final_mode), f[0], f[1], f[2], f[3], "");
  }
  const std::vector<std::string> lines = table.Lines();
  text += Styled(lines.front(), Emphasis::kFaint, colours) + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) text += lines[i] + "\n";
  if (request.law == Law::kLargeDeflection && run.max_deflection_ratio > kMaxDeflectionRatio)
    text += fmt::format("  the leg bends to F C/l0 = {}; beyond {} this law is not to be trusted\n",
                        Significant(run.max_deflection_ratio, 2), kMaxDeflectionRatio);
  return text;
}

std::string SensitivityReport(const std::vector<std::string>& names, const Trajectory& run) {
  using enum TextTable::Align;
  TextTable table({kLeft, kRight, kRight, kRight, kRight});
  table.AddRow({"d end / d", "x", "y", "vx", "vy"});
  for (std::size_t d = 0; d < names.size(); ++d) {
    std::vector<std::string> cells = {names[d]};
    for (std::size_t i = 0; i < 4; ++i)
      cells.push_back(fmt::format("{:.6e}", run.final_sensitivities[i * names.size() + d]));
    table.AddRow(cells);
  }
  std::string text = "\n";
  for (const std::string& line : table.Lines()) text += line + "\n";
  return text;
}

}  // namespace hoplab
