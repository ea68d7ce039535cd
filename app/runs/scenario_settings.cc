#include "app/runs/scenario_settings.h"

#include <filesystem>

#include "app/terminal/usage_error.h"
#include "base/input_error.h"
#include "base/text.h"
#include "fitting/model_of_spec.h"

namespace hoplab {
namespace {

// effect:parameter=value as the dotted key of the scenario. Names are looked up here, so that a
// message speaks of --with.
void SetEffect(const std::string& text, ScenarioDocument& document) {
  const std::size_t colon = text.find(':');
  const std::size_t equals = text.find('=');
  const bool well_formed = colon != text.npos && colon > 0 && equals != text.npos &&
                           equals > colon + 1 && equals + 1 < text.size();
  if (!well_formed)
    throw UsageError("--with: " + Printable(text) +
                     "; must be effect:parameter=value, as air_drag:c_drag=0.05");
  const std::string effect_name = text.substr(0, colon);
  const std::string parameter = text.substr(colon + 1, equals - colon - 1);
  const Effect& effect = ResolveEffect(effect_name, "--with");
  if (!effect.FindParameter(parameter)) {
    std::vector<std::string> known;
    for (const EffectParameter& p : effect.info.parameters) known.emplace_back(p.name);
    throw InputError({"--with", effect_name + ":" + Printable(parameter),
                      "is not a parameter of this effect", DidYouMean(parameter, known)});
  }
  const std::string name(effect.info.name);
  if (IsEffectFile(effect_name))
    document.Set("effects." + name + ".file", std::filesystem::absolute(effect_name).string());
  document.Set("effects." + name + "." + parameter, text.substr(equals + 1));
}

}  // namespace

void AddScenarioOptions(CLI::App& sub, ScenarioSettings& settings) {
  sub.add_option("SCENARIO", settings.scenario, "File of the format hoplab-scenario/1")->required();
  sub.add_option("--set", settings.set,
                 "key=value over the file, as controller.kp_N_s=4; repeatable, of one key the "
                 "last holds")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false);
  sub.add_option("--with", settings.with,
                 "effect:parameter=value, as air_drag:c_drag=0.05; repeatable")
      ->delimiter(',')
      ->option_text("EFFECT:PARAMETER=VALUE")
      ->allow_extra_args(false);
  sub.add_option("--law", settings.law, "How the leg carries its load; see hoplab laws")
      ->option_text("LAW");
}

ScenarioDocument ScenarioDocumentOf(const ScenarioSettings& settings) {
  for (const std::string& text : settings.set) {
    if (text.find('=') == text.npos || text.front() == '=')
      throw UsageError("--set: " + Printable(text) + "; must be key=value, as controller.kp_N_s=4");
  }
  ScenarioDocument document = ScenarioDocument::FromFile(settings.scenario);
  for (const std::string& text : settings.set) document.SetFromOption(text);
  for (const std::string& text : settings.with) SetEffect(text, document);
  if (!settings.law.empty()) document.Set("law", settings.law);
  return document;
}

Scenario ReadScenarioOf(const ScenarioSettings& settings) {
  return ScenarioDocumentOf(settings).Read();
}

}  // namespace hoplab
