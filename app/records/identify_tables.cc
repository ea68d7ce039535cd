#include <fmt/format.h>

#include <cmath>

#include "app/records/csv.h"
#include "app/records/identify_record.h"
#include "base/text.h"

namespace hoplab {
namespace {

using C = StudyConstant;

void AddConstantNames(std::vector<std::string>& header) {
  for (int i = 0; i < kStudyConstantCount; ++i) header.emplace_back(InfoOf(static_cast<C>(i)).name);
}

void AddPartNames(std::vector<std::string>& header) {
  for (int i = 0; i < kStudyPartCount; ++i)
    header.push_back(std::string(NameOf(static_cast<StudyPart>(i))) + "_misfit");
}

void AddParts(const StudyFit& fit, CsvText& table) {
  for (const double part : fit.parts.parts) table.Cell(part);
  table.Cell(fit.misfit);
}

// Every fit: its reading, its constants, what it was fitted to and how well it does there.
std::string ReadingsTable(const IdentificationResult& result) {
  std::vector<std::string> header = {"tables"};
  for (const ReadingKey& key : ReadingKeys()) header.emplace_back(key.key);
  header.emplace_back("liftoff");
  AddConstantNames(header);
  AddPartNames(header);
  header.emplace_back("misfit");
  CsvText table(header);
  const auto add = [&](const char* tables, const StudyFit& fit) {
    table.Cell(tables);
    for (const ReadingKey& key : ReadingKeys())
      table.Cell(key.words[static_cast<std::size_t>(key.get(fit.reading.law))]);
    table.Cell(NameOf(fit.reading.liftoff));
    for (const double constant : fit.constants) table.Cell(constant);
    AddParts(fit, table);
    table.EndRow();
  };
  for (const ScoredFit& scored : result.by_all) add("all", scored.fit);
  for (const StudyFit& fit : result.by_steady) add("steady", fit);
  for (const StudyFit& fit : result.by_energy) add("6.5", fit);
  return table.text();
}

std::string FrontTable(const IdentificationResult& result) {
  std::vector<std::string> header = {"name"};
  AddConstantNames(header);
  AddPartNames(header);
  header.insert(header.end(),
                {"misfit", "table_6_5_rms_points", "stiffness_worst", "stiffness_rms"});
  for (const char* number : {"6_1", "6_2", "6_3", "6_4"}) {
    header.push_back(fmt::format("table_{}_time_rms_s", number));
    header.push_back(fmt::format("table_{}_rank_correlation", number));
  }
  CsvText table(header);
  for (const FrontPoint& point : result.front) {
    table.Cell(point.name);
    for (const double constant : point.fit.fit.constants) table.Cell(constant);
    AddParts(point.fit.fit, table);
    const StudyScores& s = point.fit.scores;
    table.Cell(s.energy_rms).Cell(s.stiffness_worst).Cell(s.stiffness_rms);
    for (const TimeScores& t : s.times) table.Cell(t.rms_s).Cell(t.rank_correlation);
    table.EndRow();
  }
  return table.text();
}

std::string TimesTable(const IdentificationResult& result) {
  CsvText table({"reading", "damped_misfit", "undamped_misfit", "table_6_2_converged",
                 "table_6_2_time_rms_s", "table_6_2_rank_correlation"});
  for (const ReadingOfTimes& t : result.times)
    table.Cell(NameOf(t.reading))
        .Cell(t.damped_misfit)
        .Cell(t.undamped_misfit)
        .Cell(t.damped_initial_states.converged)
        .Cell(t.damped_initial_states.rms_s)
        .Cell(t.damped_initial_states.rank_correlation)
        .EndRow();
  return table.text();
}

std::string CellsTable(const IdentificationResult& result) {
  CsvText table({"table", "at", "quantity", "unit", "printed", "ours", "share_of_misfit"});
  for (const PullingCell& cell : result.cells)
    table.Cell(NameOf(cell.table))
        .Cell(cell.at)
        .Cell(cell.quantity)
        .Cell(cell.unit)
        .Cell(cell.printed)
        .Cell(cell.ours)
        .Cell(cell.share)
        .EndRow();
  return table.text();
}

std::string Number(double value) { return FormatDouble(value); }

// Lines that are there only where they say something.
std::string ToeLines(const StudyConstants& constants) {
  const double toe_mass = At(constants, C::kToeMass);
  if (toe_mass == 0.0) return "";
  const StudyPlacement placement = PlacementOf(constants);
  return fmt::format(
      "  toe_mass_kg: {}\n"
      "  placement: {{kp_N_m_per_rad: {}, kd_N_m_s_per_rad: {}}}\n",
      Number(toe_mass), Number(placement.kp_N_m_per_rad), Number(placement.kd_N_m_s_per_rad));
}
std::string EffectLines(const StudyConstants& constants) {
  const double blend = At(constants, C::kRollingBlend);
  if (blend == 0.0) return "";
  return fmt::format("effects: {{rolling_law: {{blend: {}}}}}\n", Number(blend));
}
std::string DampingLines(const StudyConstants& constants) {
  const double scale = At(constants, C::kDampingScale);
  if (scale == 1.0) return "";
  return fmt::format("# A printed damping coefficient stands for {} times its value.\n",
                     Number(scale));
}

}  // namespace

std::map<std::string, std::string> IdentificationTables(const IdentificationResult& result) {
  return {{"readings.csv", ReadingsTable(result)},
          {"front.csv", FrontTable(result)},
          {"times.csv", TimesTable(result)},
          {"cells.csv", CellsTable(result)}};
}

std::string ScenarioText(const StudyFit& fit, const std::string& name, const std::string& origin) {
  constexpr double kControlledAngle = 40.0;  // deg, of the captions
  const StudyConstants& constants = fit.constants;
  const StudySection section = SectionOf(At(constants, C::kBendingStiffness));
  std::string reading;
  for (const ReadingKey& key : ReadingKeys()) {
    reading += reading.empty() ? "" : ", ";
    reading += fmt::format("{}: {}", key.key,
                           key.words[static_cast<std::size_t>(key.get(fit.reading.law))]);
  }
  return fmt::format(
      "# The hopper of the published study: law thesis, in the reading and with the constants "
      "that\n"
      "# do best on its tables. The study prints neither; what is here was found by\n"
      "# {}\n"
      "# (docs/decisions/0005-study-constants.md says how well it does and what remains open).\n"
      "# Whatever a table or a caption states (E, damping, leg angle, start) is set over this "
      "file;\n"
      "# later landings are at the share touchdown_angle_deg/start_angle_deg of a caption's "
      "angle;\n"
      "# `initial` is the start of table 6.5, whose speed is not printed either. Of the section\n"
      "# only E I counts: width and G are taken, thickness follows.\n"
      "{}format: hoplab-scenario/1\n"
      "name: {}\n"
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
      "controller: {{kp_N_s: {}, v_des_m_per_s: {}}}\n"
      "start_angle_deg: {}\n"
      "touchdown_angle_deg: {}\n"
      "initial: {{x_m: 0, y_m: 0.30, vx_m_per_s: {}, vy_m_per_s: 0}}\n"
      "stop: {{time_s: 15}}\n{}",
      origin, DampingLines(constants), name, Number(At(constants, C::kMass)),
      NameOf(fit.reading.liftoff), ToeLines(constants), Number(At(constants, C::kRadius)),
      Number(section.width_m), Number(section.thickness_m), reading,
      Number(At(constants, C::kGain)), Number(At(constants, C::kDesiredSpeed)),
      Number(kControlledAngle), Number(kControlledAngle * At(constants, C::kPlacedShare)),
      Number(At(constants, C::kStartSpeed)), EffectLines(constants));
}

}  // namespace hoplab
