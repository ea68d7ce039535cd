#include "app/export/exported_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/terminal/quantity.h"
#include "base/input_error.h"
#include "base/text.h"
#include "model/effects/active_effects.h"

namespace hoplab {
namespace {

// Reads what hoplab wrote; anything else there is damage.
class RecordReader {
 public:
  RecordReader(std::string place, const Json& record) : place_(std::move(place)), record_(record) {}

  const Json& At(const std::string& key) const {
    const auto found = record_.find(key);
    if (found == record_.end()) Refuse(key, "absent", "must be there");
    return *found;
  }
  RecordReader Part(const std::string& key) const {
    const Json& part = At(key);
    if (!part.is_object()) Refuse(key, part.dump(), "must be an object");
    return {place_ + ": " + key, part};
  }
  double Number(const std::string& key) const {
    const Json& value = At(key);
    if (!value.is_number()) Refuse(key, value.dump(), "must be a number");
    return value.get<double>();
  }
  std::string Text(const std::string& key) const {
    const Json& value = At(key);
    if (!value.is_string()) Refuse(key, value.dump(), "must be a text");
    return value.get<std::string>();
  }
  [[noreturn]] void Refuse(const std::string& key, const std::string& value,
                           const std::string& rule) const {
    throw InputError({place_, key + " = " + Printable(value), rule,
                      "The record was damaged or is of another version: run the command anew."});
  }
  const std::string& place() const { return place_; }
  const Json& json() const { return record_; }

 private:
  std::string place_;
  const Json& record_;
};

ThesisReading ReadingOf(const RecordReader& record) {
  ThesisReading reading;
  for (const ReadingKey& key : ReadingKeys()) {
    const std::string word = record.Text(std::string(key.key));
    int index = -1;
    for (std::size_t i = 0; i < key.words.size(); ++i) {
      if (key.words[i] == word) index = static_cast<int>(i);
    }
    if (index < 0) record.Refuse(std::string(key.key), word, "is none of its words");
    key.set(reading, index);
  }
  return reading;
}

EffectSetting EffectOf(const RecordReader& record) {
  const Effect* effect = FindEffect(record.Text("name"));
  if (!effect) record.Refuse("name", record.Text("name"), "is no effect of this hoplab");
  EffectSetting setting = EffectSetting::Null(*effect);
  const RecordReader values = record.Part("parameters");
  for (std::size_t i = 0; i < effect->info.parameters.size(); ++i)
    setting.values[i] = values.Number(std::string(effect->info.parameters[i].name));
  return setting;
}

Parameters<double> ParametersOf(const RecordReader& mechanism, MechanismKind kind) {
  Parameters<double> p;
  const RecordReader values = mechanism.Part("parameters");
  for (const ParameterId id : ParametersOf(kind))
    Field(p, id) = values.Number(std::string(InfoOf(id).name));
  if (values.json().contains("m_toe")) {
    for (const ParameterId id : ToeParameters())
      Field(p, id) = values.Number(std::string(InfoOf(id).name));
  }
  p.reading = ReadingOf(mechanism.Part("variant"));
  if (!mechanism.At("torque_limit_N_m").is_null())
    p.torque_limit = mechanism.Number("torque_limit_N_m");
  p.on_guide = mechanism.At("on_guide") == Json(true);
  return p;
}

std::vector<ExportedStart> InitialStatesOf(const RecordReader& record) {
  std::vector<ExportedStart> initial_states;
  if (!record.json().contains("trials")) return initial_states;
  for (const Json& entry : record.At("trials")) {
    const RecordReader trial(record.place() + ": trials", entry);
    const RecordReader start = trial.Part("start");
    initial_states.push_back({trial.Text("file"),
                              trial.Number("touchdown_angle_rad"),
                              {start.Number("x_m"), start.Number("y_m"), start.Number("vx_m_per_s"),
                               start.Number("vy_m_per_s")}});
  }
  return initial_states;
}

// Whether the templates of export/c say this law.
bool IsWritten(Law law) {
  static constexpr std::array kWritten = {Law::kThesis,          Law::kNoSlip,   Law::kConsistent,
                                          Law::kLargeDeflection, Law::kElastica, Law::kStraightLeg};
  return std::find(kWritten.begin(), kWritten.end(), law) != kWritten.end();
}

// The part of the record that tells the model: of a diagnosis the one with its causes.
bool TakesExtension(const Json& record) {
  const auto text = [&](const char* key) {
    const auto found = record.find(key);
    return found != record.end() && found->is_string() ? found->get<std::string>() : "";
  };
  const auto extension = record.find("extension");
  return text("command") == "diagnose" && extension != record.end() && extension->is_object() &&
         (text("verdict") == "named" || text("verdict") == "confounded");
}

// Refuses a run that has no model, or none that holds.
void RequireModel(const Json& json, const std::string& place, const std::string& command,
                  const Json& source) {
  const std::string status = json.value("status", Json("ok")).get<std::string>();
  const bool estimates = command == "fit" || command == "diagnose" || command == "optimize";
  if (estimates && (status == "failed" || status == "stuck")) {
    throw InputError({place, "status = " + Printable(status),
                      "must be a run with a result: its values are no estimate",
                      "Give the folder of a fit, a diagnosis or a simulation that succeeded."});
  }
  const auto found = source.find("mechanism");
  if (found == source.end() || !found->is_object()) {
    throw InputError({place, "command = " + Printable(command), "must be a run with a model",
                      "Give the folder of a fit, a diagnosis or a simulation that succeeded."});
  }
  if (!found->contains("law")) {
    throw InputError({place + ": mechanism", "law = absent",
                      "must be told: an earlier hoplab wrote this run, and kept less of the model",
                      "Run the command anew."});
  }
}

}  // namespace

Parameters<double> ExportedModel::Effective() const {
  ActiveEffects<double> active;
  for (const EffectSetting& e : effects) active.Add(*e.effect, e.values);
  Parameters<double> p = parameters;
  active.ChangeParameters(p);
  return p;
}

bool ExportedModel::Has(std::string_view effect) const {
  for (const EffectSetting& e : effects) {
    if (e.effect->info.name == effect) return true;
  }
  return false;
}

double ExportedModel::Of(std::string_view effect) const {
  for (const EffectSetting& e : effects) {
    if (e.effect->info.name == effect) return e.values[0];
  }
  return 0.0;
}

ExportedModel ModelOfRun(const std::filesystem::path& folder, const StoredRun& run) {
  const std::string place = Printable((folder / "run.json").string(), 200);
  const Json& json = run.record;
  const std::string command = json.value("command", Json("")).get<std::string>();
  const bool extended = TakesExtension(json);
  const Json& source = extended ? json.at("extension") : json;
  RequireModel(json, place, command, source);
  const RecordReader mechanism(place + ": mechanism", source.at("mechanism"));
  ExportedModel model;
  const std::string subject = json.contains("dataset") && json["dataset"].is_string()
                                  ? json["dataset"].get<std::string>()
                                  : "a run";
  model.origin = subject + ", " + command + " of hoplab " + json.value("version", std::string());
  const std::string law = mechanism.Text("law");
  const std::optional<Law> known = FindLaw(law);
  if (!known) mechanism.Refuse("law", law, "is no law of this hoplab");
  model.law = *known;
  const MechanismKind kind = MechanismOf(model.law);
  if (kind == MechanismKind::kBall) {
    throw InputError(
        {place, "law = ball", "must be the law of a leg: a ball has none to export", ""});
  }
  if (!IsWritten(model.law)) {
    throw InputError({place, "law = " + law,
                      "cannot be exported: it is of a robot with several legs",
                      "Export a leg that hops alone."});
  }
  model.liftoff = mechanism.Text("liftoff") == "rest_length" ? LiftoffRule::kRestLength
                                                             : LiftoffRule::kZeroForce;
  model.parameters = ParametersOf(mechanism, kind);
  if (model.parameters.m_toe > 0.0) {
    throw InputError({place + ": mechanism", "m_toe = " + FormatDouble(model.parameters.m_toe),
                      "cannot be exported: a leg with a mass at its toe moves in flight, too",
                      "Fit the hops with leg_mass in its place."});
  }
  for (const Json& entry : mechanism.At("effects")) {
    const EffectSetting setting = EffectOf({place + ": effects", entry});
    if (!setting.IsNull()) model.effects.push_back(setting);
  }
  for (const Json& kind_of_input : mechanism.At("driven_by"))
    model.driven_by.push_back(kind_of_input.get<std::string>());
  const Json& trials = command == "diagnose" && !extended ? json.at("null") : source;
  model.initial_states = InitialStatesOf({place, trials});
  return model;
}

std::string ExactNumber(double value) {
  std::string text = FormatDouble(value);
  if (text.find_first_of(".en") == text.npos) text += ".0";
  return text;
}

bool IsAmong(std::string_view name, std::span<const char* const> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string DescribeEffect(const EffectSetting& setting) {
  const EffectInfo& info = setting.effect->info;
  std::vector<std::string> values;
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    const EffectParameter& p = info.parameters[i];
    values.push_back(std::string(p.name) + " = " + Significant(setting.values[i], 5) +
                     (p.unit == "-" ? "" : " " + std::string(p.unit)));
  }
  return std::string(info.name) + " (" + Join(values) + ")";
}

}  // namespace hoplab
