#include "datasets/import/column_target.h"

#include "base/input_error.h"
#include "base/text.h"

namespace hoplab {
namespace {

std::vector<InputKind> MotorInputs() {
  std::vector<InputKind> inputs;
  for (const InputKind kind : kAllInputs)
    if (MotorOf(kind) >= 0) inputs.push_back(kind);
  return inputs;
}

// "body_y" of "body_y_m".
std::string WithoutUnit(const ColumnTarget& target) { return SplitTitle(TargetName(target)).stem; }

std::string_view ShortWord(Channel channel) { return InfoOf(channel).word; }

}  // namespace

int ColumnTarget::Leg() const {
  if (input) return MotorOf(*input);
  return channel ? LegOf(*channel) : -1;
}

ColumnTarget TargetOfWord(const std::string& word, const std::string& place) {
  std::vector<std::string> known = {"t", "time", "time_s"};
  for (const std::string& time : known)
    if (word == time) return std::nullopt;
  for (const Channel id : RecordedChannels()) {
    if (word == ChannelName(id) || word == WithoutUnit(id)) return id;
    if (ShortWord(id).empty()) continue;
    if (word == ShortWord(id)) return id;
    known.emplace_back(ShortWord(id));
  }
  for (const InputKind id : MotorInputs())
    if (word == TargetName(id) || word == WithoutUnit(id)) return id;
  throw InputError({place, Printable(word), "is no channel",
                    "Known: " + Join(known) +
                        ", and the names of the format, as body_y_m; of a robot body_pitch, "
                        "leg_angle_1, hip_torque_1, contact_1, reference_1, told_torque_1."});
}

std::string WordOf(const ColumnTarget& target) {
  if (target.IsTime()) return "t";
  if (target.channel && !ShortWord(*target.channel).empty())
    return std::string(ShortWord(*target.channel));
  return WithoutUnit(target);
}

std::string TargetName(const ColumnTarget& target) {
  if (target.channel) return ChannelName(*target.channel);
  if (!target.input) return "time_s";
  const std::string motor = std::to_string(MotorOf(*target.input) + 1);
  return FamilyOf(*target.input) == InputKind::kLegAngle ? "reference_" + motor + "_rad"
                                                         : "told_torque_" + motor + "_N_m";
}

Dimension TargetDimension(const ColumnTarget& target) {
  if (target.channel) return DimensionOf(*target.channel);
  if (!target.input) return Dimension::kTime;
  return FamilyOf(*target.input) == InputKind::kLegAngle ? Dimension::kAngle : Dimension::kTorque;
}

Range TargetRange(const ColumnTarget& target) {
  return target.channel ? ChannelRange(*target.channel) : InfoOf(*target.input).range;
}

}  // namespace hoplab
