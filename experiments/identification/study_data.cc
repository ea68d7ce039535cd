#include "experiments/identification/study_data.h"

#include "base/units.h"
#include "experiments/study/published_tables.h"

namespace hoplab {
namespace {

constexpr double kGiga = 1e9;

void AddModulusTable(const char* name, double damping, StudyData& data) {
  const PublishedTable& table = FindPublishedTable(name);
  const auto modulus = table.Column("E_GPa"), time = table.Column("convergence_time_s"),
             k_min = table.Column("k_min_N_per_m"), k_max = table.Column("k_max_N_per_m");
  for (std::size_t i = 0; i < modulus.size(); ++i)
    data.modulus.push_back({modulus[i] * kGiga, damping, time[i], k_min[i], k_max[i]});
}

}  // namespace

StudyData PublishedStudyData() {
  constexpr double kDamped = 6.0;  // N s/m
  StudyData data;
  const PublishedTable& energy = FindPublishedTable("table_6_5_energy_percent");
  const auto angle = energy.Column("touchdown_angle_deg"), d = energy.Column("d_Ns_per_m"),
             percent = energy.Column("energy_percent");
  for (std::size_t i = 0; i < angle.size(); ++i)
    data.energy.push_back({DegToRad(angle[i]), d[i], percent[i]});
  AddModulusTable("table_6_3_modulus_d0", 0.0, data);
  AddModulusTable("table_6_4_modulus_d6", kDamped, data);
  const PublishedTable& starts = FindPublishedTable("table_6_2_convergence_d6");
  const auto speed = starts.Column("initial_speed_m_per_s"),
             height = starts.Column("initial_height_m"), time = starts.Column("convergence_time_s");
  for (std::size_t i = 0; i < speed.size(); ++i)
    data.starts.push_back({speed[i], height[i], kDamped, time[i]});
  return data;
}

}  // namespace hoplab
