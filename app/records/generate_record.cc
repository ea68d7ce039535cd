#include "app/records/generate_record.h"

namespace hoplab {

Json GenerateRecord(const GenerateSettings& settings, const Scenario& scenario,
                    const GeneratedDataset& made) {
  RecordHeader header;
  header.command = "generate";
  header.dataset = made.dataset.name;
  if (scenario.law) header.law = *scenario.law;
  header.reading = scenario.mechanism.reading;
  header.seed = settings.seed;
  header.options = {{"scenario", settings.scenario.scenario},
                    {"set", settings.scenario.set},
                    {"with", settings.scenario.with},
                    {"noise", NumberOrNull(settings.noise)},
                    {"seed", settings.seed}};
  Json record = NewRecord(header);
  record["notes"] = made.notes;
  record["trials"] = Json::array();
  for (const Trial& trial : made.dataset.trials) {
    record["trials"].push_back({{"file", trial.file},
                                {"role", RoleName(trial.role)},
                                {"rows", trial.trace.time_s.size()}});
  }
  return record;
}

}  // namespace hoplab
