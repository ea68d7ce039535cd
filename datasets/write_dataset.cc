#include "datasets/write_dataset.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/check.h"
#include "base/text.h"
#include "base/units.h"
#include "datasets/read_spec.h"
#include "datasets/yaml_fields.h"

namespace hoplab {
namespace {

// The shortest degrees that DegToRad turns into exactly this angle; the nearest where no double
// does.
std::string FormatDegrees(double angle_rad) {
  const double nearest = RadToDeg(angle_rad);
  std::optional<std::string> best;
  double candidate = nearest;
  constexpr int kReach = 4;  // DegToRad and RadToDeg round three times between them
  for (int i = 0; i < kReach; ++i) candidate = std::nextafter(candidate, -1e9);
  for (int i = 0; i <= 2 * kReach; ++i) {
    const std::string text = FormatDouble(candidate);
    if (DegToRad(candidate) == angle_rad && (!best || text.size() < best->size())) best = text;
    candidate = std::nextafter(candidate, 1e9);
  }
  return best.value_or(FormatDouble(nearest));
}

YamlFields ClockFields(const ClockSpec& clock) {
  YamlFields fields = {{"", "offset_s", FormatDouble(clock.offset_s)}};
  AddOptional(&fields, "", "sigma_s", clock.sigma_s);
  if (clock.per_trial) fields.push_back({"", "per", "trial"});
  return fields;
}

std::string ChannelText(const ChannelSpec& channel) {
  YamlFields fields;
  if (channel.sigma || !IsContact(channel.id))  // a contact goes without
    fields.push_back({"", "sigma", channel.sigma ? FormatDouble(*channel.sigma) : "estimate"});
  if (!channel.clock.empty()) fields.push_back({"", "clock", QuotedYaml(channel.clock)});
  return Flow(fields);
}

// All keys of each: written over another one they replace all of it.
YamlFields InputFields(const std::vector<InputSpec>& inputs) {
  YamlFields fields;
  for (const InputSpec& input : inputs) {
    const std::string name = InfoOf(input.id).key;
    const auto optional = [](const std::optional<double>& value) {
      return value ? FormatDouble(*value) : std::string("null");
    };
    fields.push_back({name, "column", QuotedYaml(input.column)});
    const char* hold = input.of_stance ? "stance" : input.held ? "previous" : "linear";
    fields.push_back({name, "hold", hold});
    fields.push_back({name, "delay_s", FormatDouble(input.delay_s)});
    fields.push_back({name, "delay_sigma_s", optional(input.delay_sigma_s)});
    fields.push_back({name, "scale", FormatDouble(input.scale)});
    fields.push_back({name, "scale_sigma", optional(input.scale_sigma)});
    fields.push_back({name, "clock", input.clock.empty() ? "null" : QuotedYaml(input.clock)});
  }
  return fields;
}

// The lines of a trial's touch-down angles; those read from a column are read again.
std::string AnglesText(const Trial& trial) {
  if (FindInput(trial.inputs, InputKind::kLegAngle) != nullptr) return "";
  if (trial.mechanism.type == MechanismKind::kRobot) return "";
  std::string angle = FormatDegrees(trial.touchdown_angle_rad);
  const std::vector<double>& each = trial.touchdown_angles_rad;
  const bool alike = std::all_of(each.begin(), each.end(),
                                 [&](double a) { return a == trial.touchdown_angle_rad; });
  if (trial.touchdown_from_leg_angle) {
    angle = "{from: leg_angle}";
  } else if (!each.empty() && !(alike && trial.touchdown_angle_sigma_rad)) {
    angle = "[";
    for (const double a : each) angle += (angle.size() > 1 ? ", " : "") + FormatDegrees(a);
    angle += "]";
  }
  std::string text = "    touchdown_angle_deg: " + angle + "\n";
  if (trial.touchdown_angle_sigma_rad)
    text +=
        "    touchdown_angle_sigma_deg: " + FormatDegrees(*trial.touchdown_angle_sigma_rad) + "\n";
  return text;
}

void AppendTrial(const Trial& trial, const Dataset& dataset, std::string* text) {
  *text += "  - file: " + QuotedYaml(trial.file) + "\n";
  *text += std::string("    role: ") + RoleName(trial.role) + "\n";
  *text += AnglesText(trial);
  const YamlFields mechanism =
      Difference(MechanismFields(dataset.mechanism), MechanismFields(trial.mechanism));
  if (!mechanism.empty()) *text += "    mechanism: " + Flow(Grouped(mechanism)) + "\n";
  if (trial.controller && trial.controller != dataset.controller) {
    const YamlFields base =
        dataset.controller ? ControllerFields(*dataset.controller) : YamlFields{};
    *text +=
        "    controller: " + Flow(Difference(base, ControllerFields(*trial.controller))) + "\n";
  } else if (!trial.controller && dataset.controller) {
    *text += "    controller: null\n";
  }
  if (trial.inputs != dataset.inputs) {
    YamlFields inputs = InputFields(trial.inputs);
    for (const InputSpec& input : dataset.inputs)
      if (FindInput(trial.inputs, input.id) == nullptr)
        inputs.insert(inputs.begin(), {"", InfoOf(input.id).key, "null"});
    *text += "    inputs: " + Flow(inputs) + "\n";
  }
  if (trial.initial) *text += "    initial: " + Flow(StateFields(*trial.initial)) + "\n";
  if (trial.initial_sigma)
    *text += "    initial_sigma: " + Flow(StateFields(*trial.initial_sigma)) + "\n";
}

// {gravity_scale: none, boom_inertia: {mu_x: none, mu_y: {at_most: 0.1}}}
std::string KnownText(const std::vector<KnownSpec>& known) {
  std::string text = "{", open;
  for (const KnownSpec& k : known) {
    const std::string size =
        k.at_most ? "{at_most: " + FormatDouble(*k.at_most) + "}" : std::string("none");
    const bool goes_on = !k.parameter.empty() && k.effect == open;
    if (!goes_on && !open.empty()) text += "}";
    if (text.size() > 1) text += ", ";
    if (!goes_on) text += QuotedYaml(k.effect) + ": " + (k.parameter.empty() ? size : "{");
    if (!k.parameter.empty()) text += QuotedYaml(k.parameter) + ": " + size;
    open = k.parameter.empty() ? "" : k.effect;
  }
  return text + (open.empty() ? "}" : "}}");
}

std::string FormatYaml(const Dataset& dataset) {
  std::string text = "format: hoplab-dataset/1\nname: " + QuotedYaml(dataset.name) + "\n";
  if (!dataset.title.empty()) text += "title: " + QuotedYaml(dataset.title) + "\n";
  const SourceSpec& source = dataset.source;
  if (source.kind != SourceKind::kUnstated) {
    text += "source:\n";
    text += source.kind == SourceKind::kRecorded ? "  kind: recorded\n" : "  kind: simulated\n";
    if (!source.by.empty()) text += "  by: " + QuotedYaml(source.by) + "\n";
    if (!source.licence.empty()) text += "  licence: " + QuotedYaml(source.licence) + "\n";
    if (!source.note.empty()) text += "  note: " + QuotedYaml(source.note) + "\n";
  }
  text += "mechanism: " + Flow(Grouped(MechanismFields(dataset.mechanism))) + "\n";
  if (dataset.controller)
    text += "controller: " + Flow(ControllerFields(*dataset.controller)) + "\n";
  text += "channels:\n";
  for (const ChannelSpec& channel : dataset.channels)
    text += std::string("  ") + ChannelName(channel.id) + ": " + ChannelText(channel) + "\n";
  for (const ClockSpec& clock : dataset.clocks)
    text += (&clock == &dataset.clocks.front() ? "clocks:\n  " : "  ") + QuotedYaml(clock.name) +
            ": " + Flow(ClockFields(clock)) + "\n";
  if (!dataset.inputs.empty()) text += "inputs: " + Flow(InputFields(dataset.inputs)) + "\n";
  if (!dataset.known.empty()) text += "known: " + KnownText(dataset.known) + "\n";
  text += "trials:\n";
  for (const Trial& trial : dataset.trials) AppendTrial(trial, dataset, &text);
  return text;
}

}  // namespace

std::string QuotedYaml(const std::string& text) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (c == '\n') {
      out += "\\n";
    } else if (byte < 0x20 || byte == 0x7F) {
      out += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::map<std::string, std::string> FormatDataset(const Dataset& dataset) {
  std::map<std::string, std::string> files;
  files["dataset.yaml"] = FormatYaml(dataset);
  for (const Trial& trial : dataset.trials) {
    const bool is_new = files.emplace(trial.file, FormatTraceCsv(trial.trace)).second;
    HOPLAB_CHECK(is_new);
  }
  return files;
}

void WriteDataset(const Dataset& dataset, const std::filesystem::path& folder,
                  const WriteDatasetOptions& options) {
  const std::map<std::string, std::string> files = FormatDataset(dataset);
  OverwriteOptions overwrite;
  overwrite.force = options.force;
  overwrite.marker = "dataset.yaml";
  WriteFolderAtomically(
      folder,
      [&](const std::filesystem::path& staged) {
        for (const auto& [name, text] : files) WriteFileAtomically(staged / name, text);
      },
      overwrite);
}

}  // namespace hoplab
