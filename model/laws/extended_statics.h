#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <type_traits>

#include "model/effects/effect.h"
#include "model/laws/arc_shapes.h"
#include "model/laws/beyond_m2b.h"
#include "model/laws/outline.h"
#include "model/laws/sole.h"
#include "model/leg_compliance.h"
#include "model/parameters.h"

namespace hoplab {

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

inline bool IsElastic(Law law) {
  return law == Law::kConsistent || law == Law::kLargeDeflection || law == Law::kElastica;
}

// What the state says to the leg, in a scalar that may be differentiated.
template <class S>
struct Situation {
  S phi;     // contact arc [rad]
  S l;       // chord length [m]
  S softer;  // E at the start of the trial over E now
  // Near the force that is sought, if one is known.
  double F_near = std::numeric_limits<double>::quiet_NaN();
};

// The leg at an arc and a chord, in equilibrium or not.
template <class S>
struct Statics {
  S sin, cos, delta, C, A2, F;
  S soft_F;    // what its energy goes by: F without leg_hardening, where that is a share of a
               // spring's force; of a leg with an outline, what bends it
  S tip_turn;  // M10 (M10b, M25) is u/l + tip_turn = 0
  S beyond;    // strain energy that M2b has not (M65) [J]; not along the arc or the chord
};

// P: scalar of the parameters, S of the unknowns.

template <class S, class P>
void SetStraight(const Parameters<P>& p, const Situation<S>& at, Statics<S>& out) {
  out.delta = p.l0 - at.l;
  out.C = at.softer / p.k;
  out.soft_F = out.delta / out.C;
  out.F = out.soft_F * (P(1.0) + p.law_terms.hardening / p.l0 * out.delta);
}

// What the statics of an arc are made of.
template <class S, class P>
struct ArcParts {
  const Parameters<P>& p;
  const Situation<S>& at;
  ArcShapes shapes;
  P flex, stretch, slide;  // M2: r^3 flex f + r stretch a + r slide s
  S bending1, Cs;          // slopes of the chord's compliance
  bool is_exact, second_order;
  S N, turn;  // M24, M25: the normal force N bends the leg and turns its tip; 0 where M121 does
  P unit;     // M2b, by the law or by the share an effect brings in
  S softer2, C2s;
  P t;  // M121: the hip torque, in E I/r

  S Lifted(const auto& shape, int k) const { return Lift(at.phi, shape.data(), k); }
  // Chord compliance of an arc of another radius, and its derivative dC/ds at the rest radius.
  S ChordOf(const auto& radius, const ArcShapes& of, const S& arc) const {
    const auto shape = [&](const auto& derivatives) { return Lift(arc, derivatives.data(), 0); };
    return at.softer * (radius * radius * radius * flex * shape(of.bending) +
                        radius * stretch * shape(of.axial)) +
           radius * slide * shape(of.shear);
  }

  SoleSecondOrder<S> SecondOrderOfSole() const {
    return SoleSecondOrderOf<S, P>(at.phi, Lifted(shapes.sin, 0), Lifted(shapes.cos, 0),
                                   0.5 * Lifted(shapes.bending, 0), 0.5 * Lifted(shapes.bending, 1),
                                   Lifted(shapes.second_order, 0), Lifted(shapes.second_order, 1));
  }

  ArcParts(const Parameters<P>& parameters, Law law, const P& torque, const Situation<S>& given)
      : p(parameters),
        at(given),
        shapes(Value(given.phi)),
        flex(1.0 / (2.0 * p.E * p.I)),
        stretch(1.0 / (2.0 * p.E * p.A)),
        slide(p.kappa / (2.0 * p.G * p.A)),
        bending1(at.softer * (p.r * p.r * flex * Lifted(shapes.bending, 1))),
        Cs(bending1 + at.softer * (stretch * Lifted(shapes.axial, 1)) +
           slide * Lifted(shapes.shear, 1)),
        is_exact(law == Law::kElastica),
        second_order(is_exact || law == Law::kLargeDeflection || p.law_terms.second_order_active),
        N(is_exact ? S(P(0.0)) : S(torque / at.l)),
        turn(N * (at.softer * (0.5 * p.r * p.r * flex * Lifted(shapes.bending, 2)))),
        unit((is_exact || law == Law::kLargeDeflection ? P(1.0) : p.law_terms.second_order) *
             (4.0 * p.r * p.r * p.r * p.r * flex * flex)),
        softer2(at.softer * at.softer),
        C2s(softer2 * (unit * Lifted(shapes.second_order, 1))),
        t(2.0 * p.r * flex * torque) {}
};

// What the search for F has found, in values: f is the load of its last round but for that step.
struct ForceOfChord {
  double F, f;
  elastica::Derivatives<2> G;
  elastica::TorqueBending bent;  // M121, if the leg is driven
};
// M65: F from the chord, by Newton. `per_N`: f over F; `now`: the share of what M2b has not, times
// r; `t`: the torque at the hip, if one bends the leg.
template <class S, class P>
ForceOfChord FindForce(const ArcParts<S, P>& arc, double C, const Statics<S>& out, double per_N,
                       double now, std::optional<double> t) {
  constexpr double kLastStep = kOfSearch<S> ? 1e-6 : 1e-8;  // over the greatest force
  const double phi = Value(arc.at.phi), r = Value(arc.p.r), A2 = Value(out.A2);
  const double delta = Value(out.delta), scale = elastica::LoadScale(phi) * per_N;
  const double least = elastica::kLoadBegin / scale, most = elastica::kLoadEnd / scale;
  const double C0 = C - 0.5 * now * per_N * arc.shapes.bending[0];
  const double A0 = A2 - now * per_N * per_N * arc.shapes.second_order[0];
  ForceOfChord at{};
  // At first that of M2b.
  at.F = std::isnan(arc.at.F_near) ? 2.0 * delta / (C + std::sqrt(C * C + 4.0 * A2 * delta))
                                   : arc.at.F_near;
  for (int round = 0; round < 30; ++round) {
    double& F = at.F;
    F = F < most ? (F > least ? F : least) : most;  // NaN is most
    const double f = at.f = per_N * F;
    const auto& G = at.G = elastica::EnergyTo2(phi, f);
    if (t) at.bent = TorqueBendingFor<S>(phi, f, *t);
    const double miss = F * (C0 + A0 * F) + now * f * (2.0 * G[0][0] + f * G[0][1]) -
                        r * at.bent.chord[0][0] - delta;
    const double step = miss / (C0 + 2.0 * A0 * F - r * per_N * at.bent.chord[0][1] +
                                now * per_N * (2.0 * G[0][0] + f * (4.0 * G[0][1] + f * G[0][2])));
    F -= step;
    if (!(std::abs(step) > kLastStep * most)) break;
  }
  if (t) MoveLoad<S>(phi, at.f, *t, per_N * at.F - at.f, at.bent);
  return at;
}

// M65: a round more in the slopes of what FindForce has found brings the first derivatives in, and
// one with all derivatives the second ones. Newton's error is squared at each round, so a small
// step is the last.
template <class S, class P>
void AddBeyondM2b(const ArcParts<S, P>& arc, const S& C, const S& Cs, const S& A2s, const S& turn,
                  Statics<S>& out) {
  const Situation<S>& at = arc.at;
  const P& r = arc.p.r;
  const LawTerms<P>& terms = arc.p.law_terms;
  const P blend = arc.is_exact ? P(1.0 + terms.higher_order) : terms.higher_order;
  const S unit_f = at.softer * (2.0 * r * r * arc.flex);  // f over F
  const double phi_now = Value(at.phi), per_N = Value(unit_f), now = Value(blend) * Value(r);
  const bool is_driven = arc.is_exact && terms.torque_active;
  const S t = at.softer * arc.t, t_moved = t - S(P(Value(t)));
  const auto [F_found, f, G, bent] =
      FindForce(arc, Value(C), out, per_N, now, is_driven ? std::optional(Value(t)) : std::nullopt);
  double F = F_found;
  if (!elastica::InDomain(phi_now, per_N * F)) F = std::numeric_limits<double>::quiet_NaN();
  const auto table = EnergyNear<S>(phi_now, per_N * F, f, G);
  const SlopesBeyondM2b by = SlopesAt(per_N * F, table, arc.shapes);
  const double slope = Value(C) + 2.0 * Value(out.A2) * F + now * per_N * by.chord_f -
                       Value(r) * per_N * bent.chord[0][1];
  S moved =
      now * by.chord_phi * (at.phi - S(P(phi_now))) + now * by.chord_f * F * (unit_f - S(P(per_N)));
  moved = moved + S(P(by.chord * (blend * r)));
  if (is_driven) moved = moved - r * BentByTorqueAt(at.phi, S(P(F) * unit_f), t_moved, bent).chord;
  const S first = F * (C + F * out.A2) + moved - out.delta;
  out.F = S(P(F)) - (1.0 / slope) * first;
  BeyondM2b<S> more =
      BeyondM2bAt<S>(at.phi, unit_f * out.F, table, arc.shapes.bending, arc.shapes.second_order);
  BentByTorque<S> driven{S(P(0.0)), S(P(0.0))};
  if (is_driven) driven = BentByTorqueAt(at.phi, unit_f * out.F, t_moved, bent);
  const S miss =
      out.F * (C + out.A2 * out.F) + (blend * r) * more.chord - r * driven.chord - out.delta;
  const S next = (-1.0 / slope) * miss;
  out.F = out.F + next;
  more.turn = more.turn + (per_N * by.turn_f) * next;
  driven.lead = driven.lead + (per_N * bent.lead[0][1]) * next;
  more.energy = more.energy + (per_N * (per_N * F) * by.chord_f) * next;
  out.tip_turn =
      out.F * (0.5 * Cs + (1.0 / 3.0) * (out.F * A2s)) + blend * more.turn + turn - out.cos;
  if (is_driven) out.tip_turn = out.tip_turn - driven.lead;
  if constexpr (!kIsTangent<S>)
    out.beyond = (blend / (2.0 * r * arc.flex)) * (more.energy / at.softer);
}

// A law of static equilibrium.
template <class S, class P>
void SetElastic(const ArcParts<S, P>& arc, Statics<S>& out) {
  using std::sqrt;
  const P& r = arc.p.r;
  const LawTerms<P>& terms = arc.p.law_terms;
  out.C = arc.ChordOf(r, arc.shapes, arc.at.phi);
  S Cs = arc.Cs, turn = arc.turn, A2s = out.A2;
  if (!IsZero(terms.hardening)) {  // M26: takes from C2
    const P hardening = terms.hardening / r;
    out.A2 = P(-hardening) * (out.C * out.C);
    A2s = -2.0 * (hardening * (out.C * Cs));
  }
  if (arc.second_order) {
    out.A2 = out.A2 + arc.softer2 * (r * arc.unit * arc.Lifted(arc.shapes.second_order, 0));
    A2s = A2s + arc.C2s;
    if (terms.sole_active) {
      const auto sole = arc.SecondOrderOfSole();
      const P unit = terms.sole * arc.unit;
      out.A2 = out.A2 + arc.softer2 * (unit * sole.value);
      A2s = A2s + arc.softer2 * (unit / r * sole.slope);
    }
  }
  S C = out.C;
  if (terms.torque_active && arc.second_order && !arc.is_exact) {
    const SecondOrderAcross<S> next = SecondOrderAcrossAt(arc.at.phi, out.sin, out.cos);
    const S of_N = arc.softer2 * (arc.unit * arc.N);
    out.delta = out.delta + r * (of_N * arc.N * next.chord_NN);
    C = C - r * (of_N * next.chord_FN);
    Cs = Cs - 2.0 * (of_N * next.lead_FN);
    turn = turn - of_N * arc.N * next.lead_NN;
  }
  if (arc.is_exact || terms.higher_order_active) return AddBeyondM2b(arc, C, Cs, A2s, turn, out);
  out.F = 2.0 * out.delta / (C + sqrt(C * C + 4.0 * (out.A2 * out.delta)));
  out.tip_turn = out.F * (0.5 * Cs + (1.0 / 3.0) * (out.F * A2s)) + turn - out.cos;
}

// M5, M6 with the share `tip` of M10.
template <class S, class P>
void SetSpring(const ArcParts<S, P>& arc, const ThesisReading& reading, Statics<S>& out) {
  using std::sqrt;
  const P& r = arc.p.r;
  const LawTerms<P>& terms = arc.p.law_terms;
  const S& phi = arc.at.phi;
  const bool at_rest = reading.stiffness_radius == ThesisReading::StiffnessRadius::kRest;  // M35
  const S radius =
      at_rest ? S(r) : S((1.0 - terms.tip) * (0.5 * arc.at.l / out.sin) + terms.tip * r);
  const bool at_theta = reading.stiffness_angle == ThesisReading::StiffnessAngle::kTheta;  // M36
  const S bent_arc = at_theta ? phi : S(0.5 * (phi + S(P(std::numbers::pi))));
  const ArcShapes bent = at_theta ? arc.shapes : ArcShapes(Value(bent_arc));
  out.C = arc.ChordOf(radius, bent, bent_arc);
  out.soft_F = out.delta / out.C;
  if (arc.second_order) {
    const S grown = radius / r, grown2 = grown * grown;
    out.A2 = grown * grown2 * grown2 * arc.softer2 *
             (r * arc.unit * Lift(bent_arc, bent.second_order.data(), 0));
    out.soft_F = 2.0 * out.delta / (out.C + sqrt(out.C * out.C + 4.0 * (out.A2 * out.delta)));
  }
  out.F = out.soft_F + terms.hardening / r * (out.delta * out.delta / out.C);
  const S turned = 0.5 * (out.F * arc.Cs) + (1.0 / 3.0) * (out.F * out.F * arc.C2s);
  out.tip_turn = terms.tip * (turned + arc.turn) - out.cos;
}

// M113, M124: the law of the strip under lambda F, its chord and its tip's turn seen from the
// ground under it.
template <class S, class P>
void SetOnOutline(const Parameters<P>& p, Law law, const P& torque, Situation<S> at,
                  Statics<S>& out) {
  const P outside = p.r + p.law_terms.sole;
  const Outline<S> outline = OutlineAt(at.phi, p.r, p.law_terms);
  at.F_near *= Value(outline.spread);
  const ArcParts<S, P> arc(p, law, torque, at);
  const S chord = outline.rest - at.l - p.r * (arc.N * arc.bending1);
  out.delta = chord / outline.spread;
  SetElastic(arc, out);
  out.soft_F = out.F;
  out.F = out.F / outline.spread;
  out.tip_turn = (p.r / outside) * (outline.spread * (out.tip_turn + out.cos)) - outline.lead +
                 (1.0 / outside) * (outline.spread_slope * chord);
}

template <class S, class P>
[[gnu::flatten]] Statics<S> StaticsAt(const Parameters<P>& p, Law law, const P& torque,
                                      const Situation<S>& at) {
  const S zero(P(0.0));
  Statics<S> out{zero, zero, zero, zero, zero, zero, zero, zero, zero};
  if (law == Law::kStraightLeg) {
    SetStraight(p, at, out);
    return out;
  }
  const ArcParts<S, P> arc(p, law, torque, at);
  out.sin = arc.Lifted(arc.shapes.sin, 0);
  out.cos = arc.Lifted(arc.shapes.cos, 0);
  out.delta = 2.0 * (p.r * out.sin) - at.l - p.r * (arc.N * arc.bending1);
  if (p.law_terms.HasOutline())
    SetOnOutline(p, law, torque, at, out);
  else if (IsElastic(law))
    SetElastic(arc, out);
  else
    SetSpring(arc, law == Law::kThesis ? p.reading : ThesisReading(), out);
  return out;
}

}  // namespace hoplab
