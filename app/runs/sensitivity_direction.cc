#include "app/runs/sensitivity_direction.h"

#include <array>

#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {
constexpr std::array<const char*, 4> kStartNames = {"x0", "y0", "vx0", "vy0"};
}  // namespace

SensitivityDirection ResolveDirection(const std::string& name, const SimulationRequest& of,
                                      LegMass mass, const std::vector<EffectSetting>& effects,
                                      const char* option) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < kStartNames.size(); ++i) {
    if (name == kStartNames[i]) return SensitivityDirection::InitialState(static_cast<int>(i));
    known.emplace_back(kStartNames[i]);
  }
  const auto own = ParametersOf(MechanismOf(of.law)), toe = ToeParameters();
  std::vector<ParameterId> ids(own.begin(), own.end());
  std::erase_if(ids, [&](ParameterId id) { return !IsOfLegs(id, of.parameters); });
  if (mass == LegMass::kAtToe) ids.insert(ids.end(), toe.begin(), toe.end());
  for (const ParameterId id : ids) {
    if (name == InfoOf(id).name) return SensitivityDirection::Parameter(id);
    known.emplace_back(InfoOf(id).name);
  }
  for (std::size_t e = 0; e < effects.size(); ++e) {
    const EffectInfo& info = effects[e].effect->info;
    for (std::size_t p = 0; p < info.parameters.size(); ++p) {
      const std::string whole = std::string(info.name) + "." + std::string(info.parameters[p].name);
      if (name == whole)
        return SensitivityDirection::EffectParameter(static_cast<int>(e), static_cast<int>(p));
      known.push_back(whole);
    }
  }
  throw InputError({option, Printable(name), "is nothing this run can be differentiated by",
                    DidYouMean(name, known)});
}

}  // namespace hoplab
