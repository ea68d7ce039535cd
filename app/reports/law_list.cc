#include "app/reports/law_list.h"

#include <span>

#include "app/records/law_record.h"
#include "app/terminal/console.h"

namespace hoplab {
namespace {

// "E [Pa], d [N s/m]".
std::string ParameterList(std::span<const ParameterId> ids) {
  std::string text;
  for (const ParameterId id : ids) {
    const ParameterInfo& info = InfoOf(id);
    text += (text.empty() ? "" : ", ") + std::string(info.name);
    if (info.unit != "-") text += " [" + std::string(info.unit) + "]";
  }
  return text;
}

}  // namespace

std::string LawListText(bool colours) {
  std::string text;
  for (const MechanismKind mechanism : kMechanisms) {
    text += Styled(NameOf(mechanism), Emphasis::kBold, colours) + "\n";
    for (const Law law : LawsOf(mechanism)) {
      std::string name(NameOf(law));
      name.resize(18, ' ');
      text += "  " + name + std::string(SentenceOf(law)) + "\n";
    }
    text += "  parameters:       " + ParameterList(ParametersOf(mechanism)) +
            "; the first two are fitted by default" +
            (mechanism == MechanismKind::kRobot ? ", of straight legs k and leg_damping\n" : "\n");
    if (mechanism == MechanismKind::kBall || mechanism == MechanismKind::kRobot) continue;
    text += "  with toe_mass_kg: " + ParameterList(ToeParameters()) + "\n";
  }
  return text;
}

}  // namespace hoplab
