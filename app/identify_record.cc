#include "app/identify_record.h"

#include <fmt/format.h>

#include <cmath>

#include "app/csv.h"
#include "app/quantity.h"
#include "base/text.h"
#include "base/units.h"

namespace hoplab {
namespace {

const char* WordOf(LiftoffRule rule) {
  return rule == LiftoffRule::kZeroForce ? "zero_force" : "rest_length";
}

Json ReadingRecord(const StudyReading& reading) {
  return {{"variant", VariantRecord(reading.variant)}, {"liftoff", WordOf(reading.liftoff)}};
}

Json ConstantsRecord(const StudyConstants& constants) {
  Json record = Json::object();
  for (int i = 0; i < kStudyConstantCount; ++i) {
    const StudyConstantInfo& info = InfoOf(static_cast<StudyConstant>(i));
    const std::string unit(info.unit);
    record[std::string(info.name)] = {
        {"value", NumberOrNull(constants[static_cast<std::size_t>(i)])}, {"unit", unit}};
  }
  return record;
}

Json ScoresRecord(const StudyScores& s) {
  return {{"table_6_5_rms_points", NumberOrNull(s.energy_rms)},
          {"table_6_5_worst_points", NumberOrNull(s.energy_worst)},
          {"stiffness_rms", NumberOrNull(s.stiffness_rms)},
          {"stiffness_worst", NumberOrNull(s.stiffness_worst)},
          {"table_6_2_converged", s.converged_starts},
          {"table_6_2_rank_correlation", NumberOrNull(s.start_rank_correlation)},
          {"table_6_4_converged", s.converged_moduli},
          {"table_6_4_tau", NumberOrNull(s.modulus_trend)},
          {"convergence_rms_s", NumberOrNull(s.convergence_rms)}};
}

Json FitRecord(const ScoredFit& scored) {
  return {{"reading", ReadingRecord(scored.fit.reading)},
          {"constants", ConstantsRecord(scored.fit.constants)},
          {"misfit", NumberOrNull(scored.fit.misfit)},
          {"scores", ScoresRecord(scored.scores)}};
}

Json DirectionsRecord(const std::vector<StudyConstant>& free,
                      const std::vector<StudyDirection>& directions) {
  Json record = Json::array();
  for (const StudyDirection& d : directions) {
    Json loadings = Json::object();
    for (std::size_t i = 0; i < free.size(); ++i)
      loadings[std::string(InfoOf(free[i]).name)] = d.loadings[i];
    record.push_back({{"strength", NumberOrNull(d.strength)}, {"loadings", loadings}});
  }
  return record;
}

Json DecisionsRecord(const std::vector<PointDecision>& decisions) {
  Json record = Json::array();
  for (const PointDecision& decision : decisions) {
    Json words = Json::array();
    for (const PointDecision::Word& w : decision.words) {
      words.push_back({{"word", w.word},
                       {"table_6_5_misfit", NumberOrNull(w.energy_misfit)},
                       {"all_misfit", NumberOrNull(w.all_misfit)}});
    }
    record.push_back({{"point", decision.point}, {"words", words}});
  }
  return record;
}

void AddReadingCells(const StudyFit& fit, CsvText& table) {
  for (const VariantKey& key : VariantKeys()) table.Cell(key.words[key.get(fit.reading.variant)]);
  table.Cell(WordOf(fit.reading.liftoff));
  for (double constant : fit.constants) table.Cell(constant);
  table.Cell(fit.misfit);
}

}  // namespace

void AddIdentification(const IdentificationRequest& request, const IdentificationResult& result,
                       Json& record) {
  record["best"] = FitRecord(result.by_all.front());
  record["best_on_table_6_5"] = FitRecord(result.best_by_energy);
  record["as_good"] = {{"count", result.as_good},
                       {"low", ConstantsRecord(result.low)},
                       {"high", ConstantsRecord(result.high)}};
  Json others = Json::array();
  for (const ScoredFit& scored : result.by_all) others.push_back(FitRecord(scored));
  record["readings"] = others;
  record["directions"] = {
      {"table_6_5", DirectionsRecord(request.free, result.energy_directions)},
      {"with_stiffness", DirectionsRecord(request.free, result.smooth_directions)}};
  record["decisions"] = DecisionsRecord(result.decisions);
  record["evaluations"] = result.evaluations;
  record["interrupted"] = result.interrupted;
}

std::string ReadingsTable(const IdentificationResult& result) {
  std::vector<std::string> header = {"tables"};
  for (const VariantKey& key : VariantKeys()) header.emplace_back(key.key);
  header.emplace_back("liftoff");
  for (int i = 0; i < kStudyConstantCount; ++i)
    header.emplace_back(InfoOf(static_cast<StudyConstant>(i)).name);
  header.insert(header.end(), {"misfit", "table_6_5_rms_points", "stiffness_worst"});
  CsvText table(header);
  for (const ScoredFit& scored : result.by_all) {
    table.Cell("all");
    AddReadingCells(scored.fit, table);
    table.Cell(scored.scores.energy_rms).Cell(scored.scores.stiffness_worst);
    table.EndRow();
  }
  for (const StudyFit& fit : result.by_energy) {
    table.Cell("6.5");
    AddReadingCells(fit, table);
    table.Cell(kEnergyUnit * std::sqrt(fit.misfit)).Cell(std::nan(""));
    table.EndRow();
  }
  return table.text();
}

std::string NumbersTable(const StudyHopper& best, const StudyData& data) {
  const StudyPredictions ours = PredictionsOf(best, data, {true, true, true});
  CsvText table({"table", "at", "damping_N_s_per_m", "quantity", "printed", "ours"});
  const auto add = [&](const std::string& name, const std::string& at, double damping,
                       const char* quantity, double printed, double found) {
    table.Cell(name).Cell(at).Cell(damping).Cell(quantity).Cell(printed).Cell(found).EndRow();
  };
  for (std::size_t i = 0; i < data.energy.size(); ++i) {
    const EnergyCell& cell = data.energy[i];
    add("6.5", fmt::format("{} deg", Significant(RadToDeg(cell.touchdown_angle_rad), 4)),
        cell.damping_N_s_per_m, "energy_percent", cell.percent, ours.energy[i]);
  }
  for (std::size_t i = 0; i < data.modulus.size(); ++i) {
    const ModulusRow& row = data.modulus[i];
    const ControlledRun& run = ours.modulus[i];
    const std::string name = row.damping_N_s_per_m > 0.0 ? "6.4" : "6.3";
    const std::string at = fmt::format("{} GPa", Significant(row.modulus_Pa * 1e-9, 4));
    const double d = row.damping_N_s_per_m;
    add(name, at, d, "k_min_N_per_m", row.k_min_N_per_m, run.k_min_N_per_m);
    add(name, at, d, "k_max_N_per_m", row.k_max_N_per_m, run.k_max_N_per_m);
    add(name, at, d, "convergence_time_s", row.convergence_time_s, run.convergence.time);
  }
  for (std::size_t i = 0; i < data.starts.size(); ++i) {
    const StartCell& cell = data.starts[i];
    add("6.2",
        fmt::format("{} m/s {} m", Significant(cell.speed_m_per_s, 3),
                    Significant(cell.height_m, 3)),
        cell.damping_N_s_per_m, "convergence_time_s", cell.convergence_time_s,
        ours.starts[i].convergence.time);
  }
  return table.text();
}

std::string ScenarioText(const StudyHopper& best, const std::string& origin) {
  using C = StudyConstant;
  const StudySection section = SectionOf(At(best.constants, C::kBendingStiffness));
  const auto number = [](double value) { return FormatDouble(value); };
  std::string variant;
  for (const VariantKey& key : VariantKeys()) {
    variant += variant.empty() ? "" : ", ";
    variant += fmt::format("{}: {}", key.key, key.words[key.get(best.reading.variant)]);
  }
  const double scale = At(best.constants, C::kDampingScale);
  const double blend = At(best.constants, C::kRollingBlend);
  const std::string effects =
      blend == 0.0 ? std::string()
                   : fmt::format("effects: {{rolling_law: {{blend: {}}}}}\n", number(blend));
  const std::string damping =
      scale == 1.0 ? std::string()
                   : fmt::format("# A printed damping coefficient stands for {} times its value.\n",
                                 number(scale));
  const double toe_mass = At(best.constants, C::kToeMass);
  const StudyPlacement placement = PlacementOf(toe_mass, At(best.constants, C::kRadius));
  const std::string toe = toe_mass == 0.0
                              ? std::string()
                              : fmt::format(
                                    "  toe_mass_kg: {}\n"
                                    "  placement: {{kp_N_m_per_rad: {}, kd_N_m_s_per_rad: {}}}\n",
                                    number(toe_mass), number(placement.kp_N_m_per_rad),
                                    number(placement.kd_N_m_s_per_rad));
  return fmt::format(
      "# The hopper of the published study: law thesis in the reading and with the constants that\n"
      "# do best on its tables 6.2 to 6.5 together. The study prints neither; what is here was "
      "found\n"
      "# by {}\n"
      "# (docs/decisions/0005-study-constants.md says how well it does and what remains open).\n"
      "# Whatever a table or a caption states (E, damping, touch-down angle, start) is set over "
      "this\n"
      "# file; `initial` is the start of table 6.5, whose speed is not printed either. Of the "
      "section\n"
      "# only E I counts: width and G are taken, thickness follows.\n"
      "{}format: hoplab-scenario/1\n"
      "name: published\n"
      "law: thesis\n"
      "mechanism:\n"
      "  type: c_leg\n"
      "  body_mass_kg: {}\n"
      "  gravity_m_per_s2: 9.81\n"
      "  liftoff: {}\n{}"
      "  leg:\n"
      "    rest_radius_m: {}\n"
      "    E_Pa: 22e9\n"
      "    G_Pa: 4e9\n"
      "    width_m: {}\n"
      "    thickness_m: {}\n"
      "    damping_N_s_per_m: 0\n"
      "    variant: {{{}}}\n"
      "controller: {{kp_N_s: {}, v_des_m_per_s: 1.8}}\n"
      "touchdown_angle_deg: 40\n"
      "initial: {{x_m: 0, y_m: 0.30, vx_m_per_s: {}, vy_m_per_s: 0}}\n"
      "stop: {{time_s: 15}}\n{}",
      origin, damping, number(At(best.constants, C::kMass)), WordOf(best.reading.liftoff), toe,
      number(At(best.constants, C::kRadius)), number(section.width_m), number(section.thickness_m),
      variant, number(At(best.constants, C::kGain)), number(At(best.constants, C::kStartSpeed)),
      effects);
}

}  // namespace hoplab
