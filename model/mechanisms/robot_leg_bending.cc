#include "model/mechanisms/robot_leg_bending.h"

#include "model/laws/clamped/rule.h"

namespace hoplab {
namespace {

constexpr int kPieces = 4;

// Integral of a function over u from the toe to the hip.
template <class Of>
double OverLeg(const Of& of) {
  const auto& rule = clamped::kRule<clamped::kNodes>;
  const double width = kPi / kPieces;
  double sum = 0.0;
  for (int piece = 0; piece < kPieces; ++piece)
    for (int k = 0; k < clamped::kNodes; ++k)
      sum += 0.5 * width * rule.weight[k] * of((piece + 0.5 * (1.0 + rule.node[k])) * width);
  return sum;
}

double Curvature(double u) {
  const double w = u / kPi;
  double sum = 0.0, power = w;
  for (double share : kBendingCurvature) sum += share * (power *= w);
  return sum;
}

double Scale() {
  const double square = OverLeg([](double u) {
    const Vector2<double> at = BendingShape(u);
    return at.x * at.x + at.y * at.y;
  });
  return 1.0 / std::sqrt(square / kPi);
}

LegBending Bending() {
  const auto mean = [](const auto& of) {
    return OverLeg([&](double u) { return of(u, BendingAt(u, 0.0)); }) / kPi;
  };
  return {.along = mean([](double, const Vector2<double>& at) { return at.x; }),
          .up = mean([](double, const Vector2<double>& at) { return at.y; }),
          // From the hip the point lies at (-sin u, -1 - cos u).
          .about = mean([](double u, const Vector2<double>& at) {
            return -std::sin(u) * at.y + (1.0 + std::cos(u)) * at.x;
          }),
          .toe = BendingAt(0.0, 0.0),
          .stiffness = OverLeg([](double u) {
            const double curved = BendingScale() * Curvature(u);
            return curved * curved;
          })};
}

}  // namespace

double BendingScale() {
  static const double scale = Scale();
  return scale;
}

const LegBending& FirstBending() {
  static const LegBending bending = Bending();
  return bending;
}

}  // namespace hoplab
