#include "base/thesis_variant.h"

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
constexpr VariantKey Key(std::string_view key, std::span<const std::string_view> words) {
  return {key, words, [](const ThesisVariant& v) { return static_cast<int>(v.*member); },
          [](ThesisVariant& v, int index) {
            v.*member = static_cast<std::remove_reference_t<decltype(v.*member)>>(index);
          }};
}

constexpr std::array<VariantKey, 7> kKeys = {
    Key<&ThesisVariant::rolling>("rolling", kRolling),
    Key<&ThesisVariant::angle_rate>("angle_rate", kAngle),
    Key<&ThesisVariant::rolling_radius>("rolling_radius", kRadius),
    Key<&ThesisVariant::damping_rate>("damping_rate", kRate),
    Key<&ThesisVariant::stiffness_radius>("stiffness_radius", kRadius),
    Key<&ThesisVariant::stiffness_angle>("stiffness_angle", kAngle),
    Key<&ThesisVariant::torque_sign>("torque_sign", kSign)};

}  // namespace

std::span<const VariantKey> VariantKeys() { return kKeys; }

}  // namespace hoplab
