#include "app/records/reproduction_record.h"

#include "app/records/csv.h"
#include "app/records/solver_record.h"
#include "base/text.h"

namespace hoplab {
namespace {

constexpr const char* kSeriesColumn = "series";

std::string FileOf(const std::string& item) { return item + ".csv"; }

Json NumbersRecord(const std::vector<StudyNumber>& numbers) {
  Json out = Json::array();
  for (const StudyNumber& n : numbers)
    out.push_back({{"name", n.name}, {"value", NumberOrNull(n.value)}, {"unit", n.unit}});
  return out;
}

Json ColumnsRecord(const std::vector<StudyColumn>& columns) {
  Json out = Json::array();
  for (const StudyColumn& c : columns)
    out.push_back({{"name", c.name}, {"label", c.label}, {"unit", c.unit}});
  return out;
}

Json ChecksRecord(const std::vector<StudyCheck>& checks) {
  Json out = Json::array();
  for (const StudyCheck& check : checks)
    out.push_back({{"statement", check.statement},
                   {"holds", check.holds},
                   {"numbers", NumbersRecord(check.numbers)}});
  return out;
}

Json SettingsRecord(const std::optional<CaptionSettings>& settings) {
  if (!settings) return nullptr;
  const CaptionSettings& s = *settings;
  Json out = {{"start_height_m", s.start_height_m},
              {"start_speed_m_per_s", s.start_speed_m_per_s},
              {"touchdown_angle_rad", s.touchdown_angle_rad},
              {"damping_N_s_per_m", s.damping_N_s_per_m},
              {"E_Pa", s.straight ? Json(nullptr) : Json(s.modulus_Pa)},
              {"v_des_m_per_s", s.controlled ? Json(s.v_des_m_per_s) : Json(nullptr)}};
  out["straight_leg"] = nullptr;
  if (s.straight)
    out["straight_leg"] = {{"k_N_per_m", s.straight->stiffness_N_per_m},
                           {"l0_m", s.straight->rest_length_m}};
  return out;
}

Json TableRecord(const StudyTable& table) {
  return {{"name", table.name},
          {"title", table.title},
          {"file", FileOf(table.name)},
          {"settings", NumbersRecord(table.settings)},
          {"columns", ColumnsRecord(table.columns)},
          {"checks", ChecksRecord(table.checks)},
          {"verdict", NameOf(table.verdict)}};
}

// What a plot of it needs beside its CSV.
Json FigureRecord(const StudyFigure& figure) {
  const bool lines = figure.kind == StudyFigure::Kind::kLines;
  Json curves = Json::array();
  for (const StudyCurve& curve : figure.curves)
    curves.push_back({{"label", curve.label},
                      {"settings", SettingsRecord(curve.settings)},
                      {"outcome", curve.outcome.empty() ? Json(nullptr) : Json(curve.outcome)},
                      {"end_time_s", NumberOrNull(curve.end_time_s)}});
  return {{"name", figure.name},
          {"title", figure.title},
          {"file", FileOf(figure.name)},
          {"kind", lines ? "lines" : "surface"},
          {"series_column", lines ? Json(kSeriesColumn) : Json(nullptr)},
          {"columns", ColumnsRecord(figure.columns)},
          {"series", curves},
          {"numbers", NumbersRecord(figure.numbers)}};
}

Json ClaimRecord(const StudyClaim& claim) {
  Json alternatives = Json::array();
  for (const ClaimAlternative& other : claim.alternatives)
    alternatives.push_back({{"setting", other.setting}, {"holds", other.holds}});
  return {{"name", claim.name},
          {"statement", claim.statement},
          {"verdict", NameOf(claim.verdict)},
          {"checks", ChecksRecord(claim.checks)},
          {"alternatives", alternatives},
          {"remark", claim.remark},
          {"numbers", NumbersRecord(claim.numbers)},
          {"file", claim.rows.empty() ? Json(nullptr) : Json(FileOf(claim.name))},
          {"columns", ColumnsRecord(claim.columns)}};
}

Json ComparedRecord(const StudyTable& table, const ComparedNumber& number) {
  return {{"table", table.name},
          {"at", NumbersRecord(number.at)},
          {"quantity", number.quantity},
          {"unit", number.unit},
          {"published", NumberOrNull(number.published)},
          {"ours", NumberOrNull(number.ours)},
          {"tolerance", number.tolerance},
          {"agrees", number.agrees()}};
}

std::vector<std::string> HeaderOf(const std::vector<StudyColumn>& columns) {
  std::vector<std::string> header;
  for (const StudyColumn& column : columns) header.push_back(column.name);
  return header;
}

std::string PlainTable(const std::vector<StudyColumn>& columns,
                       const std::vector<std::vector<double>>& rows) {
  CsvText csv(HeaderOf(columns));
  for (const std::vector<double>& row : rows) {
    for (const double value : row) csv.Cell(value);
    csv.EndRow();
  }
  return csv.text();
}

std::string CurveTable(const StudyFigure& figure) {
  if (figure.kind == StudyFigure::Kind::kSurface)
    return PlainTable(figure.columns, figure.curves.at(0).rows);
  std::vector<std::string> header = HeaderOf(figure.columns);
  header.insert(header.begin(), kSeriesColumn);
  CsvText csv(header);
  for (const StudyCurve& curve : figure.curves) {
    for (const std::vector<double>& row : curve.rows) {
      csv.Cell(curve.label);
      for (const double value : row) csv.Cell(value);
      csv.EndRow();
    }
  }
  return csv.text();
}

std::string ComparisonTable(const Reproduction& reproduction) {
  CsvText csv({"table", "cell", "quantity", "unit", "published", "ours", "tolerance", "agrees"});
  for (const StudyTable& table : reproduction.tables) {
    for (const ComparedNumber& number : table.numbers) {
      std::string cell;
      for (const StudyNumber& at : number.at)
        cell +=
            (cell.empty() ? "" : ", ") + at.name + " " + std::to_string(at.value) + " " + at.unit;
      csv.Cell(table.name).Cell(cell).Cell(number.quantity).Cell(number.unit);
      csv.Cell(number.published).Cell(number.ours).Cell(number.tolerance);
      csv.Cell(number.agrees() ? "yes" : "no");
      csv.EndRow();
    }
  }
  return csv.text();
}

}  // namespace

std::string FailureOf(const Reproduction& reproduction) {
  if (reproduction.left_out.empty()) return "";
  return "interrupted; left out " + Join(reproduction.left_out);
}

Json NewReproductionRecord(const ReproduceSettings& settings, const Study& study,
                           const std::vector<std::string>& items, const std::string& constants) {
  RecordHeader header;
  header.command = "reproduce";
  header.law = study.constants.law;
  header.options = {{"items", items},
                    {"constants", settings.constants.scenario},
                    {"set", settings.constants.set},
                    {"hip_distance_m", settings.legs.hip_distance},
                    {"leg_diameter_m", settings.legs.leg_diameter}};
  RecordSolver(settings.solver, header.options);
  Json record = NewRecord(header);
  record["scenario"] = study.constants.name;
  record["constants"] = constants;  // dotted.key=text, one a line
  return record;
}

void AddReproduction(const Reproduction& reproduction, Json& record) {
  Json published = Json::array(), statistics = Json::object();
  record["tables"] = Json::array();
  for (const StudyTable& table : reproduction.tables) {
    record["tables"].push_back(TableRecord(table));
    for (const ComparedNumber& number : table.numbers)
      published.push_back(ComparedRecord(table, number));
    for (const StudyNumber& n : table.statistics)
      statistics[table.name][n.name] = {{"value", NumberOrNull(n.value)}, {"unit", n.unit}};
  }
  record["figures"] = Json::array();
  for (const StudyFigure& figure : reproduction.figures)
    record["figures"].push_back(FigureRecord(figure));
  record["claims"] = Json::array();
  for (const StudyClaim& claim : reproduction.claims)
    record["claims"].push_back(ClaimRecord(claim));
  record["comparison"] = {{"published", published}, {"statistics", statistics}};
  record["left_out"] = reproduction.left_out;
}

std::map<std::string, std::string> ReproductionTables(const Reproduction& reproduction) {
  std::map<std::string, std::string> files;
  for (const StudyTable& table : reproduction.tables)
    files[FileOf(table.name)] = PlainTable(table.columns, table.rows);
  for (const StudyFigure& figure : reproduction.figures)
    files[FileOf(figure.name)] = CurveTable(figure);
  for (const StudyClaim& claim : reproduction.claims) {
    if (!claim.rows.empty()) files[FileOf(claim.name)] = PlainTable(claim.columns, claim.rows);
  }
  if (!reproduction.tables.empty()) files["comparison.csv"] = ComparisonTable(reproduction);
  return files;
}

}  // namespace hoplab
