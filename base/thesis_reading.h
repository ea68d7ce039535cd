#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace hoplab {

/// What the published study leaves open about its law: readings of M5-M7 and M14 (section 3 of the
/// equation sheet, M31-M37). The defaults are `thesis` as it stands there; the straight leg knows
/// the sign of the torque alone. Settings without derivatives.
struct ThesisReading {
  /// Whether dtheta/dt in M7 contains dx_c/dt (M31).
  enum class Rolling : std::uint8_t { kImplicit, kExplicit };
  /// Whose rate M7 rolls by: theta = 2 alpha, or alpha of the virtual leg (M32).
  enum class AngleRate : std::uint8_t { kTheta, kVirtualLeg };
  /// Radius in M7: r_d of the loaded leg, or r (M33).
  enum class RollingRadius : std::uint8_t { kDeformed, kRest };
  /// What the damper sees: dl/dt, the hip's speed w along the chord, or minus the rate of the
  /// deflection l0 - l (M34).
  enum class DampingRate : std::uint8_t { kChord, kHip, kDeflection };
  /// Radius in k: r_d of the loaded leg, or r (M35).
  enum class StiffnessRadius : std::uint8_t { kDeformed, kRest };
  /// Angle in k: theta, or alpha of the virtual leg (M36).
  enum class StiffnessAngle : std::uint8_t { kTheta, kVirtualLeg };
  /// Vertical part of the hip torque's force: along n, or as printed, the other way up (M37).
  enum class TorqueSign : std::uint8_t { kNormal, kPrinted };

  Rolling rolling = Rolling::kImplicit;
  AngleRate angle_rate = AngleRate::kTheta;
  RollingRadius rolling_radius = RollingRadius::kDeformed;
  DampingRate damping_rate = DampingRate::kChord;
  StiffnessRadius stiffness_radius = StiffnessRadius::kDeformed;
  StiffnessAngle stiffness_angle = StiffnessAngle::kTheta;
  TorqueSign torque_sign = TorqueSign::kNormal;

  bool operator==(const ThesisReading&) const = default;
};

/// One of the settings above as files name it: a key and its words, the default first.
struct ReadingKey {
  std::string_view key;
  std::span<const std::string_view> words;
  int (*get)(const ThesisReading& reading);  // index of the word
  void (*set)(ThesisReading& reading, int word_index);
};
/// All of them, in the order of the struct.
std::span<const ReadingKey> ReadingKeys();

}  // namespace hoplab
