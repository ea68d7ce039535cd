#pragma once

#include <cstddef>
#include <utility>
#include <variant>

#include "model/laws/clamped/clamped_arc.h"
#include "model/laws/clamped/clamped_rod.h"
#include "model/mechanisms/robot_leg_bending.h"
#include "model/parameters.h"

namespace hoplab {

/// A leg of a robot, of the kind its parameters say: each function is that of ClampedArc or of
/// ClampedRod.
template <class T>
class RobotLeg {
 public:
  RobotLeg() = default;
  /// The leg at place `i` of a robot, effects on it included (M78).
  RobotLeg(const Parameters<T>& p, std::size_t i) {
    const RobotParameters<T>& robot = *p.robot;
    const T& tau = tau_ = robot.damping + robot.extra_damping[i];
    if (robot.straight_legs) {
      law_ = ClampedRod<T>(p.l0, robot.E_scale[i] * p.k, robot.E_scale[i] * robot.lateral_stiffness,
                           tau, robot.friction);
    } else {
      const T& E = robot.own_moduli ? robot.E[i] : p.E;
      const T EI = robot.E_scale[i] * E * p.I;
      using std::pow;
      law_ = ClampedArc<T>(p.r, EI, tau, robot.friction, robot.clamp, robot.ground_compliance);
      made_bending_stiffness_ = FirstBending().stiffness * EI / (p.r * p.r * p.r) *
                                pow(length() / kPi, -LegBending::kByClamp);
      bending_stiffness_ = made_bending_stiffness_;
    }
  }
  /// From here on it is `share` times as stiff as it was made, in every way.
  void SetStiffness(const T& share) const {
    Ask([&](const auto& leg) { leg.SetStiffness(share); });
    bending_stiffness_ = share * made_bending_stiffness_;
  }

  /// Whether it stands on its side, too, and rolls there.
  bool rolls() const {
    return Ask([](const auto& leg) { return leg.kRolls; });
  }
  double size() const {
    return Ask([](const auto& leg) { return leg.size(); });
  }
  const T& length() const {
    return Ask([](const auto& leg) -> const T& { return leg.length(); });
  }

  void StartAt(double tip) {
    Ask([&](auto& leg) { leg.StartAt(tip); });
  }
  void Restart() {
    Ask([](auto& leg) { leg.Restart(); });
  }
  void Save(DiscreteState& to) const {
    Ask([&](const auto& leg) { leg.Save(to); });
  }
  void Load(DiscreteState& from) {
    Ask([&](auto& leg) { leg.Load(from); });
  }

  T Reach(const T& angle) const {
    return Ask([&](const auto& leg) { return leg.Reach(angle); });
  }
  ClampedLanding<T> LandsAs(const T& angle) const {
    return Ask([&](const auto& leg) { return leg.LandsAs(angle); });
  }
  const T& unit_length() const {
    return Ask([](const auto& leg) -> const T& { return leg.unit_length(); });
  }
  Vector2<double> Centre(double angle) const {
    return Ask([&](const auto& leg) { return leg.Centre(angle); });
  }
  /// Of an arc's first mode in the air [N/m] (M98), and the retardation time of its material [s].
  const T& bending_stiffness() const { return bending_stiffness_; }
  const T& tau() const { return tau_; }
  double inertia() const {
    return Ask([](const auto& leg) { return leg.kInertia; });
  }

  ClampedLoad<T> At(const Footing& foot, const ClampedPlace<T>& place, bool damping = true,
                    bool with_slip = false) const {
    return Ask([&](const auto& leg) { return leg.At(foot, place, damping, with_slip); });
  }
  void FillLoad(const Footing& foot, const ClampedPlace<T>& place, ClampedLoad<T>& load) const {
    Ask([&](const auto& leg) { leg.FillLoad(foot, place, true, false, load); });
  }
  T StrainEnergy(const Footing& foot, const ClampedPlace<T>& place) const {
    return Ask([&](const auto& leg) { return leg.StrainEnergy(foot, place); });
  }

  bool CanSlide(double way, const Footing& foot, const ClampedPlace<T>& place) const {
    return Ask([&](const auto& leg) { return leg.CanSlide(way, foot, place); });
  }
  double SlidesAtLanding(double tip, double base, double vx, double vy) const {
    return Ask([&](const auto& leg) { return leg.SlidesAtLanding(tip, base, vx, vy); });
  }
  bool PressesAtLanding(double tip, double base, double vx, double vy) const {
    return Ask([&](const auto& leg) { return leg.PressesAtLanding(tip, base, vx, vy); });
  }

 private:
  template <class Do>
  decltype(auto) Ask(const Do& what) const {
    if (const auto* rod = std::get_if<ClampedRod<T>>(&law_)) return what(*rod);
    return what(*std::get_if<ClampedArc<T>>(&law_));
  }
  template <class Do>
  decltype(auto) Ask(const Do& what) {
    if (auto* rod = std::get_if<ClampedRod<T>>(&law_)) return what(*rod);
    return what(*std::get_if<ClampedArc<T>>(&law_));
  }

  std::variant<ClampedArc<T>, ClampedRod<T>> law_;
  T made_bending_stiffness_{0.0}, tau_{0.0};
  mutable T bending_stiffness_{0.0};
};

}  // namespace hoplab
