#include "app/records/law_comparison_record.h"

namespace hoplab {
namespace {

Json RowRecord(const ModelResult& row) {
  const bool ok = row.fit.result.ok;
  Json parameters = Json::object(), test = Json::object();
  for (int k = 0; k < row.fit.problem.shared_count(); ++k)
    parameters[row.fit.problem.shared[k].name] =
        ok ? NumberOrNull(row.fit.result.shared[k]) : Json(nullptr);
  for (std::size_t c = 0; c < row.fit.problem.channels.size(); ++c)
    test[std::string(NameOf(row.fit.problem.channels[c].channel))] =
        ok ? NumberOrNull(row.test.rmse[c]) : Json(nullptr);
  return {{"law", row.model.law},
          {"with", row.model.with_effects},
          {"parameters", parameters},
          {"test_rmse", test},
          {"test_nll_per_sample", ok ? NumberOrNull(row.test.nll_per_sample) : Json(nullptr)},
          {"chi2_per_dof", ok ? NumberOrNull(row.uncertainty.chi2_per_dof) : Json(nullptr)},
          {"by_hop", row.fit.by_hop},
          {"note", row.fit.note},
          {"message", row.fit.result.message}};
}

}  // namespace

Json LawComparisonRecord(const std::string& dataset, const LawComparison& comparison,
                         const std::map<std::string, double>& truth) {
  RecordHeader header;
  header.command = "compare";
  header.dataset = dataset;
  Json record = NewRecord(header);
  record["true"] = truth;
  record["rows"] = Json::array();
  for (const ModelResult& row : comparison.rows) record["rows"].push_back(RowRecord(row));
  return record;
}

}  // namespace hoplab
