#include "model/mechanism_traits.h"

#include <array>
#include <cmath>

namespace hoplab {
namespace {

double OfCLeg(const Parameters<double>& p) {
  return p.theta_td > 0.0 ? p.r * (1.0 + std::cos(p.theta_td)) : 2.0 * p.r * std::cos(p.theta_td);
}
double OfStraightLeg(const Parameters<double>& p) { return p.l0 * std::cos(p.theta_td); }
double OfBall(const Parameters<double>& p) { return p.radius; }

// In the order of MechanismKind.
constexpr auto kRows = std::to_array<MechanismTraits>({
    {true, true, false, false, false, OfCLeg},
    {true, true, false, false, false, OfStraightLeg},
    {false, false, false, false, false, OfBall},
    {true, false, true, true, true, nullptr},
});

}  // namespace

const MechanismTraits& TraitsOf(MechanismKind mechanism) {
  return kRows[static_cast<std::size_t>(mechanism)];
}

}  // namespace hoplab
