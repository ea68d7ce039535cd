#include "model/laws/clamped/integrals.h"

#include <cmath>
#include <limits>

#include "model/laws/clamped/at_nodes.h"
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
  using Nodes = Lane<kNodes>;
  const double half = 0.5 * (at.base - at.tip), x2 = 2.0 * fx, y2 = 2.0 * fy;
  const double level = 1.0 + x2 * at.cos_tip - y2 * at.sin_tip;
  const Nodes c = LaneFrom<kNodes>(at.c), s = LaneFrom<kNodes>(at.s);
  AtNodes<kNodes, 0> square;
  square.a = level + (y2 * s - x2 * c);
  Integrals sum{};
  if (!(Least<kNodes>(square.a) > kLeastCurvature2)) {
    sum.one = std::numeric_limits<double>::quiet_NaN();
    return sum;
  }
  const Nodes over = InverseRoot(square).a;
  const Nodes w = LaneFrom<kNodes>(kRule<kNodes>.weight) * half * over;
  const Nodes w3 = w * over * over, w3c = w3 * c, w3s = w3 * s;
  sum.one = Sum<kNodes>(w);
  sum.c = Sum<kNodes>(w * c);
  sum.s = Sum<kNodes>(w * s);
  sum.k1 = Sum<kNodes>(w3);
  sum.kc = Sum<kNodes>(w3c);
  sum.ks = Sum<kNodes>(w3s);
  sum.kcc = Sum<kNodes>(w3c * c);
  sum.kcs = Sum<kNodes>(w3c * s);
  sum.kss = Sum<kNodes>(w3s * s);
  return sum;
}

}  // namespace hoplab::clamped
