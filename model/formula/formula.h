#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/effects/effect.h"
#include "model/formula/formula_error.h"
#include "model/formula/formula_tree.h"
#include "model/formula/place.h"

namespace hoplab {

/// One step of a formula's evaluation: an operation on results of earlier steps.
struct FormulaStep {
  enum class Op : std::uint8_t {
    kConstant,
    kParameter,
    kVariable,
    kAdd,
    kSubtract,
    kMultiply,
    kDivide,
    kNegate,
    kAddConstant,
    kScale,
    kIntegerPower,   // exponent: b
    kConstantPower,  // exponent: constant
    kPower,
    kSin,
    kCos,
    kTan,
    kExp,
    kLog,
    kSqrt,
    kTanh,
    // With a corner, where another branch begins.
    kAbs,
    kSign,
    kStep,  // 0 below zero, 1 above
    kMax,
    kMin
  };
  Op op = Op::kConstant;
  std::int16_t a = -1, b = -1;
  std::int16_t corner = -1;
  double constant = 0.0;
  bool operator==(const FormulaStep&) const = default;
};

/// A place where a formula goes on by another branch: where the result of step `argument` is zero.
struct FormulaCorner {
  int argument = 0;
  double scale = 1.0;      // a usual size of that argument
  bool is_smooth = false;  // the formula is continuous there
  std::string key;         // two corners of one key are at the same place; empty: of its own
};

inline constexpr int kMaxFormulaCorners = 4;

/// On which side of each of its corners a formula is: -1, 1, or 0 on it. kFree: as the argument has
/// it, without an event.
using CornerSides = std::array<signed char, kMaxFormulaCorners>;
inline constexpr signed char kFreeSide = 2;

/// What is known where a formula is evaluated; null where it is not.
template <class T>
using FormulaView = std::array<const T*, kFormulaVariables>;

/// A formula of parameters and of what is known at its place, in every scalar type of the
/// simulator, without heap.
class Formula {
 public:
  /// Names of parameters are those of `source`. Throws FormulaError for what is not right.
  explicit Formula(const FormulaSource& source);

  const FormulaSource& source() const { return source_; }
  FormulaPlace place() const { return place_; }
  const FormulaTree& tree() const { return tree_; }
  std::span<const FormulaCorner> corners() const { return corners_; }
  bool Uses(FormulaVariable v) const { return uses_[static_cast<std::size_t>(v)]; }
  /// Has a function that turns over within a narrow band (EffectInfo::sharp).
  bool sharp() const { return sharp_; }
  /// A torque that needs the leg's load to be known; it does not bend the leg.
  bool needs_load() const;

  template <class T>
  T Evaluate(const T* p, const FormulaView<T>& at, const CornerSides& sides) const;
  /// The argument of a corner.
  template <class T>
  T CornerArgument(int corner, const T* p, const FormulaView<T>& at,
                   const CornerSides& sides) const;

  // What it adds at its place; nothing at any other. `p` points at its parameters.

  template <class T>
  void ChangeParameters(Parameters<T>& parameters) const;
  template <class T>
  void AddBodyForce(const T* p, const CornerSides& sides, const BodyMotion<T>& body,
                    Vector2<T>& force) const;
  template <class T>
  void AddChordForce(const T* p, const CornerSides& sides, const ChordMotion<T>& chord,
                     T& force) const;
  template <class T>
  void AddHipTorque(const T* p, const CornerSides& sides, const HipMotion<T>& hip, T& torque) const;
  template <class T>
  void ChangeLandingVelocity(const T* p, const Landing<T>& landing, Vector2<T>& velocity) const;
  template <class T>
  void ChangeTouchdownAngle(const T* p, const CornerSides& sides, const PlacementMotion<T>& leg,
                            T& theta) const;
  template <class T>
  void ChangeRestitution(const T* p, const T& speed, T& restitution) const;
  template <class T>
  void ChangeObservation(const T* p, const T& t, Observation<T>& seen) const;

 private:
  friend class FormulaCompiler;
  template <class T>
  T Run(int last, const T* p, const FormulaView<T>& at, const CornerSides& sides) const;

  FormulaSource source_;
  FormulaPlace place_;
  FormulaTree tree_;
  std::vector<FormulaStep> steps_;
  int result_ = 0;
  std::vector<FormulaCorner> corners_;
  std::array<bool, kFormulaVariables> uses_{};
  bool sharp_ = false;
};

/// What a body and its leg do at one instant, for the corners of formulas; null where a formula of
/// the kind does not act.
template <class T>
struct Motions {
  const BodyMotion<T>* body = nullptr;
  const ChordMotion<T>* chord = nullptr;
  const HipMotion<T>* hip = nullptr;
  const PlacementMotion<T>* placement = nullptr;
};

/// The argument of a corner of a formula that acts there; false if it does not.
template <class T>
bool CornerArgumentAt(const Formula& formula, int corner, const T* p, const CornerSides& sides,
                      const Motions<T>& motions, T& argument);

}  // namespace hoplab
