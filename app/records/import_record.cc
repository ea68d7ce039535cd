#include "app/records/import_record.h"

namespace hoplab {

Json ImportRecord(const ImportRequest& request, const ImportSettings& settings,
                  const ImportResult& made) {
  RecordHeader header;
  header.command = "import";
  header.dataset = request.name;
  header.options = {{"files", settings.logs},
                    {"map", made.map_texts},
                    {"cut", settings.cut},
                    {"shift", settings.shift},
                    {"zero_time", settings.zero_time},
                    {"mend_times", settings.mend_times},
                    {"rate_hz", NumberOrNull(settings.rate_hz)},
                    {"type", NameOf(made.type)},
                    {"legs", made.legs > 0 ? Json(made.legs) : Json()},
                    {"unit", settings.unit},
                    {"set", settings.set}};
  Json record = NewRecord(header);
  record["notes"] = made.notes;
  record["columns"] = Json::array();
  for (std::size_t i = 0; i < made.columns.size(); ++i) {
    const MappedColumn& mapped = made.map.columns[i];
    record["columns"].push_back({{"channel", TargetName(mapped.target)},
                                 {"column", made.columns[i]},
                                 {"unit", mapped.unit.name},
                                 {"negated", mapped.negate},
                                 {"guessed", mapped.guessed},
                                 {"why", mapped.why}});
  }
  record["unused"] = made.unused;
  record["trials"] = Json::array();
  for (const ImportedLog& log : made.logs) {
    Json missing = Json::object();
    for (const auto& [target, count] : log.trace.missing) missing[TargetName(target)] = count;
    record["trials"].push_back({{"file", log.file},
                                {"source", log.source},
                                {"format", log.format},
                                {"role", RoleName(log.role)},
                                {"rows", log.trace.rows},
                                {"missing", missing},
                                {"mended",
                                 {{"swapped", log.trace.mended.swapped},
                                  {"dropped", log.trace.mended.dropped},
                                  {"spread", log.trace.mended.spread}}}});
  }
  record["blank"] = Json::array();
  for (const BlankValue& blank : made.blanks) record["blank"].push_back(blank.key);
  return record;
}

}  // namespace hoplab
