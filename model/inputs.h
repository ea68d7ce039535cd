#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "base/input_kind.h"
#include "model/jet.h"

namespace hoplab {

/// A logged column, M50: u(t) = scale c(t - delay), c linear between its samples or held from the
/// one before, constant before the first and after the last.
struct DrivenInput {
  InputKind kind = InputKind::kHipTorque;
  std::span<const double> times;  // s since the start of the run, ascending
  std::span<const double> values;
  bool held = false;
  double delay = 0.0;  // s
  double scale = 1.0;
  int clock = -1;  // of the request's clocks; what it stamps t was read at t + offset
};

/// One input in scalar type T. Between two of its samples it has one formula, its piece; which one
/// is a discrete state, so that a corner or jump is an event of time and not a surprise inside a
/// step.
template <class T>
class InputSignal {
 public:
  InputSignal() = default;
  InputSignal(const DrivenInput& input, const T& delay, const T& scale)
      : times_(input.times),
        values_(input.values),
        held_(input.held),
        present_(true),
        delay_(delay),
        scale_(scale) {}

  /// The same without directions.
  template <class To>
  InputSignal<To> Convert() const {
    if (!present_) return {};
    InputSignal<To> to({.times = times_, .values = values_, .held = held_}, To(Value(delay_)),
                       To(Value(scale_)));
    to.set_piece(piece_);
    return to;
  }

  bool present() const { return present_; }
  bool held() const { return held_; }

  T At(const T& t) const { return scale_ * Column(t); }
  /// du/dt within the piece.
  T Rate() const {
    const int last = Last();
    if (held_ || piece_ < 0 || piece_ >= last) return T(0.0);
    return scale_ * Slope(piece_);
  }
  /// The instant at which the piece ends; infinity after the last sample.
  double NextKnot() const {
    return piece_ >= Last() ? std::numeric_limits<double>::infinity()
                            : times_[NextSample()] + Value(delay_);
  }
  /// The same with its derivative.
  T KnotTime() const { return T(times_[NextSample()] + delay_); }
  void Pass() { ++piece_; }
  /// What a jump at the end of the piece adds, of a signal that is held.
  T NextJump() const {
    const std::size_t i = NextSample();
    return held_ && piece_ >= 0 ? T(scale_ * (values_[i] - values_[i - 1])) : T(0.0);
  }
  /// The signal before its piece began.
  T Before() const {
    return piece_ > 0 ? T(scale_ * values_[static_cast<std::size_t>(piece_ - 1)])
                      : T(scale_ * values_.front());
  }
  /// The piece at time t; at a knot the one that begins there.
  void Seek(double t) {
    const double s = t - Value(delay_) + kSameInstant;
    piece_ =
        static_cast<int>(std::upper_bound(times_.begin(), times_.end(), s) - times_.begin()) - 1;
  }
  int piece() const { return piece_; }
  void set_piece(int piece) { piece_ = piece; }

  /// Knots closer than this are one instant [s].
  static constexpr double kSameInstant = 1e-12;

 private:
  // Where the piece ends; piece_ is -1 before the first sample.
  std::size_t NextSample() const {
    const int next = piece_ + 1;
    return static_cast<std::size_t>(next);
  }
  int Last() const { return static_cast<int>(times_.size()) - 1; }
  double Slope(int piece) const {
    const auto i = static_cast<std::size_t>(piece);
    return (values_[i + 1] - values_[i]) / (times_[i + 1] - times_[i]);
  }
  T Column(const T& t) const {
    if (piece_ < 0) return T(values_.front());
    if (piece_ >= Last()) return T(values_.back());
    const auto i = static_cast<std::size_t>(piece_);
    if (held_) return T(values_[i]);
    return values_[i] + Slope(piece_) * (t - delay_ - times_[i]);
  }

  std::span<const double> times_, values_;
  bool held_ = false, present_ = false;
  T delay_{0.0}, scale_{1.0};
  int piece_ = -1;
};

/// The inputs of a run, at most one of a kind.
template <class T>
class InputSignals {
 public:
  void Set(InputKind kind, const InputSignal<T>& signal) { signals_[Index(kind)] = signal; }
  bool Has(InputKind kind) const { return signals_[Index(kind)].present(); }
  bool HasForce() const { return Has(InputKind::kBodyForceX) || Has(InputKind::kBodyForceY); }
  bool empty() const {
    return std::none_of(signals_.begin(), signals_.end(),
                        [](const InputSignal<T>& s) { return s.present(); });
  }
  const InputSignal<T>& of(InputKind kind) const { return signals_[Index(kind)]; }
  T At(InputKind kind, const T& t) const {
    const InputSignal<T>& signal = signals_[Index(kind)];
    return signal.present() ? signal.At(t) : T(0.0);
  }

  /// The first instant at which a signal that acts in flight, or in stance, has another formula.
  double NextKnot(bool flight) const {
    double next = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kInputKinds; ++k)
      if (Acts(k, flight)) next = std::min(next, signals_[k].NextKnot());
    return next;
  }
  /// Of the signals that act the first whose piece ends at time t or before; none if there is none.
  std::optional<InputKind> Due(bool flight, double t) const {
    for (int k = 0; k < kInputKinds; ++k)
      if (Acts(k, flight) && signals_[k].NextKnot() <= t + InputSignal<T>::kSameInstant)
        return static_cast<InputKind>(k);
    return std::nullopt;
  }
  /// Passes that knot; gives its instant with its derivative.
  std::optional<T> Pass(bool flight, double t) {
    const std::optional<InputKind> due = Due(flight, t);
    if (!due) return std::nullopt;
    InputSignal<T>& signal = signals_[Index(*due)];
    const T instant = signal.KnotTime();
    signal.Pass();
    return instant;
  }
  void Seek(double t) {
    for (InputSignal<T>& s : signals_)
      if (s.present()) s.Seek(t);
  }
  template <class To>
  InputSignals<To> Convert() const {
    InputSignals<To> to;
    for (int k = 0; k < kInputKinds; ++k) {
      const auto kind = static_cast<InputKind>(k);
      to.Set(kind, of(kind).template Convert<To>());
    }
    return to;
  }
  template <class State>
  void Save(State& to) const {
    for (const InputSignal<T>& s : signals_)
      if (s.present()) to.Put(s.piece());
  }
  template <class State>
  void Load(State& from) {
    for (InputSignal<T>& s : signals_)
      if (s.present()) s.set_piece(static_cast<int>(from.Take()));
  }

 private:
  static std::size_t Index(InputKind kind) { return static_cast<std::size_t>(kind); }
  bool Acts(int k, bool flight) const {
    if (!signals_[static_cast<std::size_t>(k)].present()) return false;
    const auto kind = static_cast<InputKind>(k);
    if (kind == InputKind::kHipTorque) return !flight;
    return kind != InputKind::kLegAngle || flight;
  }
  std::array<InputSignal<T>, kInputKinds> signals_;
};

}  // namespace hoplab
