#include "model/laws/extended_leg.h"

#include <array>
#include <cmath>
#include <numbers>

#include "model/effects/effect.h"
#include "model/leg_compliance.h"

namespace hoplab {
namespace {

constexpr double kPi = std::numbers::pi;

// A value and its rate of change in one direction, over a scalar that carries directions itself:
// the second derivatives in the rates of M7 and M8.
template <class T>
struct Tangent {
  T value, rate{0.0};

  Tangent(const T& v) : value(v) {}  // NOLINT: a constant is a tangent with rate 0
  Tangent(const T& v, const T& r) : value(v), rate(r) {}

  friend Tangent operator+(const Tangent& a, const Tangent& b) {
    return {a.value + b.value, a.rate + b.rate};
  }
  friend Tangent operator-(const Tangent& a, const Tangent& b) {
    return {a.value - b.value, a.rate - b.rate};
  }
  friend Tangent operator*(const Tangent& a, const Tangent& b) {
    return {a.value * b.value, a.rate * b.value + a.value * b.rate};
  }
  friend Tangent operator/(const Tangent& a, const Tangent& b) {
    const T q = a.value / b.value;
    return {q, (a.rate - q * b.rate) / b.value};
  }
  friend Tangent operator*(double a, const Tangent& b) { return {a * b.value, a * b.rate}; }
  friend Tangent sqrt(const Tangent& a) {
    using std::sqrt;
    const T root = sqrt(a.value);
    return {root, 0.5 * a.rate / root};
  }
  friend double Value(const Tangent& a) { return hoplab::Value(a.value); }
};

// The k-th derivative of a function of one variable at x, given all of them at its value.
double Lift(double, const double* derivatives, int k) { return derivatives[k]; }
template <int N>
Jet<N> Lift(const Jet<N>& x, const double* derivatives, int k) {
  return Jet<N>(derivatives[k], derivatives[k + 1] * x.v);
}
template <class T>
Tangent<T> Lift(const Tangent<T>& x, const double* derivatives, int k) {
  return {Lift(x.value, derivatives, k), Lift(x.value, derivatives, k + 1) * x.rate};
}

// Shape functions of an arc with as many derivatives as the rates of the tip's angle need.
struct ArcShapes {
  std::array<double, 3> sin, cos;  // of phi/2
  std::array<double, 5> bending;   // M1
  std::array<double, 4> axial, shear, second_order;

  explicit ArcShapes(double phi) {
    const HalfAngle a(phi);
    const double h = a.h, S = a.sin, K = a.cos;
    const double sin_phi = 2.0 * S * K, cos_phi = 1.0 - 2.0 * S * S;
    sin = {S, 0.5 * K, -0.25 * S};
    cos = {K, -0.5 * S, -0.25 * K};
    const ShapeValue b = BendingShape(a), n = AxialShape(a), s = ShearShape(a),
                     g = SecondOrderShape(a);
    bending = {b.value, b.d1, b.d2, phi * sin_phi, sin_phi + phi * cos_phi};
    axial = {n.value, n.d1, n.d2, -3.0 * cos_phi};
    shear = {s.value, s.d1, s.d2, cos_phi};
    const double S2 = S * S, K2 = K * K;
    const double g3 = 2.0 * h * S * (6.0 * S2 - 21.0 * K2) + h * h * K * (60.0 * S2 - 21.0 * K2) +
                      K * (30.0 * S2 - 15.0 * K2 + 1.5) + h * S * (105.0 * K2 - 30.0 * S2 - 1.5) +
                      K * (12.0 * K2 - 73.5 * S2 + 1.5);
    second_order = {g.value, g.d1, g.d2, 0.125 * g3};
  }
};

// The next terms of the elastica after M24 and M25, in F N and N^2 (M24b, M25b), as M2b is in F^2:
// chord in units of r (r^2/(E I))^2, lead u/l in units of (r^2/(E I))^2.
template <class S>
struct SecondOrderAcross {
  S chord_FN, chord_NN, lead_FN, lead_NN;
};
template <class S>
SecondOrderAcross<S> SecondOrderAcrossAt(const S& phi, const S& sin, const S& cos) {
  const S K2 = cos * cos, S2 = sin * sin, q = phi * phi, one = S2 + K2;
  return {7.5 * (phi * sin * K2) - 12.0 * (S2 * cos) + q * cos * (0.75 * one - 1.5 * K2),
          sin * (4.0 * one - 3.75 * K2) + phi * cos * (3.0 * K2 - 2.5 * one) +
              q * (0.75 * (S2 * K2) - 0.3125 * one) / sin,
          sin * (2.0 * one - 3.5 * K2) + phi * cos * (2.75 * K2 - 2.0 * one) +
              q * sin * (0.75 * K2 - 0.125 * one),
          cos * (0.75 * one - 0.875 * K2) + phi * (K2 * K2 - 1.25 * K2 + 0.375 * one) / sin -
              q * cos * (0.375 * (K2 * K2) - 0.625 * K2 + 0.28125 * one) / S2};
}

bool IsElastic(Law law) { return law == Law::kConsistent || law == Law::kLargeDeflection; }

// What the state says to the leg, in a scalar that may be differentiated.
template <class S>
struct Situation {
  S u;       // contact lead [m]
  S Y;       // height of the hip over the contact [m]
  S softer;  // E at the start of the trial over E now
};

// The leg at an arc and a height, in equilibrium or not.
template <class S>
struct Statics {
  S l, sin, cos, delta, C, A2, F;
  S soft_F;    // F without leg_hardening, where that is a share of a spring's force
  S tip_miss;  // u/l less the right side of M10 (M10b, M25): 0 at equilibrium
};

// P: scalar of the parameters, S of the unknowns.
template <class S, class P>
[[gnu::flatten]] Statics<S> StaticsAt(const Parameters<P>& p, Law law, const P& torque,
                                      const S& phi, const Situation<S>& at) {
  using std::sqrt;
  const LawTerms<P>& terms = p.law_terms;
  Statics<S> out{.l = sqrt(at.u * at.u + at.Y * at.Y),
                 .sin = S(P(0.0)),
                 .cos = S(P(0.0)),
                 .delta = S(P(0.0)),
                 .C = S(P(0.0)),
                 .A2 = S(P(0.0)),
                 .F = S(P(0.0)),
                 .soft_F = S(P(0.0)),
                 .tip_miss = S(P(0.0))};
  const S& l = out.l;
  if (law == Law::kStraightLeg) {
    out.delta = p.l0 - l;
    out.C = at.softer / p.k;
    out.soft_F = out.delta / out.C;
    out.F = out.soft_F * (P(1.0) + terms.hardening / p.l0 * out.delta);
    return out;
  }
  const ArcShapes shapes(Value(phi));
  const auto lift = [&](const auto& shape, int k) { return Lift(phi, shape.data(), k); };
  out.sin = lift(shapes.sin, 0);
  out.cos = lift(shapes.cos, 0);
  const P flex = 1.0 / (2.0 * p.E * p.I);  // M2: r^3 flex f + r stretch a + r slide s
  const P stretch = 1.0 / (2.0 * p.E * p.A);
  const P slide = p.kappa / (2.0 * p.G * p.A);
  const P& r = p.r;
  // Chord compliance of an arc of another radius, and its derivative dC/ds at the rest radius.
  const auto chord = [&](const S& radius, const ArcShapes& of, const S& arc) {
    const auto shape = [&](const auto& derivatives) { return Lift(arc, derivatives.data(), 0); };
    return at.softer * (radius * radius * radius * (flex * shape(of.bending)) +
                        radius * (stretch * shape(of.axial))) +
           radius * (slide * shape(of.shear));
  };
  const S bending1 = at.softer * (r * r * flex * lift(shapes.bending, 1));
  S Cs = bending1 + at.softer * (stretch * lift(shapes.axial, 1)) + slide * lift(shapes.shear, 1);
  // M24, M25: the normal force N bends the leg and turns its tip.
  const S N = terms.torque_bending * torque / l;
  S turn = N * (at.softer * (0.5 * r * r * flex * lift(shapes.bending, 2)));
  out.delta = 2.0 * (r * out.sin) - l - r * (N * bending1);
  // M2b and its slope at the rest radius, by the law or by the share an effect brings in.
  const bool second_order = law == Law::kLargeDeflection || terms.second_order_active;
  const P share = law == Law::kLargeDeflection ? P(1.0) : terms.second_order;
  const P unit = share * (4.0 * r * r * r * r * flex * flex);
  const S softer2 = at.softer * at.softer;
  const S C2s = softer2 * (unit * lift(shapes.second_order, 1));
  if (IsElastic(law)) {
    out.C = chord(S(r), shapes, phi);
    // M26: hardening takes from C2.
    const P hardening = terms.hardening / r;
    out.A2 = P(-hardening) * (out.C * out.C);
    S A2s = -2.0 * (hardening * (out.C * Cs));
    if (second_order) {
      out.A2 = out.A2 + softer2 * (r * unit * lift(shapes.second_order, 0));
      A2s = A2s + C2s;
    }
    S C = out.C;
    if (terms.torque_active && second_order) {
      const SecondOrderAcross<S> next = SecondOrderAcrossAt(phi, out.sin, out.cos);
      const S of_N = softer2 * (unit * N);
      out.delta = out.delta + r * (of_N * N * next.chord_NN);
      C = C - r * (of_N * next.chord_FN);
      Cs = Cs - 2.0 * (of_N * next.lead_FN);
      turn = turn - of_N * N * next.lead_NN;
    }
    out.F = 2.0 * out.delta / (C + sqrt(C * C + 4.0 * (out.A2 * out.delta)));
    out.tip_miss = at.u / l - out.cos + out.F * (0.5 * Cs + (1.0 / 3.0) * (out.F * A2s)) + turn;
  } else {
    // M5, M6 with the share `tip` of M10.
    const ThesisVariant variant = law == Law::kThesis ? p.variant : ThesisVariant();
    const bool at_rest = variant.stiffness_radius == ThesisVariant::StiffnessRadius::kRest;  // M35
    const S radius = at_rest ? S(r) : S((1.0 - terms.tip) * (0.5 * l / out.sin) + terms.tip * r);
    const bool at_theta = variant.stiffness_angle == ThesisVariant::StiffnessAngle::kTheta;  // M36
    const S arc = at_theta ? phi : S(0.5 * (phi + S(P(kPi))));
    const ArcShapes bent = at_theta ? shapes : ArcShapes(Value(arc));
    out.C = chord(radius, bent, arc);
    out.soft_F = out.delta / out.C;
    if (second_order) {
      const S grown = radius / r, grown2 = grown * grown;
      out.A2 =
          grown * grown2 * grown2 * softer2 * (r * unit * Lift(arc, bent.second_order.data(), 0));
      out.soft_F = 2.0 * out.delta / (out.C + sqrt(out.C * out.C + 4.0 * (out.A2 * out.delta)));
    }
    out.F = out.soft_F + terms.hardening / r * (out.delta * out.delta / out.C);
    const S turned = 0.5 * (out.F * Cs) + (1.0 / 3.0) * (out.F * out.F * C2s);
    out.tip_miss = at.u / l - out.cos + terms.tip * (turned + turn);
  }
  return out;
}

// M28: the ground under the foot sinks by c_g times the elastic part of the vertical force.
template <class S, class P>
S SinkMiss(const Parameters<P>& p, const Statics<S>& leg, const Situation<S>& at, const S& y) {
  return at.Y - y - p.law_terms.ground_compliance * (leg.F * at.Y / leg.l);
}

// Arc and height at equilibrium, with the inverse of the matrix of slopes of the two residuals.
struct Solution {
  bool found = false;
  double phi, Y;
  double inverse[2][2];
};

struct Question {
  const Parameters<double>& p;
  Law law;
  bool rolling;  // phi is unknown: else it is the root's
  double u0, y, torque, softer;
};

Solution Solve(const Question& q, ExtendedRoot& root) {
  constexpr int kMaxRounds = 30;
  constexpr double kStepTolerance = 1e-11;  // the step after it is below rounding
  using Dual = Jet<4>;                      // directions phi, Y, u0, y
  double phi = root.phi, sink = root.sink;
  if (root.u0 == root.u0) {
    const double du = q.u0 - root.u0, dy = q.y - root.y;
    if (q.rolling) phi += root.phi_u0 * du + root.phi_y * dy;
    sink += root.sink_u0 * du + root.sink_y * dy;
  }
  const double roll = q.rolling && IsElastic(q.law) ? q.p.r : 0.0;
  Solution s;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (q.rolling) phi = std::fmin(std::fmax(phi, 0.05), 2.0 * kPi - 0.05);
    const Dual angle = Seeded<Dual>(phi, 0, 1.0);
    Situation<Dual> at{Seeded<Dual>(q.u0, 2, 1.0), Seeded<Dual>(q.y + sink, 1, 1.0),
                       Dual(q.softer)};
    if (roll != 0.0) at.u += roll * angle;
    const Statics<Dual> leg = StaticsAt<Dual, double>(q.p, q.law, q.torque, angle, at);
    const Dual tip = q.rolling ? leg.tip_miss : angle - phi;
    const Dual ground = SinkMiss<Dual, double>(q.p, leg, at, Seeded<Dual>(q.y, 3, 1.0));
    const double determinant = tip.v[0] * ground.v[1] - tip.v[1] * ground.v[0];
    s.inverse[0][0] = ground.v[1] / determinant;
    s.inverse[0][1] = -tip.v[1] / determinant;
    s.inverse[1][0] = -ground.v[0] / determinant;
    s.inverse[1][1] = tip.v[0] / determinant;
    const auto solved = [&](int row, double a, double b) {
      return -(s.inverse[row][0] * a + s.inverse[row][1] * b);
    };
    const double step = solved(0, tip.a, ground.a), deeper = solved(1, tip.a, ground.a);
    if (!std::isfinite(step) || !std::isfinite(deeper)) return s;
    phi += std::abs(step) < 0.5 ? step : std::copysign(0.5, step);
    sink += deeper;
    if (std::abs(step) < kStepTolerance && std::abs(deeper) < kStepTolerance * q.p.r) {
      root = {.phi = phi, .sink = sink, .u0 = q.u0, .y = q.y};
      root.phi_u0 = solved(0, tip.v[2], ground.v[2]);
      root.sink_u0 = solved(1, tip.v[2], ground.v[2]);
      root.phi_y = solved(0, tip.v[3], ground.v[3]);
      root.sink_y = solved(1, tip.v[3], ground.v[3]) - 1.0;
      s.found = true;
      s.phi = phi;
      s.Y = q.y + sink;
      return s;
    }
  }
  return s;
}

// Arc and contact lead of a leg that stands under torque alone (M30), with the inverse of the
// matrix of slopes of M10 and of the deflection left for the chord force.
struct Footing {
  bool found = false;
  double phi, u;
  double inverse[2][2];
};

// From a guess of both; q.u0 is not used, and phi keeps its value unless q.rolling.
Footing FindFooting(const Question& q, double phi, double u) {
  constexpr int kMaxRounds = 30;
  constexpr double kStepTolerance = 1e-11;
  using Dual = Jet<4>;  // directions phi, u
  Footing f;
  for (int round = 0; round < kMaxRounds; ++round) {
    const Dual angle = Seeded<Dual>(phi, 0, 1.0);
    const Statics<Dual> leg = StaticsAt<Dual, double>(
        q.p, q.law, q.torque, angle, {Seeded<Dual>(u, 1, 1.0), Dual(q.y), Dual(q.softer)});
    const Dual tip = q.rolling ? leg.tip_miss : angle - phi;
    const double determinant = tip.v[0] * leg.delta.v[1] - tip.v[1] * leg.delta.v[0];
    f.inverse[0][0] = leg.delta.v[1] / determinant;
    f.inverse[0][1] = -tip.v[1] / determinant;
    f.inverse[1][0] = -leg.delta.v[0] / determinant;
    f.inverse[1][1] = tip.v[0] / determinant;
    const double turn = f.inverse[0][0] * tip.a + f.inverse[0][1] * leg.delta.a;
    const double shift = f.inverse[1][0] * tip.a + f.inverse[1][1] * leg.delta.a;
    if (!std::isfinite(turn) || !std::isfinite(shift)) return f;
    phi -= turn;
    u -= shift;
    if (!(phi > 0.05 && phi < 2.0 * kPi - 0.05) || std::abs(u) > 2.0 * q.p.r) return f;
    if (std::abs(turn) < kStepTolerance && std::abs(shift) < kStepTolerance * q.p.r) {
      f.found = true;
      f.phi = phi;
      f.u = u;
      return f;
    }
  }
  return f;
}

// dphi/dt = along_u0 du0/dt + rest at an equilibrium, from the slopes of both residuals.
template <class T>
struct ArcRate {
  T along_u0, rest;
};
template <class T>
ArcRate<T> RateOfArc(const Parameters<T>& p, Law law, const LegConditions<T>& at, const T* z,
                     const T& phi, const T& Y, const T& softer) {
  using S = Tangent<T>;
  struct Slopes {
    T tip, ground;
  };
  struct Direction {
    T phi, Y, u0, y, softer;
  };
  const auto along = [&](const Direction& d) {
    const S angle(phi, d.phi);
    Situation<S> there{S(z[kContact] - z[kX], d.u0), S(Y, d.Y), S(softer, d.softer)};
    if (IsElastic(law)) there.u = there.u + p.r * angle;
    const Statics<S> leg = StaticsAt<S, T>(p, law, at.torque, angle, there);
    return Slopes{leg.tip_miss.rate, SinkMiss<S, T>(p, leg, there, S(z[kY], d.y)).rate};
  };
  const T one(1.0), zero(0.0);
  const Slopes by_phi = along({one, zero, zero, zero, zero});
  const Slopes by_Y = along({zero, one, zero, zero, zero});
  const Slopes by_u0 = along({zero, zero, one, zero, zero});
  const T softening = -p.law_terms.stiffness_drift * softer * softer;
  const Slopes by_rest = along({zero, zero, zero, z[kVy], softening});
  const T determinant = by_phi.tip * by_Y.ground - by_phi.ground * by_Y.tip;
  const auto solved = [&](const Slopes& s) {
    return T((by_Y.tip * s.ground - by_Y.ground * s.tip) / determinant);
  };
  return {solved(by_u0), solved(by_rest)};
}

// What dphi/dt is multiplied by in M7, with r_d = l/(2 sin(phi/2)), or in its readings M32, M33.
template <class T>
T RadiusOfM7(const T& r, const ThesisVariant& variant, const Statics<T>& leg) {
  const bool at_rest = variant.rolling_radius == ThesisVariant::RollingRadius::kRest;
  const T radius = at_rest ? T(2.0 * r * leg.sin * leg.cos) : T(leg.l * leg.cos);
  return variant.angle_rate == ThesisVariant::AngleRate::kTheta ? radius : T(0.5 * radius);
}

template <class T>
T Softer(const Parameters<T>& p, const T& time) {
  return 1.0 / (1.0 + p.law_terms.stiffness_drift * (time + p.time_origin));
}

}  // namespace

template <class T>
LegLoad<T> ExtendedLeg<T>::Load(Mode mode, const T* z, const LegConditions<T>& at) const {
  const bool rolling = mode == Mode::kRolling;
  const T u0 = z[kContact] - z[kX];
  const T softer = Softer(p_, at.time);
  LegLoad<T> load;
  const Solution solution = Solve(
      {values_, law_, rolling, Value(u0), Value(z[kY]), Value(at.torque), Value(softer)}, root_);
  if (!solution.found) {
    const T nan(std::numeric_limits<double>::quiet_NaN());
    return {nan, nan, nan, nan, nan, nan, nan, nan, nan};
  }

  // Implicit function theorem: residuals at the root in duals, the unknowns held.
  T phi(solution.phi), Y(solution.Y);
  const bool rolls_on_arc = rolling && IsElastic(law_);
  const auto here = [&] { return Situation<T>{rolls_on_arc ? T(u0 + p_.r * phi) : u0, Y, softer}; };
  if constexpr (kJetWidth < T >> 0) {
    const Situation<T> there = here();
    const Statics<T> leg = StaticsAt<T, T>(p_, law_, at.torque, phi, there);
    const T tip = rolling ? leg.tip_miss : T(0.0);
    const T ground = SinkMiss<T, T>(p_, leg, there, z[kY]);
    const auto& m = solution.inverse;
    phi -= m[0][0] * tip + m[0][1] * ground;
    Y -= m[1][0] * tip + m[1][1] * ground;
  }
  const Situation<T> there = here();
  const Statics<T> leg = StaticsAt<T, T>(p_, law_, at.torque, phi, there);
  load.u = there.u;
  load.y = Y;
  load.l = leg.l;
  load.phi = phi;
  load.elastic_force = leg.F;
  load.tip_miss = leg.tip_miss;
  load.contact_rate = T(0.0);
  load.slip_gain = T(1.0);
  const T w = (Y * z[kVy] - load.u * z[kVx]) / load.l;  // M12
  load.damping_rate = w;
  if (!rolling || (IsElastic(law_) && !p_.law_terms.rolling_active)) return load;

  // M27: dx_c/dt = rho dphi/dt, the foot's creeping added by the caller.
  const T& blend = p_.law_terms.rolling;
  const ThesisVariant variant = law_ == Law::kThesis ? p_.variant : ThesisVariant();
  const T full = p_.r, flat = RadiusOfM7(p_.r, variant, leg);  // M8, M11; M7
  const T rho = law_ == Law::kThesis ? T((1.0 - blend) * flat + blend * full)
                                     : T((1.0 - blend) * full + blend * flat);
  const T beyond = IsElastic(law_) ? T(rho - full) : rho;  // X0 moves by what is not rolled off
  const ArcRate<T> rate = RateOfArc(p_, law_, at, z, phi, Y, softer);
  if (variant.rolling == ThesisVariant::Rolling::kImplicit)
    load.slip_gain = 1.0 / (1.0 - beyond * rate.along_u0);
  load.contact_rate = load.slip_gain * beyond * (rate.rest - rate.along_u0 * z[kVx]);
  if (!IsElastic(law_) && variant.damping_rate != ThesisVariant::DampingRate::kHip) {  // M34
    T seen = w + load.u * load.contact_rate / load.l;
    if (variant.damping_rate == ThesisVariant::DampingRate::kDeflection)
      seen -= p_.r * leg.cos * (rate.rest + rate.along_u0 * (load.contact_rate - z[kVx]));
    load.damping_rate = (1.0 - p_.law_terms.tip) * seen + p_.law_terms.tip * w;
  }
  return load;
}

template <class T>
Mode ExtendedLeg<T>::Settle(Mode mode, T* z, const LegConditions<T>& at) {
  if (!p_.law_terms.torque_active) return mode;
  const T& y = z[kY];
  const T softer = Softer(p_, at.time);
  const bool elastic = IsElastic(law_);
  double phi = root_.phi;
  double u =
      mode == Mode::kRolling ? Value(p_.r) * std::sin(phi) : Value(z[kContact]) - Value(z[kX]);
  Footing footing = FindFooting(
      {values_, law_, mode == Mode::kRolling, 0.0, Value(y), Value(at.torque), Value(softer)}, phi,
      u);
  if (footing.found && footing.phi > kPi) {  // past the toe
    mode = Mode::kToe;
    footing = FindFooting({values_, law_, false, 0.0, Value(y), Value(at.torque), Value(softer)},
                          kPi, -0.5 * Value(p_.r));
  }
  if (!footing.found) return mode;
  T arc(footing.phi), lead(footing.u);
  if constexpr (kJetWidth < T >> 0) {
    const Statics<T> leg = StaticsAt<T, T>(p_, law_, at.torque, arc, {lead, y, softer});
    const T tip = mode == Mode::kRolling ? leg.tip_miss : T(0.0);
    const auto& m = footing.inverse;
    arc -= m[0][0] * tip + m[0][1] * leg.delta;
    lead -= m[1][0] * tip + m[1][1] * leg.delta;
  }
  z[kContact] = z[kX] + lead;
  if (elastic && mode == Mode::kRolling) z[kContact] -= p_.r * arc;
  StartRootAt(footing.phi);
  return mode;
}

template <class T>
T ExtendedLeg<T>::StrainEnergy(Mode, const LegLoad<T>& load, const LegConditions<T>& at) const {
  const Statics<T> leg =
      StaticsAt<T, T>(p_, law_, at.torque, load.phi, {load.u, load.y, Softer(p_, at.time)});
  const T lift = leg.F * load.y / load.l;
  const T ground = 0.5 * p_.law_terms.ground_compliance * lift * lift;
  if (IsElastic(law_)) return leg.F * leg.F * (0.5 * leg.C + 2.0 / 3.0 * leg.F * leg.A2) + ground;
  const T hardening = p_.law_terms.hardening / (law_ == Law::kStraightLeg ? p_.l0 : p_.r);
  const T& F = leg.soft_F;
  return F * F * (0.5 * leg.C + 2.0 / 3.0 * F * leg.A2) +
         hardening * leg.delta * leg.delta * leg.delta / (3.0 * leg.C) + ground;
}

template class ExtendedLeg<double>;
template class ExtendedLeg<Jet<1>>;
template class ExtendedLeg<Jet<kNarrowJet>>;
template class ExtendedLeg<Jet<kWideJet>>;

}  // namespace hoplab
