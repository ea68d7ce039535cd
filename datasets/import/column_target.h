#pragma once

#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "base/channel.h"
#include "base/input_kind.h"
#include "datasets/import/unit.h"

namespace hoplab {

/// What a column of a log becomes: the times, a channel, or what drives a motor of a robot.
struct ColumnTarget {
  ColumnTarget() = default;  // the times
  ColumnTarget(std::nullopt_t) {}
  ColumnTarget(Channel is) : channel(is) {}
  ColumnTarget(InputKind is) : input(is) {}

  std::optional<Channel> channel;
  std::optional<InputKind> input;

  bool IsTime() const { return !channel && !input; }
  /// Whether only a robot has it.
  bool IsRobots() const { return input || (channel && IsRobotChannel(*channel)); }
  /// The leg it is of, from 0; -1 if it is of none.
  int Leg() const;
  /// Time, then channels in their order, then inputs.
  std::strong_ordering operator<=>(const ColumnTarget& other) const {
    return Key() <=> other.Key();
  }
  bool operator==(const ColumnTarget& other) const { return Key() == other.Key(); }

 private:
  int Key() const {
    constexpr int kBehindChannels = 1000;
    if (channel) return static_cast<int>(*channel);
    return input ? kBehindChannels + static_cast<int>(*input) : -1;
  }
};

/// A target by a name of the command line: "y", "body_y", "body_y_m", "reference_1"; "t" is the
/// time. Throws InputError with `place` if there is none.
ColumnTarget TargetOfWord(const std::string& word, const std::string& place);
/// The shortest name of the command line: "y", "body_pitch", "reference_1".
std::string WordOf(const ColumnTarget& target);
/// How a trace's column is called: "time_s", the channel's name, "reference_1_rad" (the angle that
/// the controller of motor 1 follows), "told_torque_1_N_m" (what motor 1 is told to give).
std::string TargetName(const ColumnTarget& target);
Dimension TargetDimension(const ColumnTarget& target);
/// What a sample may be; not of the time.
Range TargetRange(const ColumnTarget& target);

}  // namespace hoplab
