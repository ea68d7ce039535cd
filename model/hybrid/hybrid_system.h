#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "model/hybrid/automaton.h"
#include "model/hybrid/ballistic.h"
#include "model/hybrid/discrete_state.h"
#include "model/observation.h"
#include "model/trajectory.h"

namespace hoplab {

/// A mechanism as a hybrid automaton in scalar type T: modes with their flow, guards that end them,
/// resets between. The engine runs any of them. Its state begins with (x, y, vx, vy) of a body, and
/// of more where BodyCount says so; one of less than four states moves none.
template <class T>
class HybridSystem {
 public:
  virtual ~HybridSystem() = default;

  /// How many states there are, at most kMaxStates.
  virtual int size() const = 0;
  /// How many of them a run reports: what a mechanism keeps for itself comes last.
  virtual int ReportedSize() const { return size(); }
  /// How many bodies lead the state in `mode`, each with its (x, y, vx, vy).
  virtual int BodyCount(Mode /*mode*/) const { return 1; }
  /// dz/dt in `mode`.
  virtual void Derivative(Mode mode, const T& t, const T* z, T* dz) const = 0;

  // A guard announces its event when it comes down through zero. Of two at one instant the first
  // fires first.
  virtual int GuardCount(Mode mode) const = 0;
  virtual GuardSpec Guard(Mode mode, int i) const = 0;
  virtual void Guards(Mode mode, const T& t, const T* z, T* g) const = 0;
  /// Applies the reset of guard `i` to `z`.
  virtual ResetResult Reset(Mode mode, int i, const T& t, T* z) = 0;
  /// A smooth guard `i` (GuardSpec::is_smooth) is met and not crossed.
  virtual void Touch(Mode /*mode*/, int /*i*/) {}

  /// Completes the state a run begins with, of which the first `given` components are set.
  virtual void CompleteStart(T* /*z*/, int /*given*/) const {}
  /// Whether what follows the body in the state is no contact's place, so that a start in stance is
  /// completed like one in flight.
  virtual bool CompletesAnyStart() const { return false; }
  /// Prepares the discrete state for a run that begins in `mode` at state `z`, and completes `z`
  /// where it begins in stance with the place of its contact; gives the mode it is in.
  virtual Mode Begin(Mode mode, T* /*z*/) { return mode; }
  /// The same for a run that goes on where another one ended, with its feet; `z` is whole.
  virtual Mode Resume(std::span<const Foot> /*feet*/, T* /*z*/) { return Mode::kFlight; }
  /// What its legs do now; empty of what is no robot.
  virtual void TellFeet(std::vector<Foot>& feet) const { feet.clear(); }
  virtual void SaveDiscreteState(DiscreteState& /*to*/) const {}
  virtual void LoadDiscreteState(DiscreteState& /*from*/) {}
  /// Prepares for a state that did not come out of a run.
  virtual void StartSearch(Mode /*mode*/, const double* /*z*/) {}

  // What drives the mechanism from outside has another formula from time to time: a knot.

  /// The next one in `mode`; infinity where nothing drives it.
  virtual double NextKnot(Mode /*mode*/) const { return std::numeric_limits<double>::infinity(); }
  /// Passes one that is due at time `t`; gives its instant with its derivative. `z` jumps where the
  /// limit of a quick motor does.
  virtual std::optional<T> PassKnot(Mode /*mode*/, double /*t*/, T* /*z*/) { return std::nullopt; }

  /// The closed form of a mode that has one; asked only where IsBallistic.
  virtual bool IsBallistic(Mode /*mode*/) const { return false; }
  virtual BallisticFlight<T> Ballistic(const T* /*z*/) const { return {}; }
  /// How it would fly on without touching anything, for what comes after the end of a run.
  virtual std::optional<BallisticFlight<T>> FreeFlight() const { return std::nullopt; }

  /// Factor on the absolute tolerance of state `i`: 1 (m, rad, m/s, rad/s), but of a rate whose
  /// error dies out or swings at k [1/s] it is k: such an error moves the position by error/k.
  /// Asked once, before a run begins.
  virtual double ErrorUnit(int /*i*/) const { return 1.0; }
  /// Size of the first step of a mode [s].
  virtual double FirstStep(Mode mode, const T* z) const = 0;
  /// The step an explicit solver must not exceed where the state alone does not steer it there [s].
  virtual double LongestStep(Mode /*mode*/, const T& /*t*/, const T* /*z*/) const {
    return std::numeric_limits<double>::infinity();
  }

  /// What the sensors see, before the observation effects. Not computed: NaN.
  virtual Observation<T> Observe(Mode /*mode*/, const T& /*t*/, const T* /*z*/) const {
    return Unseen();
  }
  /// Total energy [J].
  virtual T Energy(Mode /*mode*/, const T* /*z*/) const {
    return T(std::numeric_limits<double>::quiet_NaN());
  }
  /// F C/l0 where the law is an expansion in it; else 0.
  virtual double DeflectionRatio(Mode /*mode*/, const double* /*z*/) const { return 0.0; }

 protected:
  static Observation<T> Unseen() {
    Observation<T> seen;
    for (T& c : seen.channel) c = T(std::numeric_limits<double>::quiet_NaN());
    return seen;
  }
};

}  // namespace hoplab
