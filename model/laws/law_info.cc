#include <algorithm>
#include <array>
#include <vector>

#include "base/check.h"
#include "model/mechanisms/leg.h"
#include "model/parameters.h"

namespace hoplab {
namespace {

// Of the mechanisms that have one law each, and no leg whose law could be another.
constexpr LawInfo kBall = {
    Law::kBall,
    MechanismKind::kBall,
    0,
    "ball",
    "ball: ballistic flight, restitution and tangential loss at each bounce.",
    "vy+ = -restitution vy-, vx+ = (1 - tangential_loss) vx- at each bounce; both are "
    "plain numbers.",
    "The smallest hybrid system: everything has a closed form, so sensors, clocks and a "
    "new effect are tried out here first.",
    false};
constexpr LawInfo kRobot = {
    Law::kRobot,
    MechanismKind::kRobot,
    0,
    "robot",
    "robot: a body with pitch on up to four legs, each an exact elastic arc or a straight spring, "
    "clamped to its motor.",
    "Each leg is an elastic arc clamped to its motor: kappa^2 = 1 + 2 f_x (cos psi_0 - "
    "cos psi) + 2 f_y (sin psi - sin psi_0) along it, kappa in 1/r, f = F r^2/(E I) "
    "(M80), or a rod that gives way along itself and across (M97); body, motors and feet as M69 to "
    "M76.",
    "For machines with several legs and a body that pitches, as RHex. Free E_1, E_2 to "
    "ask which leg is soft; fix leg_damping if the traces are short.",
    false};

// Those of a mechanism side by side, its default first.
const std::vector<const LawInfo*>& All() {
  static const std::vector<const LawInfo*> kAll = [] {
    std::vector<const LawInfo*> all = {&kBall, &kRobot};
    for (const LegLaw* law : AllLegLaws()) all.push_back(&law->info);
    std::sort(all.begin(), all.end(), [](const LawInfo* a, const LawInfo* b) {
      return std::pair(a->mechanism, a->place) < std::pair(b->mechanism, b->place);
    });
    return all;
  }();
  return kAll;
}

}  // namespace

const LawInfo& InfoOf(Law law) {
  for (const LawInfo* info : All())
    if (info->law == law) return *info;
  HOPLAB_CHECK(false);
  return kBall;
}

std::span<const Law> LawsOf(MechanismKind mechanism) {
  static const std::vector<Law> kLaws = [] {
    std::vector<Law> laws;
    for (const LawInfo* info : All()) laws.push_back(info->law);
    return laws;
  }();
  const auto of = [&](Law law) { return MechanismOf(law) == mechanism; };
  const auto first = std::find_if(kLaws.begin(), kLaws.end(), of);
  return {first, std::find_if_not(first, kLaws.end(), of)};
}

std::optional<Law> FindLaw(std::string_view name) {
  for (const LawInfo* info : All())
    if (info->name == name) return info->law;
  return std::nullopt;
}

}  // namespace hoplab
