#include "fitting/diagnosis/probes.h"

#include <array>
#include <cmath>
#include <utility>

#include "model/effects/effect.h"

namespace hoplab {
namespace {

constexpr double kFar = 1e6;  // probes have no physical bounds

// Sign(v) of a rate along the chord [m/s], regularised as in the catalogue.
constexpr double kChordWidth = 0.05;

// Hat function number i over uneven centres: 1 at its own, 0 at its neighbours', flat beyond the
// outermost.
template <class T, std::size_t N>
T Hat(const std::array<double, N>& centres, std::size_t i, const T& s) {
  const double at = Value(s);
  if (at <= centres[i]) {
    if (i == 0) return T(1.0);
    if (at <= centres[i - 1]) return T(0.0);
    return (s - centres[i - 1]) / (centres[i] - centres[i - 1]);
  }
  if (i + 1 == N) return T(1.0);
  if (at >= centres[i + 1]) return T(0.0);
  return (centres[i + 1] - s) / (centres[i + 1] - centres[i]);
}

constexpr EffectInfo InfoOfProbe(std::string_view name, EffectKind kind,
                                 std::span<const EffectParameter> parameters) {
  return {.name = name,
          .kind = kind,
          .equation = "a unit bump",
          .sentence = "a force, impulse, offset or reading without a name",
          .for_legs = true,
          .for_ball = true,
          .dissipative = false,
          .parameters = parameters};
}

constexpr std::array kCompression = {0.01, 0.03, 0.06, 0.1, 0.16, 0.25, 0.4};
constexpr std::array kLead = {-0.6, -0.3, 0.0, 0.3, 0.6};
constexpr std::array kSpeed = {0.5, 1.5, 3.0, 6.0};

/// Radial force by compression, while loading (kSide -1) or unloading (+1).
template <int kSide, std::size_t kBin>
struct ChordBump {
  static constexpr std::array kParameters = {EffectParameter{"force", "N", 0, -kFar, kFar, 1.0}};
  static constexpr EffectInfo kInfo =
      InfoOfProbe("probe_chord_force", EffectKind::kForce, kParameters);
  template <class T>
  static void AddChordForce(const T* p, const ChordMotion<T>& chord, T& force) {
    using std::tanh;
    const T side = 0.5 * (1.0 + static_cast<double>(kSide) * tanh(chord.rate / kChordWidth));
    force += p[0] * side * Hat(kCompression, kBin, chord.compression);
  }
};

/// Hip torque by chord angle.
template <std::size_t kBin>
struct TorqueBump {
  static constexpr std::array kParameters = {EffectParameter{"torque", "N m", 0, -kFar, kFar, 0.1}};
  static constexpr EffectInfo kInfo =
      InfoOfProbe("probe_hip_torque", EffectKind::kForce, kParameters);
  template <class T>
  static void AddHipTorque(const T* p, const HipMotion<T>& hip, T& torque) {
    torque += p[0] * Hat(kLead, kBin, hip.lead);
  }
};

/// Force on the body along an axis, in stance or in flight.
template <bool kStance, bool kVertical>
struct BodyPush {
  static constexpr std::array kParameters = {EffectParameter{"force", "N", 0, -kFar, kFar, 0.1}};
  static constexpr EffectInfo kInfo =
      InfoOfProbe("probe_body_force", EffectKind::kForce, kParameters);
  template <class T>
  static void AddBodyForce(const T* p, const BodyMotion<T>& body, Vector2<T>& force) {
    if (body.in_stance == kStance) (kVertical ? force.y : force.x) += p[0];
  }
};

/// Force against the motion of the body in flight, by speed.
template <std::size_t kBin>
struct DragBump {
  static constexpr std::array kParameters = {EffectParameter{"force", "N", 0, -kFar, kFar, 0.1}};
  static constexpr EffectInfo kInfo = InfoOfProbe("probe_drag", EffectKind::kForce, kParameters);
  template <class T>
  static void AddBodyForce(const T* p, const BodyMotion<T>& body, Vector2<T>& force) {
    using std::sqrt;
    const T square = body.vx * body.vx + body.vy * body.vy;
    if (body.in_stance || Value(square) == 0.0) return;
    const T speed = sqrt(square), push = p[0] * Hat(kSpeed, kBin, speed);
    force.x -= push * body.vx / speed;
    force.y -= push * body.vy / speed;
  }
};

/// Jump of the velocity along (or across) the chord at touch-down or lift-off.
template <bool kLiftoff, bool kAcross>
struct Kick {
  static constexpr std::array kParameters = {EffectParameter{"speed", "m/s", 0, -kFar, kFar, 0.01}};
  static constexpr EffectInfo kInfo = InfoOfProbe("probe_kick", EffectKind::kGuard, kParameters);
  template <class T>
  static void Add(const T* p, const Landing<T>& landing, Vector2<T>& velocity) {
    const Vector2<T>& e = landing.chord;
    velocity.x += p[0] * (kAcross ? e.y : e.x);
    velocity.y += p[0] * (kAcross ? T(-e.x) : e.y);
  }
  template <class T>
  static void ChangeLandingVelocity(const T* p, const Landing<T>& landing,
                                    Vector2<T>& velocity) requires(!kLiftoff) {
    Add(p, landing, velocity);
  }
  template <class T>
  static void ChangeLiftoffVelocity(const T* p, const Landing<T>& landing,
                                    Vector2<T>& velocity) requires(kLiftoff) {
    Add(p, landing, velocity);
  }
};

struct GuardAngle {
  static constexpr std::array kParameters = {EffectParameter{"angle", "rad", 0, -kFar, kFar, 0.01}};
  static constexpr EffectInfo kInfo = InfoOfProbe("probe_angle", EffectKind::kGuard, kParameters);
  template <class T>
  static void ChangeTouchdownAngle(const T* p, const T&, T& theta) {
    theta += p[0];
  }
};
struct GuardHeight {
  static constexpr std::array kParameters = {EffectParameter{"height", "m", 0, -kFar, kFar, 0.001}};
  static constexpr EffectInfo kInfo = InfoOfProbe("probe_height", EffectKind::kGuard, kParameters);
  template <class T>
  static void ChangeContactHeight(const T* p, T& height) {
    height += p[0];
  }
};

/// Restitution of a ball by the speed of the impact.
template <std::size_t kBin>
struct BounceBump {
  static constexpr std::array kParameters = {
      EffectParameter{"restitution", "-", 0, -kFar, kFar, 0.01}};
  static constexpr EffectInfo kInfo = InfoOfProbe("probe_bounce", EffectKind::kGuard, kParameters);
  template <class T>
  static void ChangeRestitution(const T* p, const T& speed, T& restitution) {
    restitution += p[0] * Hat(kSpeed, kBin, speed);
  }
};

/// Reading of one coordinate: an offset, or a share of a coordinate.
enum class Reading { kXOffset, kYOffset, kXOfX, kYOfY, kXOfY, kYOfX };
template <Reading kReading>
struct ReadingBump {
  static constexpr std::array kParameters = {
      EffectParameter{"reading", "m or -", 0, -kFar, kFar, 0.001}};
  static constexpr EffectInfo kInfo =
      InfoOfProbe("probe_reading", EffectKind::kObservation, kParameters);
  template <class T>
  static void ChangeObservation(const T* p, Observation<T>& seen) {
    T &x = seen[Channel::kBodyX], &y = seen[Channel::kBodyY];
    const T was_x = x, was_y = y;
    if constexpr (kReading == Reading::kXOffset) x += p[0];
    if constexpr (kReading == Reading::kYOffset) y += p[0];
    if constexpr (kReading == Reading::kXOfX) x += p[0] * was_x;
    if constexpr (kReading == Reading::kYOfY) y += p[0] * was_y;
    if constexpr (kReading == Reading::kXOfY) x += p[0] * was_y;
    if constexpr (kReading == Reading::kYOfX) y += p[0] * was_x;
  }
};

/// Reading of one angle: an offset, or a share of it.
template <Channel kAngle, bool kShare>
struct AngleReading {
  static constexpr std::array kParameters = {
      EffectParameter{"reading", "rad or -", 0, -kFar, kFar, 0.001}};
  static constexpr EffectInfo kInfo =
      InfoOfProbe("probe_reading", EffectKind::kObservation, kParameters);
  template <class T>
  static void ChangeObservation(const T* p, Observation<T>& seen) {
    if (seen.Has(kAngle)) seen[kAngle] += kShare ? p[0] * seen[kAngle] : p[0];
  }
};

struct ReadingTime {
  static constexpr std::array kParameters = {EffectParameter{"time", "s/s", 0, -0.1, 0.1, 0.001}};
  static constexpr EffectInfo kInfo =
      InfoOfProbe("probe_time", EffectKind::kObservation, kParameters);
  template <class T>
  static void ChangeObservationTime(const T* p, T& t) {
    t *= 1.0 + p[0];
  }
};

struct ReadingDelay {
  static constexpr std::array kParameters = {EffectParameter{"delay", "s", 0, -0.1, 0.1, 0.001}};
  static constexpr EffectInfo kInfo =
      InfoOfProbe("probe_delay", EffectKind::kObservation, kParameters);
  template <class T>
  static void ChangeObservationTime(const T* p, T& t) {
    t -= p[0];
  }
};

template <class Physics>
const Effect* Probe() {
  static constexpr Effect effect = MakeEffect<Physics>();
  return &effect;
}

class Builder {
 public:
  void Group(std::string name, std::string against, std::string unit, std::vector<double> centres,
             const std::vector<const Effect*>& probes) {
    const int first = static_cast<int>(basis_.probes.size());
    const int count = static_cast<int>(probes.size());
    if (centres.empty()) centres.assign(probes.size(), std::nan(""));
    basis_.groups.push_back(
        {std::move(name), std::move(against), std::move(unit), std::move(centres), first, count});
    for (const Effect* probe : probes) basis_.probes.push_back({probe});
    basis_.hypotheses.push_back({first, count, Eigen::VectorXd::Constant(count, -kFar),
                                 Eigen::VectorXd::Constant(count, kFar)});
  }
  ProbeBasis Take() { return std::move(basis_); }

 private:
  ProbeBasis basis_;
};

template <class Array>
std::vector<double> Values(const Array& a) {
  return {a.begin(), a.end()};
}

template <int kSide, std::size_t... kBins>
std::vector<const Effect*> ChordBumps(std::index_sequence<kBins...>) {
  return {Probe<ChordBump<kSide, kBins>>()...};
}
template <std::size_t... kBins>
std::vector<const Effect*> TorqueBumps(std::index_sequence<kBins...>) {
  return {Probe<TorqueBump<kBins>>()...};
}
template <std::size_t... kBins>
std::vector<const Effect*> DragBumps(std::index_sequence<kBins...>) {
  return {Probe<DragBump<kBins>>()...};
}
template <std::size_t... kBins>
std::vector<const Effect*> BounceBumps(std::index_sequence<kBins...>) {
  return {Probe<BounceBump<kBins>>()...};
}

void AddLegs(Builder& b) {
  const auto bins = std::make_index_sequence<kCompression.size()>();
  b.Group("chord force, loading", "compression [-]", "N", Values(kCompression),
          ChordBumps<-1>(bins));
  b.Group("chord force, unloading", "compression [-]", "N", Values(kCompression),
          ChordBumps<1>(bins));
  b.Group("hip torque", "sine of the chord angle [-]", "N m", Values(kLead),
          TorqueBumps(std::make_index_sequence<kLead.size()>()));
  b.Group("ground force along x", "", "N", {}, {Probe<BodyPush<true, false>>()});
  b.Group("impulse at touch-down", "", "m/s", {},
          {Probe<Kick<false, false>>(), Probe<Kick<false, true>>()});
  b.Group("impulse at lift-off", "", "m/s", {},
          {Probe<Kick<true, false>>(), Probe<Kick<true, true>>()});
  b.Group("touch-down angle", "", "rad", {}, {Probe<GuardAngle>()});
  b.Group("contact height", "", "m", {}, {Probe<GuardHeight>()});
}

template <Channel kAngle>
void AddAngleReading(Builder& b, const char* name) {
  b.Group(std::string("reading of ") + name, "", "rad or rad/rad", {},
          {Probe<AngleReading<kAngle, false>>(), Probe<AngleReading<kAngle, true>>()});
}

void AddRobot(Builder& b) {
  b.Group("ground force along x", "", "N", {}, {Probe<BodyPush<true, false>>()});
  AddAngleReading<Channel::kBodyPitch>(b, "body_pitch");
  AddAngleReading<Channel::kLegAngle1>(b, "leg_angle_1");
  AddAngleReading<Channel::kLegAngle2>(b, "leg_angle_2");
  AddAngleReading<Channel::kLegAngle3>(b, "leg_angle_3");
  AddAngleReading<Channel::kLegAngle4>(b, "leg_angle_4");
}

}  // namespace

ProbeBasis ProbesOf(Law law) {
  Builder b;
  if (law == Law::kBall) {
    b.Group("restitution", "impact speed [m/s]", "-", Values(kSpeed),
            BounceBumps(std::make_index_sequence<kSpeed.size()>()));
  } else if (law == Law::kRobot) {
    AddRobot(b);
  } else {
    AddLegs(b);
  }
  b.Group("flight force along x", "", "N", {}, {Probe<BodyPush<false, false>>()});
  b.Group("flight force along y", "", "N", {}, {Probe<BodyPush<false, true>>()});
  b.Group("force against the motion in flight", "speed [m/s]", "N", Values(kSpeed),
          DragBumps(std::make_index_sequence<kSpeed.size()>()));
  // An offset along x and a delay are seen through the stated initial states alone.
  b.Group("reading of body_x", "", "m or m/m", {},
          {Probe<ReadingBump<Reading::kXOffset>>(), Probe<ReadingBump<Reading::kXOfX>>(),
           Probe<ReadingBump<Reading::kXOfY>>()});
  b.Group("reading of body_y", "", "m or m/m", {},
          {Probe<ReadingBump<Reading::kYOffset>>(), Probe<ReadingBump<Reading::kYOfY>>(),
           Probe<ReadingBump<Reading::kYOfX>>()});
  b.Group("reading of the clock", "", "s or s/s", {},
          {Probe<ReadingDelay>(), Probe<ReadingTime>()});
  return b.Take();
}

}  // namespace hoplab
