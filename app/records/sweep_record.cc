#include "app/records/sweep_record.h"

#include <array>
#include <utility>

#include "app/records/csv.h"
#include "app/records/solver_record.h"

namespace hoplab {
namespace {

// How the run ended, and a sentence for those that did not reach their end.
constexpr const char* kOutcome = "outcome";
constexpr const char* kReason = "reason";

bool ReachedItsEnd(const SweepRow& row) { return row.reason.empty(); }

}  // namespace

std::string UnitOfKey(const std::string& key) {
  // The longest first: "_m" ends "_N_m" too.
  constexpr std::array<std::pair<const char*, const char*>, 18> kSuffixes = {
      {{"_N_m_s_per_rad", "N m s/rad"},
       {"_N_m_per_rad", "N m/rad"},
       {"_N_s_per_m", "N s/m"},
       {"_m_per_s2", "m/s^2"},
       {"_m_per_s", "m/s"},
       {"_N_per_m", "N/m"},
       {"_N_s", "N s"},
       {"_N_m", "N m"},
       {"_rad_per_s", "rad/s"},
       {"_rad", "rad"},
       {"_deg", "deg"},
       {"_Pa", "Pa"},
       {"_kg", "kg"},
       {"_kg_m2", "kg m^2"},
       {"_m4", "m^4"},
       {"_m2", "m^2"},
       {"_m", "m"},
       {"_s", "s"}}};
  for (const auto& [suffix, unit] : kSuffixes) {
    if (key.ends_with(suffix)) return unit;
  }
  return "";
}

Json NewSweepRecord(const SweepSettings& settings, const SweepPlan& plan) {
  RecordHeader header;
  header.command = "sweep";
  header.law = std::string(NameOf(plan.law()));
  header.reading = plan.reading();
  header.seed = settings.seed;
  header.options = {{"scenario", settings.scenario.scenario},
                    {"set", settings.scenario.set},
                    {"with", settings.scenario.with}};
  RecordSolver(settings.solver, header.options);
  Json record = NewRecord(header);
  record["scenario"] = plan.name();
  record["settings_hash"] = plan.fingerprint();
  return record;
}

void AddSweep(const SweepPlan& plan, const SweepRows& rows, Json& record) {
  record["columns"] = Json::array();
  const auto column = [&](std::string_view name, std::string_view unit) {
    record["columns"].push_back({{"name", name}, {"unit", unit}});
  };
  for (const std::string& key : plan.keys()) column(key, UnitOfKey(key));
  for (const SweepOutput* output : plan.outputs()) column(output->name, output->unit);
  column(kOutcome, "");
  column(kReason, "");
  record["keys"] = plan.keys();
  record["rows"] = Json::array();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i]) continue;
    Json cells = Json::array();
    for (const double value : plan.Point(static_cast<int>(i))) cells.push_back(value);
    for (const double value : rows[i]->values) cells.push_back(NumberOrNull(value));
    cells.push_back(rows[i]->outcome);
    cells.push_back(ReachedItsEnd(*rows[i]) ? Json(nullptr) : Json(rows[i]->reason));
    record["rows"].push_back(std::move(cells));
  }
  record["comparison"] = nullptr;
}

std::string SweepTable(const SweepPlan& plan, const SweepRows& rows) {
  std::vector<std::string> header = plan.keys();
  for (const SweepOutput* output : plan.outputs()) header.emplace_back(output->name);
  header.emplace_back(kOutcome);
  header.emplace_back(kReason);
  CsvText csv(header);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i]) continue;
    for (const double value : plan.Point(static_cast<int>(i))) csv.Cell(value);
    for (const double value : rows[i]->values) csv.Cell(value);
    csv.Cell(rows[i]->outcome).Cell(rows[i]->reason);
    csv.EndRow();
  }
  return csv.text();
}

}  // namespace hoplab
