#include "model/effects/effect.h"

#include <algorithm>

namespace hoplab {

std::string_view NameOf(EffectKind kind) {
  switch (kind) {
    case EffectKind::kForce:
      return "force";
    case EffectKind::kParameter:
      return "parameter";
    case EffectKind::kGuard:
      return "guard";
    case EffectKind::kObservation:
      return "observation";
  }
  return "";
}

std::optional<int> Effect::FindParameter(std::string_view name) const {
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    if (info.parameters[i].name == name) return static_cast<int>(i);
  }
  return std::nullopt;
}

namespace {

bool BringsLawTerms(const Effect& effect) {
  if (effect.formula != nullptr || effect.hooks0.add_joint_torque != nullptr) return true;
  if (effect.hooks0.change_parameters == nullptr) return false;
  std::array<double, kMaxEffectParameters> values{};
  for (std::size_t i = 0; i < effect.info.parameters.size(); ++i)
    values[i] = effect.info.parameters[i].typical;
  Parameters<double> changed;
  effect.hooks0.change_parameters(values.data(), changed);
  return changed.law_terms.active;
}

}  // namespace

bool AppliesTo(const Effect& effect, Law law, LegMass mass, InputSet inputs, RobotLegs robot_legs) {
  const EffectInfo& info = effect.info;
  if (info.needs_inputs != 0 && (info.needs_inputs & inputs) == 0) return false;
  if (mass == LegMass::kAtToe && info.massless_leg_only) return false;
  if (MechanismOf(law) == MechanismKind::kRobot)
    return info.for_robot && std::max(info.robot_leg, info.least_legs) <= robot_legs.count &&
           !(robot_legs.straight ? info.arcs_only : info.rods_only);
  if (!(MechanismOf(law) == MechanismKind::kBall ? info.for_ball : info.for_legs)) return false;
  if (MechanismOf(law) != MechanismKind::kBall && !InfoOf(law).takes_terms &&
      BringsLawTerms(effect))
    return false;
  return info.only_laws.empty() ||
         std::find(info.only_laws.begin(), info.only_laws.end(), law) != info.only_laws.end();
}

bool IsPartOf(Law law, const Effect& effect) {
  const std::span<const Law> laws = effect.info.part_of;
  return std::find(laws.begin(), laws.end(), law) != laws.end();
}

const Effect* FindEffect(std::string_view name) {
  for (const Effect* effect : AllEffects()) {
    if (effect->info.name == name) return effect;
  }
  return nullptr;
}

EffectSetting EffectSetting::Null(const Effect& effect) {
  EffectSetting setting{.effect = &effect};
  for (std::size_t i = 0; i < effect.info.parameters.size(); ++i) {
    setting.values[i] = effect.info.parameters[i].null;
  }
  return setting;
}

bool EffectSetting::IsNull() const {
  for (std::size_t i = 0; i < effect->info.parameters.size(); ++i) {
    const EffectParameter& p = effect->info.parameters[i];
    if (!p.is_shape && values[i] != p.null) return false;
  }
  return true;
}

}  // namespace hoplab
