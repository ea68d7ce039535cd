#pragma once

#include <boost/container/static_vector.hpp>
#include <cmath>

#include "base/check.h"
#include "model/effects/effect.h"
#include "model/formula/formula.h"
#include "model/hybrid/automaton.h"

namespace hoplab {

/// The effects that act in one run, in the scalar type of the run. Only effects off their null, or
/// whose parameter is differentiated, are in it: the others cost nothing and change nothing. They
/// act in ascending EffectInfo::order, those of one order as they were added.
template <class T>
class ActiveEffects {
 public:
  static constexpr int kMax = 56;
  /// Corners of formulas at which a run's solver stops; further ones are crossed inside a step.
  static constexpr int kMaxCorners = 16;

  void Add(const Effect& effect, const std::array<T, kMaxEffectParameters>& values) {
    HOPLAB_CHECK(entries_.size() < kMax);
    auto place = entries_.end();
    while (place != entries_.begin() && (place - 1)->effect->info.order > effect.info.order)
      --place;
    entries_.insert(place, {&effect.Hooks<T>(), values, &effect, {}});
    if (effect.formula) FindCorners();
  }

  /// The same effects in another scalar type; directions are dropped.
  template <class To>
  ActiveEffects<To> Convert() const {
    ActiveEffects<To> to;
    for (const Entry& e : entries_) {
      std::array<To, kMaxEffectParameters> values;
      for (int i = 0; i < kMaxEffectParameters; ++i) values[i] = To(Value(e.values[i]));
      to.Add(*e.effect, values);
    }
    return to;
  }

  void ChangeParameters(Parameters<T>& parameters) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_parameters) e.hooks->change_parameters(e.values.data(), parameters);
      if (e.effect->formula) e.effect->formula->ChangeParameters(parameters);
    }
  }
  Vector2<T> BodyForce(const BodyMotion<T>& body) const {
    Vector2<T> force{T(0.0), T(0.0)};
    for (const Entry& e : entries_) {
      if (e.hooks->add_body_force) e.hooks->add_body_force(e.values.data(), body, force);
      if (e.effect->formula)
        e.effect->formula->AddBodyForce(e.values.data(), SidesOf(e), body, force);
    }
    return force;
  }
  T ChordForce(const ChordMotion<T>& chord) const {
    T force(0.0);
    for (const Entry& e : entries_) {
      if (e.hooks->add_chord_force) e.hooks->add_chord_force(e.values.data(), chord, force);
      if (e.effect->formula)
        e.effect->formula->AddChordForce(e.values.data(), SidesOf(e), chord, force);
    }
    return force;
  }
  /// `load_known`: all of `hip` is, not its torque, time and speed alone.
  void AddHipTorque(const HipMotion<T>& hip, T& torque, bool load_known = true) const {
    for (const Entry& e : entries_) {
      if (e.hooks->add_hip_torque) e.hooks->add_hip_torque(e.values.data(), hip, torque);
      const Formula* const formula = e.effect->formula;
      if (formula && (load_known || !formula->needs_load()))
        formula->AddHipTorque(e.values.data(), SidesOf(e), hip, torque);
    }
  }
  T JointTorque(const JointMotion<T>& joint) const {
    T torque(0.0);
    for (const Entry& e : entries_) {
      if (e.hooks->add_joint_torque) e.hooks->add_joint_torque(e.values.data(), joint, torque);
    }
    return torque;
  }
  void ChangeLandingVelocity(const Landing<T>& landing, Vector2<T>& velocity) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_landing_velocity)
        e.hooks->change_landing_velocity(e.values.data(), landing, velocity);
      if (e.effect->formula)
        e.effect->formula->ChangeLandingVelocity(e.values.data(), landing, velocity);
    }
  }
  void ChangeLiftoffVelocity(const Landing<T>& leaving, Vector2<T>& velocity) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_liftoff_velocity)
        e.hooks->change_liftoff_velocity(e.values.data(), leaving, velocity);
    }
  }
  T ContactHeight(T height) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_contact_height) e.hooks->change_contact_height(e.values.data(), height);
    }
    return height;
  }
  T Restitution(const T& speed, T restitution) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_restitution)
        e.hooks->change_restitution(e.values.data(), speed, restitution);
      if (e.effect->formula)
        e.effect->formula->ChangeRestitution(e.values.data(), speed, restitution);
    }
    return restitution;
  }
  void ChangeBounceSpeed(const Bounce<T>& bounce, T& vx) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_bounce_speed) e.hooks->change_bounce_speed(e.values.data(), bounce, vx);
    }
  }
  T TouchdownAngle(const PlacementMotion<T>& leg, T theta_td) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_touchdown_angle)
        e.hooks->change_touchdown_angle(e.values.data(), leg.vx, theta_td);
      if (e.effect->formula)
        e.effect->formula->ChangeTouchdownAngle(e.values.data(), SidesOf(e), leg, theta_td);
    }
    return theta_td;
  }
  T ObservationTime(T t) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_observation_time) e.hooks->change_observation_time(e.values.data(), t);
    }
    return t;
  }
  T PoseTime(T t) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_pose_time) e.hooks->change_pose_time(e.values.data(), t);
    }
    return ObservationTime(t);
  }
  /// `t`: when it was seen, since the trial's first row [s].
  void ChangeObservation(const T& t, Observation<T>& seen) const {
    for (const Entry& e : entries_) {
      if (e.hooks->change_observation) e.hooks->change_observation(e.values.data(), seen);
      if (e.effect->formula) e.effect->formula->ChangeObservation(e.values.data(), t, seen);
    }
  }
  /// What is there at all, so that what is not costs nothing.
  bool HasBodyForce() const {
    return Any([](const EffectHooks<T>& hooks) { return hooks.add_body_force != nullptr; }) ||
           AnyFormula([](const Formula& f) { return f.place() <= FormulaPlace::kBodyForceAcross; });
  }
  bool HasObservationChange() const {
    return Any([](const EffectHooks<T>& hooks) { return hooks.change_observation != nullptr; });
  }
  bool HasPoseTime() const {
    return Any([](const EffectHooks<T>& hooks) { return hooks.change_pose_time != nullptr; });
  }
  bool HasChordForce() const {
    return Any([](const EffectHooks<T>& hooks) { return hooks.add_chord_force != nullptr; }) ||
           HasFormula(FormulaPlace::kChordForce);
  }
  bool HasHipTorque() const {
    return Any([](const EffectHooks<T>& hooks) { return hooks.add_hip_torque != nullptr; }) ||
           HasFormula(FormulaPlace::kHipTorque);
  }
  bool HasChordFormula() const { return HasFormula(FormulaPlace::kChordForce); }
  bool HasHipFormula() const { return HasFormula(FormulaPlace::kHipTorque); }
  bool HasJointTorque() const {
    return Any([](const EffectHooks<T>& hooks) { return hooks.add_joint_torque != nullptr; });
  }
  /// A torque on the hip that has to know the leg's load or motion.
  bool HasTorqueOfLoad() const {
    return HasJointTorque() || std::any_of(entries_.begin(), entries_.end(), [](const Entry& e) {
             return e.effect->formula && e.effect->formula->needs_load();
           });
  }
  bool HasLiftoffVelocity() const {
    return Any(
        [](const EffectHooks<T>& hooks) { return hooks.change_liftoff_velocity != nullptr; });
  }
  bool HasTouchdownAngle() const {
    return Any([](const EffectHooks<T>& hooks) {
             return hooks.change_touchdown_angle != nullptr;
           }) ||
           HasFormula(FormulaPlace::kTouchdownAngle);
  }
  /// The touch-down angle moves along a flight of constant vx.
  bool TouchdownAngleFalls() const {
    return AnyFormula([](const Formula& f) {
      return f.place() == FormulaPlace::kTouchdownAngle && f.Uses(FormulaVariable::kVy);
    });
  }

  // Corners of the formulas: guards that a mechanism adds to its own. On which side of each the run
  // is, is a discrete state.

  int corner_count() const { return static_cast<int>(corners_.size()); }
  GuardSpec CornerSpec(int i) const {
    const Corner& c = corners_[static_cast<std::size_t>(i)];
    const FormulaCorner& corner = FormulaOf(c).corners()[static_cast<std::size_t>(c.corner)];
    return {EventKind::kCorner, corner.scale, std::nullopt, c.is_smooth};
  }
  /// Their guards, of those that act; open for the others.
  void CornerGuards(const Motions<T>& motions, T* g) const {
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      T argument(0.0);
      g[i] = T(1.0);
      if (!ArgumentOf(corners_[i], motions, argument)) continue;
      const int side = corners_[i].side;
      if (side != 0) {
        g[i] = side > 0 ? argument : T(-argument);
      } else {
        // On the corner: until it has left it either way.
        g[i] = kOnCorner * CornerSpec(static_cast<int>(i)).scale -
               (Value(argument) < 0.0 ? T(-argument) : argument);
      }
    }
  }
  /// Takes the side of each corner from where things are.
  void SeatCorners(const Motions<T>& motions) {
    for (Corner& c : corners_) {
      T argument(0.0);
      if (!ArgumentOf(c, motions, argument)) continue;
      const FormulaCorner& corner = FormulaOf(c).corners()[static_cast<std::size_t>(c.corner)];
      const double value = Value(argument);
      c.side = std::abs(value) <= kAtZero * corner.scale ? 0 : SignOf(value);
    }
  }
  void CrossCorner(int i, const Motions<T>& motions) {
    Corner& c = corners_[static_cast<std::size_t>(i)];
    T argument(0.0);
    if (c.side != 0)
      c.side = -c.side;
    else if (ArgumentOf(c, motions, argument))
      c.side = SignOf(Value(argument));
  }
  /// It is met and not crossed: the run is on it until it leaves it.
  void TouchCorner(int i) { corners_[static_cast<std::size_t>(i)].side = 0; }
  template <class State>
  void SaveCorners(State& to) const {
    for (const Corner& c : corners_) to.Put(c.side);
  }
  template <class State>
  void LoadCorners(State& from) {
    for (Corner& c : corners_) c.side = static_cast<int>(from.Take());
  }

 private:
  template <class Predicate>
  bool Any(const Predicate& holds) const {
    for (const Entry& e : entries_) {
      if (holds(*e.hooks)) return true;
    }
    return false;
  }

  template <class Predicate>
  bool AnyFormula(const Predicate& holds) const {
    for (const Entry& e : entries_) {
      if (e.effect->formula && holds(*e.effect->formula)) return true;
    }
    return false;
  }
  bool HasFormula(FormulaPlace place) const {
    return AnyFormula([place](const Formula& f) { return f.place() == place; });
  }

  struct Entry {
    const EffectHooks<T>* hooks;
    std::array<T, kMaxEffectParameters> values;
    const Effect* effect;
    /// Where among corners_ its formula's are; -1: not watched.
    std::array<signed char, kMaxFormulaCorners> corners;
  };
  struct Corner {
    int entry = 0, corner = 0;
    int side = 0;
    bool is_smooth = false;
  };
  /// A run that begins on a corner leaves it at this part of its scale.
  static constexpr double kOnCorner = 1e-9;

  static int SignOf(double value) { return value > 0.0 ? 1 : value < 0.0 ? -1 : 0; }
  const Formula& FormulaOf(const Corner& c) const {
    return *entries_[static_cast<std::size_t>(c.entry)].effect->formula;
  }
  CornerSides SidesOf(const Entry& e) const {
    CornerSides sides;
    for (std::size_t k = 0; k < sides.size(); ++k)
      sides[k] =
          e.corners[k] < 0 ? kFreeSide : corners_[static_cast<std::size_t>(e.corners[k])].side;
    return sides;
  }
  bool ArgumentOf(const Corner& c, const Motions<T>& motions, T& argument) const {
    const Entry& e = entries_[static_cast<std::size_t>(c.entry)];
    return CornerArgumentAt(*e.effect->formula, c.corner, e.values.data(), SidesOf(e), motions,
                            argument);
  }
  // The corners of all formulas, those at one place once.
  void FindCorners() {
    corners_.clear();
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      Entry& e = entries_[i];
      e.corners.fill(-1);
      if (e.effect->formula == nullptr || !InfoOf(e.effect->formula->place()).in_flow) continue;
      const std::span<const FormulaCorner> own = e.effect->formula->corners();
      for (std::size_t k = 0; k < own.size(); ++k) e.corners[k] = PlaceOfCorner(own[k], i, k);
    }
  }
  signed char PlaceOfCorner(const FormulaCorner& corner, std::size_t entry, std::size_t k) {
    for (std::size_t j = 0; j < corners_.size() && !corner.key.empty(); ++j) {
      const FormulaCorner& other =
          FormulaOf(corners_[j]).corners()[static_cast<std::size_t>(corners_[j].corner)];
      if (other.key != corner.key) continue;
      corners_[j].is_smooth = corners_[j].is_smooth && corner.is_smooth;
      return static_cast<signed char>(j);
    }
    if (corners_.size() == kMaxCorners) return -1;
    corners_.push_back({static_cast<int>(entry), static_cast<int>(k), 0, corner.is_smooth});
    return static_cast<signed char>(corners_.size() - 1);
  }

  boost::container::static_vector<Entry, kMax> entries_;
  boost::container::static_vector<Corner, kMaxCorners> corners_;
};

}  // namespace hoplab
