#include "model/laws/clamped/integrals.h"

#include <cmath>
#include <limits>

#include "model/laws/clamped/on_each_cpu.h"
#include "model/laws/clamped/rule.h"

namespace hoplab::clamped {
namespace {

HOPLAB_ON_EACH_CPU void FillTangents(Tangents& t) {
  FillNodes<kNodes>(0.5 * (t.base - t.tip), t.cos_middle, t.sin_middle, t.c, t.s);
}

}  // namespace

Tangents::Tangents(double tip_angle, double base_angle) : tip(tip_angle), base(base_angle) {
  const double middle = 0.5 * (base + tip);
  cos_middle = std::cos(middle);
  sin_middle = std::sin(middle);
  FillTangents(*this);
  if (tip == 0.0) {
    cos_base = 1.0 - 2.0 * sin_middle * sin_middle;
    sin_base = 2.0 * sin_middle * cos_middle;
    return;
  }
  cos_tip = std::cos(tip);
  sin_tip = std::sin(tip);
  cos_base = std::cos(base);
  sin_base = std::sin(base);
}

HOPLAB_ON_EACH_CPU Integrals IntegralsOf(const Tangents& at, double fx, double fy) {
  const double half = 0.5 * (at.base - at.tip), x2 = 2.0 * fx, y2 = 2.0 * fy;
  const double level = 1.0 + x2 * at.cos_tip - y2 * at.sin_tip;
  double square[kNodes], over[kNodes], weight[kNodes], cube[kNodes];
  for (int i = 0; i < kNodes; ++i) square[i] = level + (y2 * at.s[i] - x2 * at.c[i]);
  double least = square[0];
  for (double q : square) least = q < least ? q : least;
  Integrals sum{};
  if (!(least > kLeastCurvature2)) {
    sum.one = std::numeric_limits<double>::quiet_NaN();
    return sum;
  }
  // Roots and quotients by themselves, so that they are taken in pairs.
  for (int i = 0; i < kNodes; ++i) over[i] = 1.0 / std::sqrt(square[i]);
  for (int i = 0; i < kNodes; ++i) {
    weight[i] = kRule<kNodes>.weight[i] * half * over[i];
    cube[i] = weight[i] * over[i] * over[i];
  }
  for (int i = 0; i < kNodes; ++i) {
    const double c = at.c[i], s = at.s[i], w = weight[i], w3 = cube[i];
    sum.one += w;
    sum.c += w * c;
    sum.s += w * s;
    sum.k1 += w3;
    sum.kc += w3 * c;
    sum.ks += w3 * s;
    sum.kcc += w3 * c * c;
    sum.kcs += w3 * c * s;
    sum.kss += w3 * s * s;
  }
  return sum;
}

}  // namespace hoplab::clamped
