#include "experiments/study/study_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "experiments/study/agreement.h"
#include "experiments/study/published_tables.h"

namespace hoplab {
namespace {

constexpr double kTouchdownAngle = DegToRad(40.0);  // of tables 6.1 to 6.4
constexpr double kStanceStep = 1e-3;                // s

// How far apart a printed number and ours may be: about a hop, since convergence is seen at apexes;
// and the bounds this project sets itself for stiffness and energy.
constexpr double kTimeTolerance = 0.5;        // s; of damped tables the whole one's, too
constexpr double kStiffnessTolerance = 0.05;  // of the printed number
constexpr double kEnergyTolerance = 0.5;      // percentage points, one number
constexpr double kEnergyRms = 0.3;            // percentage points, the whole table
// Spearman; undamped times are those of a slow drift into a narrow band.
constexpr double kDampedRank = 0.7, kUndampedRank = 0.5;
constexpr double kSignificance = 0.05;

CaptionSettings Controlled(double damping) {
  return {.touchdown_angle_rad = kTouchdownAngle, .damping_N_s_per_m = damping, .controlled = true};
}

std::vector<StudyNumber> SettingsOf(const CaptionSettings& s) {
  return {{"touchdown_angle", s.touchdown_angle_rad, "rad"},
          {"damping", s.damping_N_s_per_m, "N s/m"},
          {"v_des", s.v_des_m_per_s, "m/s"}};
}

double CountFinite(const std::vector<double>& values) {
  return static_cast<double>(
      std::count_if(values.begin(), values.end(), [](double v) { return std::isfinite(v); }));
}

void AddAgreement(const std::string& quantity, const std::string& unit,
                  const std::vector<double>& published, const std::vector<double>& ours,
                  StudyTable& table) {
  const Agreement agreement = AgreementOf(published, ours);
  table.statistics.push_back({quantity + "_rms_difference", agreement.rms, unit});
  table.statistics.push_back({quantity + "_max_difference", agreement.max_abs, unit});
  table.statistics.push_back({quantity + "_mean_difference", agreement.mean, unit});
  table.statistics.push_back(
      {quantity + "_rank_correlation", RankCorrelation(published, ours), ""});
}

StudyCheck AllConverge(const std::vector<double>& published, const std::vector<double>& ours) {
  double converged = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i)
    converged += std::isfinite(published[i]) && std::isfinite(ours[i]) ? 1.0 : 0.0;
  const double all = CountFinite(published);
  return {"every run converges that does in print",
          converged == all,
          {{"converged", converged, ""}, {"of", all, ""}}};
}

StudyCheck RanksAgree(const std::vector<double>& published, const std::vector<double>& ours,
                      double bound) {
  const double rank = RankCorrelation(published, ours);
  return {fmt::format("convergence times rank as published (Spearman at least {:g})", bound),
          rank >= bound,
          {{"rank_correlation", rank, ""}}};
}

StudyCheck TimesAgree(const std::vector<double>& published, const std::vector<double>& ours) {
  const double rms = AgreementOf(published, ours).rms;
  return {
      "convergence times are those printed, 0.5 s rms", rms <= kTimeTolerance, {{"rms", rms, "s"}}};
}

StudyCheck RisesWith(const std::string& what, const std::vector<double>& modulus,
                     const std::vector<double>& values) {
  const Trend trend = TrendOf(modulus, values);
  return {what + " grows with E (Kendall's tau, p below 0.05)",
          trend.tau > 0.0 && trend.p_value < kSignificance,
          {{"tau", trend.tau, ""}, {"p_value", trend.p_value, ""}}};
}

StudyCheck StiffnessAgrees(const std::vector<ComparedNumber>& numbers) {
  double count = 0.0, agree = 0.0, worst = 0.0;
  for (const ComparedNumber& number : numbers) {
    if (number.unit != "N/m" || std::isnan(number.published)) continue;
    count += 1.0;
    agree += number.agrees() ? 1.0 : 0.0;
    // fmax passes over a NaN; that number does not agree, which is counted.
    worst = std::fmax(worst, std::abs(number.ours / number.published - 1.0));
  }
  return {"every stiffness lies within 5 % of the printed one",
          agree == count,
          {{"within", agree, ""}, {"of", count, ""}, {"worst", 100.0 * worst, "%"}}};
}

}  // namespace

StartGrid RunStartGrid(const Study& study, double damping_N_s_per_m) {
  const PublishedTable& published = FindPublishedTable(
      damping_N_s_per_m == 0.0 ? "table_6_1_convergence_d0" : "table_6_2_convergence_d6");
  StartGrid grid;
  grid.speeds = published.Column("initial_speed_m_per_s");
  grid.heights = published.Column("initial_height_m");
  grid.published_time = published.Column("convergence_time_s");
  for (std::size_t i = 0; i < grid.speeds.size(); ++i) {
    CaptionSettings settings = Controlled(damping_N_s_per_m);
    settings.start_speed_m_per_s = grid.speeds[i];
    settings.start_height_m = grid.heights[i];
    const ConvergenceTime c = ConvergenceOf(RunHopping(HopperOfCaption(study, settings), 0.0));
    grid.time.push_back(c.time);
    grid.band_percent.push_back(c.band == ConvergenceTime::Band::kOnePercent   ? 1.0
                                : c.band == ConvergenceTime::Band::kTwoPercent ? 2.0
                                                                               : std::nan(""));
    grid.steady_speed.push_back(c.steady_speed);
  }
  return grid;
}

StudyTable StartTable(const std::string& name, const Study& study, double damping_N_s_per_m) {
  const StartGrid grid = RunStartGrid(study, damping_N_s_per_m);
  StudyTable table;
  table.name = name;
  table.title =
      "Convergence time over 25 starts, d = " + std::string(damping_N_s_per_m == 0.0 ? "0" : "6") +
      " N s/m";
  table.settings = SettingsOf(Controlled(damping_N_s_per_m));
  table.columns = {{"start_speed_m_per_s", "start speed", "m/s"},
                   {"start_height_m", "start height", "m"},
                   {"published_time_s", "published convergence time", "s"},
                   {"time_s", "convergence time", "s"},
                   {"band_percent", "band", "%"},
                   {"steady_speed_m_per_s", "steady speed", "m/s"}};
  for (std::size_t i = 0; i < grid.speeds.size(); ++i) {
    table.rows.push_back({grid.speeds[i], grid.heights[i], grid.published_time[i], grid.time[i],
                          grid.band_percent[i], grid.steady_speed[i]});
    table.numbers.push_back(
        {{{"start_speed", grid.speeds[i], "m/s"}, {"start_height", grid.heights[i], "m"}},
         "convergence_time",
         "s",
         grid.published_time[i],
         grid.time[i],
         kTimeTolerance});
  }
  AddAgreement("convergence_time", "s", grid.published_time, grid.time, table);
  table.statistics.push_back({"converged", CountFinite(grid.time), ""});
  const bool damped = damping_N_s_per_m > 0.0;
  table.checks = {AllConverge(grid.published_time, grid.time),
                  RanksAgree(grid.published_time, grid.time, damped ? kDampedRank : kUndampedRank)};
  if (damped) table.checks.push_back(TimesAgree(grid.published_time, grid.time));
  table.verdict = VerdictOf(table.checks, {});
  return table;
}

ModulusSweep RunModulusSweep(const Study& study, double damping_N_s_per_m) {
  const PublishedTable& published = FindPublishedTable(
      damping_N_s_per_m == 0.0 ? "table_6_3_modulus_d0" : "table_6_4_modulus_d6");
  ModulusSweep sweep;
  sweep.modulus_GPa = published.Column("E_GPa");
  sweep.published_time = published.Column("convergence_time_s");
  sweep.published_min = published.Column("k_min_N_per_m");
  sweep.published_max = published.Column("k_max_N_per_m");
  for (const double modulus : sweep.modulus_GPa) {
    CaptionSettings settings = Controlled(damping_N_s_per_m);
    settings.modulus_Pa = 1e9 * modulus;
    const HoppingRun run = RunHopping(HopperOfCaption(study, settings), kStanceStep);
    sweep.time.push_back(ConvergenceOf(run).time);
    const StiffnessRange range = SteadyStiffness(run);
    sweep.stiffness_min.push_back(range.min_N_per_m);
    sweep.stiffness_max.push_back(range.max_N_per_m);
  }
  return sweep;
}

StudyTable ModulusTable(const std::string& name, const Study& study, double damping_N_s_per_m) {
  const bool damped = damping_N_s_per_m > 0.0;
  const ModulusSweep sweep = RunModulusSweep(study, damping_N_s_per_m);
  StudyTable table;
  table.name = name;
  table.title = "Convergence time and steady range of stiffness over E, d = " +
                std::string(damped ? "6" : "0") + " N s/m";
  table.settings = SettingsOf(Controlled(damping_N_s_per_m));
  table.columns = {{"E_GPa", "Young's modulus", "GPa"},
                   {"published_time_s", "published convergence time", "s"},
                   {"time_s", "convergence time", "s"},
                   {"published_k_min_N_per_m", "published least stiffness", "N/m"},
                   {"k_min_N_per_m", "least stiffness", "N/m"},
                   {"published_k_max_N_per_m", "published greatest stiffness", "N/m"},
                   {"k_max_N_per_m", "greatest stiffness", "N/m"}};
  for (std::size_t i = 0; i < sweep.modulus_GPa.size(); ++i) {
    table.rows.push_back({sweep.modulus_GPa[i], sweep.published_time[i], sweep.time[i],
                          sweep.published_min[i], sweep.stiffness_min[i], sweep.published_max[i],
                          sweep.stiffness_max[i]});
    const std::vector<StudyNumber> at = {{"E", 1e9 * sweep.modulus_GPa[i], "Pa"}};
    table.numbers.push_back(
        {at, "convergence_time", "s", sweep.published_time[i], sweep.time[i], kTimeTolerance});
    if (std::isnan(sweep.published_min[i])) continue;  // no convergence was printed, hence no range
    table.numbers.push_back({at, "k_min", "N/m", sweep.published_min[i], sweep.stiffness_min[i],
                             kStiffnessTolerance * sweep.published_min[i]});
    table.numbers.push_back({at, "k_max", "N/m", sweep.published_max[i], sweep.stiffness_max[i],
                             kStiffnessTolerance * sweep.published_max[i]});
  }
  AddAgreement("convergence_time", "s", sweep.published_time, sweep.time, table);
  AddAgreement("k_min", "N/m", sweep.published_min, sweep.stiffness_min, table);
  AddAgreement("k_max", "N/m", sweep.published_max, sweep.stiffness_max, table);
  table.checks = {StiffnessAgrees(table.numbers),
                  RisesWith("the least stiffness", sweep.modulus_GPa, sweep.stiffness_min),
                  RisesWith("the greatest stiffness", sweep.modulus_GPa, sweep.stiffness_max),
                  AllConverge(sweep.published_time, sweep.time)};
  if (!damped) table.checks.push_back(RanksAgree(sweep.published_time, sweep.time, kUndampedRank));
  if (damped) {
    const Trend trend = TrendOf(sweep.modulus_GPa, sweep.time);
    table.checks.push_back(TimesAgree(sweep.published_time, sweep.time));
    table.checks.push_back({"convergence time falls with E (Kendall's tau, p below 0.05)",
                            trend.tau < 0.0 && trend.p_value < kSignificance,
                            {{"tau", trend.tau, ""}, {"p_value", trend.p_value, ""}}});
  }
  table.verdict = VerdictOf(table.checks, {});
  return table;
}

double EnergyPercent(const Study& study, double touchdown_angle_rad, double damping_N_s_per_m) {
  const StateSpec& start = RequireInitial(study.constants);
  const CaptionSettings settings{.start_height_m = start.y_m,
                                 .start_speed_m_per_s = start.vx_m_per_s,
                                 .touchdown_angle_rad = touchdown_angle_rad,
                                 .damping_N_s_per_m = damping_N_s_per_m,
                                 .time_limit_s = 5.0,
                                 .hops = 1};
  const HoppingRun run = RunHopping(HopperOfCaption(study, settings), 0.0);
  if (run.hops < 1) return std::nan("");
  return 100.0 * run.apexes.back().energy_J / run.apexes.front().energy_J;
}

EnergyGrid RunEnergyGrid(const Study& study) {
  const PublishedTable& published = FindPublishedTable("table_6_5_energy_percent");
  EnergyGrid grid;
  grid.angle_deg = published.Column("touchdown_angle_deg");
  grid.damping = published.Column("d_Ns_per_m");
  grid.published_percent = published.Column("energy_percent");
  for (std::size_t i = 0; i < grid.angle_deg.size(); ++i)
    grid.percent.push_back(EnergyPercent(study, DegToRad(grid.angle_deg[i]), grid.damping[i]));
  return grid;
}

StudyTable EnergyTable(const Study& study) {
  const EnergyGrid grid = RunEnergyGrid(study);
  StudyTable table;
  table.name = "table-6.5";
  table.title = "Energy after one undriven jump, over touch-down angle and damping";
  const StateSpec& start = RequireInitial(study.constants);
  table.settings = {{"start_height", start.y_m, "m"}, {"start_speed", start.vx_m_per_s, "m/s"}};
  table.columns = {{"touchdown_angle_deg", "touch-down angle", "deg"},
                   {"damping_N_s_per_m", "damping", "N s/m"},
                   {"published_energy_percent", "published energy", "%"},
                   {"energy_percent", "energy", "%"}};
  for (std::size_t i = 0; i < grid.angle_deg.size(); ++i) {
    table.rows.push_back(
        {grid.angle_deg[i], grid.damping[i], grid.published_percent[i], grid.percent[i]});
    table.numbers.push_back({{{"touchdown_angle", DegToRad(grid.angle_deg[i]), "rad"},
                              {"damping", grid.damping[i], "N s/m"}},
                             "energy",
                             "%",
                             grid.published_percent[i],
                             grid.percent[i],
                             kEnergyTolerance});
  }
  AddAgreement("energy", "% points", grid.published_percent, grid.percent, table);
  const Agreement agreement = AgreementOf(grid.published_percent, grid.percent);
  const auto cells = static_cast<int>(grid.percent.size());
  table.checks = {{"every jump reaches its next apex",
                   agreement.pairs == cells,
                   {{"jumps", static_cast<double>(agreement.pairs), ""}}},
                  {"rms difference below 0.3 percentage points",
                   agreement.rms < kEnergyRms,
                   {{"rms", agreement.rms, "% points"}}}};
  table.verdict = VerdictOf(table.checks, {});
  return table;
}

}  // namespace hoplab
