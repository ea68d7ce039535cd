#include "base/thesis_reading.h"

#include <array>

namespace hoplab {
namespace {

using Words2 = std::array<std::string_view, 2>;

constexpr Words2 kRolling = {"implicit", "explicit"};
constexpr Words2 kAngle = {"theta", "virtual_leg"};
constexpr Words2 kRadius = {"deformed", "rest"};
constexpr std::array<std::string_view, 3> kRate = {"chord", "hip", "deflection"};
constexpr Words2 kSign = {"normal", "printed"};

template <auto member>
constexpr ReadingKey Key(std::string_view key, std::span<const std::string_view> words) {
  return {key, words, [](const ThesisReading& v) { return static_cast<int>(v.*member); },
          [](ThesisReading& v, int index) {
            v.*member = static_cast<std::remove_reference_t<decltype(v.*member)>>(index);
          }};
}

constexpr std::array<ReadingKey, 7> kKeys = {
    Key<&ThesisReading::rolling>("rolling", kRolling),
    Key<&ThesisReading::angle_rate>("angle_rate", kAngle),
    Key<&ThesisReading::rolling_radius>("rolling_radius", kRadius),
    Key<&ThesisReading::damping_rate>("damping_rate", kRate),
    Key<&ThesisReading::stiffness_radius>("stiffness_radius", kRadius),
    Key<&ThesisReading::stiffness_angle>("stiffness_angle", kAngle),
    Key<&ThesisReading::torque_sign>("torque_sign", kSign)};

}  // namespace

std::span<const ReadingKey> ReadingKeys() { return kKeys; }

}  // namespace hoplab
