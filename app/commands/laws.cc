#include <ostream>

#include "app/records/run_record.h"
#include "app/terminal/command.h"
#include "model/parameters.h"

namespace hoplab {
namespace {

struct LawsSettings {
  bool json = false;
};

constexpr std::array kMechanisms = {MechanismKind::kCLeg, MechanismKind::kStraightLeg,
                                    MechanismKind::kBall, MechanismKind::kRobot};

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

ExitCode RunLaws(const LawsSettings& settings, Console& console) {
  if (settings.json) {
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
    console.out << TextOf(record);
    return ExitCode::kDone;
  }
  for (const MechanismKind mechanism : kMechanisms) {
    console.out << Styled(NameOf(mechanism), Emphasis::kBold, console.out_colours) << '\n';
    for (const Law law : LawsOf(mechanism)) {
      std::string name(NameOf(law));
      name.resize(18, ' ');
      console.out << "  " << name << SentenceOf(law) << '\n';
    }
    console.out << "  parameters:       ";
    const auto list = [&](std::span<const ParameterId> ids) {
      const char* separator = "";
      for (const ParameterId id : ids) {
        const ParameterInfo& info = InfoOf(id);
        console.out << separator << info.name;
        if (info.unit != "-") console.out << " [" << info.unit << ']';
        separator = ", ";
      }
    };
    list(ParametersOf(mechanism));
    console.out << "; the first two are fitted by default\n";
    if (mechanism == MechanismKind::kBall || mechanism == MechanismKind::kRobot) continue;
    console.out << "  with toe_mass_kg: ";
    list(ToeParameters());
    console.out << '\n';
  }
  return ExitCode::kDone;
}

void AddLaws(CLI::App& sub, Invocation& invocation) {
  OnParsed(sub, invocation, std::make_shared<LawsSettings>(), RunLaws);
}

}  // namespace

namespace commands {
extern constexpr Command laws = {.place = 170,
                                 .name = "laws",
                                 .what = "Leg laws and parameters of each mechanism",
                                 .footer = "Example:\n  hoplab laws",
                                 .add = AddLaws};
}  // namespace commands
}  // namespace hoplab
