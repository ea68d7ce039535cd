#include "app/records/law_record.h"

#include <algorithm>

namespace hoplab {
namespace {

Json ParameterRecords(MechanismKind mechanism) {
  Json out = Json::array();
  const auto free = FreeByDefault(mechanism);
  const auto add = [&](ParameterId id, bool needs_toe_mass) {
    const ParameterInfo& info = InfoOf(id);
    out.push_back({{"name", info.name},
                   {"unit", info.unit},
                   {"bounds", Json::array({info.lower, info.upper})},
                   {"free_by_default", std::find(free.begin(), free.end(), id) != free.end()},
                   {"needs_toe_mass", needs_toe_mass}});
  };
  for (const ParameterId id : ParametersOf(mechanism)) add(id, false);
  if (mechanism != MechanismKind::kBall && mechanism != MechanismKind::kRobot)
    for (const ParameterId id : ToeParameters()) add(id, true);
  return out;
}

}  // namespace

Json LawsRecord() {
  RecordHeader header;
  header.command = "laws";
  Json record = NewRecord(header);
  record["laws"] = Json::array();
  for (const MechanismKind mechanism : kMechanisms) {
    for (const Law law : LawsOf(mechanism)) {
      record["laws"].push_back({{"name", NameOf(law)},
                                {"mechanism", NameOf(mechanism)},
                                {"default", law == LawsOf(mechanism).front()},
                                {"sentence", SentenceOf(law)},
                                {"parameters", ParameterRecords(mechanism)}});
    }
  }
  return record;
}

}  // namespace hoplab
