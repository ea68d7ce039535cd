#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/records/sweep_record.h"
#include "app/reports/headline_parts.h"
#include "app/terminal/quantity.h"
#include "base/text.h"

namespace hoplab {
namespace {

std::string HowItDecays(double radius, const char* turn) {
  return fmt::format(
      " and is stable: a disturbance keeps {} % of its size from {} to "
      "{}, once the slowest part of it is left.",
      Significant(100.0 * radius, 3), turn, turn);
}

// Of a robot's stride.
void StrideHeadline(const Json& record, Headline& out) {
  const double radius = NumberAt(record, "/spectral_radius");
  const std::string kind = TextAt(record, "/stride/kind");
  if (kind.empty()) {
    out.sentence = "No steady stride was found near the robot's run.";
    return;
  }
  out.sentence = fmt::format("The robot's steady stride is a {} at {} m/s", kind,
                             Significant(NumberAt(record, "/stride/speed_m_per_s"), 3));
  out.sentence += JsonAt(record, "/stable") == Json(true)
                      ? HowItDecays(radius, "stride")
                      : " and is unstable: a disturbance grows.";
  out.figures.push_back(Figure(record, "spectral radius", "/spectral_radius", ""));
  out.figures.back().note = "stable below 1";
  out.figures.push_back(Figure(record, "speed", "/stride/speed_m_per_s", "m/s"));
  out.figures.push_back(Figure(record, "cost of transport", "/stride/cost_of_transport", ""));
  out.figures.back().note = "work of the motors over weight times way";
}

// "touchdown_angle = 23.04 deg" of touchdown_angle_deg.
std::string SettingText(const std::string& key, const Json& value) {
  const std::string unit = UnitOfKey(key), name = key.substr(key.rfind('.') + 1);
  const std::string number = value.is_number() ? Significant(value.get<double>(), 4) : kNotComputed;
  if (unit.empty()) return name + " = " + number;
  std::string suffix = "_" + unit;
  std::replace(suffix.begin(), suffix.end(), ' ', '_');
  return (name.ends_with(suffix) ? name.substr(0, name.size() - suffix.size()) : name) + " = " +
         number + " " + unit;
}

}  // namespace

void GaitHeadline(const Json& record, Headline& out) {
  if (record.contains("stride")) {
    StrideHeadline(record, out);
    return;
  }
  const double speed = NumberAt(record, "/fixed_point/vx_m_per_s");
  const double height = NumberAt(record, "/fixed_point/y_m");
  const double radius = NumberAt(record, "/spectral_radius");
  const bool stable = JsonAt(record, "/stable") == Json(true);
  const bool neutral = JsonAt(record, "/conserves_energy") == Json(true);
  out.sentence = fmt::format("The steady hop goes {} m/s with its apex at {} m",
                             Significant(speed, 3), Significant(height, 3));
  if (neutral)
    out.sentence += "; energy is conserved, so a change of it stays.";
  else if (stable)
    out.sentence += HowItDecays(radius, "hop");
  else
    out.sentence += " and is unstable: a disturbance grows.";
  out.figures.push_back(Figure(record, "spectral radius", "/spectral_radius", ""));
  out.figures.back().note = neutral ? "1 is the energy's" : "stable below 1";
  out.figures.push_back(Figure(record, "speed at apex", "/fixed_point/vx_m_per_s", "m/s"));
  out.figures.push_back(Figure(record, "hops into 1 % of it", "/predicted_hops", ""));
  out.figures.back().note = "from the scenario's start";
}

void OptimizeHeadline(const Json& record, Headline& out) {
  std::vector<std::string> values;
  for (const auto& [name, value] : JsonAt(record, "/best/parameters").items())
    values.push_back(SettingText(name, value));
  const double settle = NumberAt(record, "/best/convergence_time_s");
  const double before = NumberAt(record, "/before/convergence_time_s");
  out.sentence = "Best found: " + Listed(values);
  if (!std::isnan(settle))
    out.sentence += fmt::format(", which settles after {} s (before: {})", Significant(settle, 3),
                                std::isnan(before) ? "not at all" : Significant(before, 3) + " s");
  out.sentence += ".";
  if (!std::isnan(settle))
    out.figures.push_back(Figure(record, "convergence time", "/best/convergence_time_s", "s"));
  else
    out.figures.push_back(Figure(record, "objective", "/best/objective", ""));
  out.figures.push_back(Figure(record, "spectral radius", "/best/spectral_radius", ""));
  const double radius = NumberAt(record, "/before/spectral_radius");
  out.figures.back().note = std::isnan(radius) ? "before: " + std::string(kNotComputed)
                                               : "before: " + Significant(radius, 4);
  out.figures.push_back(Figure(record, "seeds that agree", "/agreeing_seeds", ""));
  out.figures.back().note = "of " + std::to_string(SizeAt(record, "/seeds"));
}

void SweepHeadline(const Json& record, Headline& out) {
  const Json& columns = JsonAt(record, "/columns");
  std::size_t outcome = columns.size();
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (TextAt(columns[c], "/name") == "outcome") outcome = c;
  }
  std::size_t completed = 0;
  const Json& rows = JsonAt(record, "/rows");
  for (const Json& row : rows) {
    // A row without a reason reached its end.
    if (row.is_array() && outcome + 1 < row.size() && row[outcome + 1].is_null()) ++completed;
  }
  out.sentence = fmt::format("{} of {} runs reached their end{}.", completed, rows.size(),
                             completed < rows.size() ? "; the others say why they did not" : "");
  out.figures.push_back(CountFigure("runs", std::to_string(rows.size()), "/rows"));
  out.figures.push_back(CountFigure("reached their end", std::to_string(completed), "/rows"));
  out.figures.push_back(Figure(record, "computed in", "/seconds", "s", 3));
}

void SimulationHeadline(const Json& record, Headline& out) {
  const std::string end = Significant(NumberAt(record, "/end_time_s"), 4);
  out.sentence =
      TextAt(record, "/law") == NameOf(Law::kRobot)
          ? fmt::format("The robot {}, {} s.", TextAt(record, "/outcome_sentence"), end)
          : fmt::format("The hopper {}: {} hops in {} s.", TextAt(record, "/outcome_sentence"),
                        JsonAt(record, "/hops").dump(), end);
  out.figures.push_back(Figure(record, "hops", "/hops", ""));
  out.figures.push_back(Figure(record, "ended at", "/end_time_s", "s"));
  const std::size_t apexes = SizeAt(record, "/apex_energies");
  if (apexes == 0) return;
  out.figures.push_back(Figure(record, "energy at the last apex",
                               fmt::format("/apex_energies/{}/energy_J", apexes - 1), "J"));
  const double first = NumberAt(record, "/apex_energies/0/energy_J");
  out.figures.back().note = Significant(first, 4) + " J at the start";
}

}  // namespace hoplab
