#include "experiments/identification/study_data.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/units.h"
#include "experiments/study/published_tables.h"

namespace hoplab {
namespace {

constexpr double kGiga = 1e9;
constexpr double kDamped = 6.0;  // N s/m

void AddModulusTable(const char* name, double damping, StudyData& data) {
  const PublishedTable& table = FindPublishedTable(name);
  const auto modulus = table.Column("E_GPa"), time = table.Column("convergence_time_s"),
             k_min = table.Column("k_min_N_per_m"), k_max = table.Column("k_max_N_per_m");
  for (std::size_t i = 0; i < modulus.size(); ++i)
    data.modulus.push_back({modulus[i] * kGiga, damping, time[i], k_min[i], k_max[i]});
}

void AddStartTable(const char* name, double damping, StudyData& data) {
  const PublishedTable& table = FindPublishedTable(name);
  const auto speed = table.Column("initial_speed_m_per_s"),
             height = table.Column("initial_height_m"), time = table.Column("convergence_time_s");
  for (std::size_t i = 0; i < speed.size(); ++i)
    data.initial_states.push_back({speed[i], height[i], damping, time[i]});
}

}  // namespace

std::string_view NameOf(StudyTableId table) {
  static constexpr std::array<std::string_view, kStudyTableCount> kNames = {"6.1", "6.2", "6.3",
                                                                            "6.4", "6.5"};
  return kNames[static_cast<std::size_t>(table)];
}

StudyTableId TableOf(const StartCell& cell) {
  return cell.damping_N_s_per_m > 0.0 ? StudyTableId::k62 : StudyTableId::k61;
}
StudyTableId TableOf(const ModulusRow& row) {
  return row.damping_N_s_per_m > 0.0 ? StudyTableId::k64 : StudyTableId::k63;
}

StudyData PublishedStudyData() {
  StudyData data;
  const PublishedTable& energy = FindPublishedTable("table_6_5_energy_percent");
  const auto angle = energy.Column("touchdown_angle_deg"), d = energy.Column("d_Ns_per_m"),
             percent = energy.Column("energy_percent");
  for (std::size_t i = 0; i < angle.size(); ++i)
    data.energy.push_back({DegToRad(angle[i]), d[i], percent[i]});
  AddModulusTable("table_6_3_modulus_d0", 0.0, data);
  AddModulusTable("table_6_4_modulus_d6", kDamped, data);
  AddStartTable("table_6_1_convergence_d0", 0.0, data);
  AddStartTable("table_6_2_convergence_d6", kDamped, data);
  return data;
}

StudyData OnlyTables(const StudyData& data, const std::vector<StudyTableId>& tables) {
  const auto has = [&](StudyTableId table) {
    return std::find(tables.begin(), tables.end(), table) != tables.end();
  };
  StudyData kept;
  if (has(StudyTableId::k65)) kept.energy = data.energy;
  const auto is_kept = [&](const auto& row) { return has(TableOf(row)); };
  std::copy_if(data.modulus.begin(), data.modulus.end(), std::back_inserter(kept.modulus), is_kept);
  std::copy_if(data.initial_states.begin(), data.initial_states.end(),
               std::back_inserter(kept.initial_states), is_kept);
  return kept;
}

std::vector<ModulusRow> RowsForRanges(const std::vector<ModulusRow>& rows) {
  std::vector<ModulusRow> chosen;
  for (const ModulusRow& row : rows) {
    const bool is_greatest = std::none_of(rows.begin(), rows.end(), [&](const ModulusRow& other) {
      return other.damping_N_s_per_m == row.damping_N_s_per_m && !std::isnan(other.k_min_N_per_m) &&
             other.modulus_Pa > row.modulus_Pa;
    });
    if (is_greatest && !std::isnan(row.k_min_N_per_m)) chosen.push_back(row);
  }
  return chosen;
}

}  // namespace hoplab
