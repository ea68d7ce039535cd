#pragma once

#include <optional>
#include <string_view>

namespace hoplab {

/// Continuous mode of a hopper; section 4 of the equation sheet.
enum class Mode { kFlight, kRolling, kToe, kStance };
std::string_view NameOf(Mode mode);

/// What happened when a guard crossed zero.
enum class EventKind {
  kTouchdown,       // flight -> rolling, toe or stance
  kLiftoff,         // stance -> flight
  kRollingToToe,    // the contact has run to the toe
  kToeToRolling,    // the toe's arc lies down again
  kApex,            // vy = 0 on the way down, in flight
  kBounce,          // a ball meets the ground
  kMaxCompression,  // the chord is at its shortest, where a leg changes there
  kTorqueLimit,     // the hip torque meets or leaves its limit
  kFallHeight,      // hip below y_min
  kFallAngle,       // chord more than 80 deg from the vertical
  kFallArc,         // contact arc below 0.2 rad: the hip rolls onto the ground
  kFallPitch,       // a robot's body pitches beyond its limit
  kSlide,           // a foot that held begins to slide
  kStick,           // a sliding foot comes to hold
  kPress,           // a foot that a torque has lifted presses on the ground
  kBrush,           // a leg meets the ground and is off it at once
  kGearMesh,        // teeth of a motor's gear meet or part
  kHipStop,         // a hip with dry friction stops turning: it is held, or turns back
  kHipSlip,         // one that was held begins to turn
  kSwitch,          // mode change of a piecewise-smooth system without a leg
  kCorner           // a formula is about to go on by another branch
};
std::string_view NameOf(EventKind kind);

/// What the engine does about an event beside applying its reset.
struct EventTraits {
  std::string_view name;
  /// Marks a place on the flow (a Poincare section) and changes nothing there: neither fires where
  /// a mode begins nor counts as simultaneous with another event.
  bool is_section = false;
  bool begins_stance = false;  // a guard found closed after it was never open
  /// A guard found closed after an event that did not begin the stance fires together with it.
  bool ends_stance = false;
  /// At zero where its mode begins it may open by the second order of time: there it fires at once
  /// only if it comes down faster than grazing.
  bool waits_to_open = false;
  /// It opens so at its own pace: it may open and close within one step, and is looked for there.
  bool opens_slowly = false;
  bool begins_hop = false;    // a hop is on its way from here
  bool ends_hop = false;      // ... and complete here, unless the reset says no
  bool is_hop = false;        // each one counts as a hop
  bool meets_ground = false;  // a run cannot start beyond it
  /// The mode stays, the flow is another one: guards are looked at as where a mode is entered.
  bool changes_flow = false;
};
const EventTraits& TraitsOf(EventKind kind);

/// How a simulation ended. Only the first two let it speak for the whole horizon.
enum class Outcome {
  kCompleted,         // reached the horizon
  kHopLimit,          // reached the wanted number of hops
  kFellHeight,        // hip below y_min; later samples are missing, here and below
  kFellAngle,         // chord more than 80 deg from the vertical
  kFellArc,           // contact arc below 0.2 rad
  kFellPitch,         // the body pitched beyond its limit
  kFellNoReturn,      // lifted off, never again as high as touch-down needs, down to y_min
  kNoSupport,         // touched down without pushing (chord not shortening)
  kStartsInGround,    // the start lies below touch-down height
  kGrazing,           // an event is met without crossing it: no derivative exists there
  kChattering,        // two events undo each other at one instant
  kCameToRest,        // bounces crowd together
  kEventLimit,        // more events than any hop trace has
  kStepLimit,         // more integrator steps than allowed: stiff for an explicit solver
  kIntegrationFailed  // the solver cannot go on: state or law left their domain
};
std::string_view NameOf(Outcome outcome);
/// For a message: what happened and what it means, said of the simulation: "fell: the hip ...".
std::string_view SentenceOf(Outcome outcome);
inline bool IsComplete(Outcome outcome) {
  return outcome == Outcome::kCompleted || outcome == Outcome::kHopLimit;
}

/// A guard: the event it announces when it crosses zero downward, and the size of one unit of it,
/// against which "zero" is judged.
struct GuardSpec {
  EventKind event;
  double scale;
  /// How the run ends if the guard is found closed (negative, or at zero and not opening) where its
  /// mode is entered. One that ends a stance and is closed by a change of stance fires at once
  /// instead.
  std::optional<Outcome> if_closed = std::nullopt;
  /// The flow is continuous across it: its instant matters to the solver alone, and it may graze.
  bool is_smooth = false;
  int leg = 0;  // of a mechanism with several, which one's
};

/// What a reset did: the next mode, and the outcome if the run ends there.
struct ResetResult {
  Mode next;
  std::optional<Outcome> end = std::nullopt;
  bool is_hop = true;  // an apex from which the leg will touch down again
  std::optional<EventKind> turned_out = std::nullopt;  // to be another event than its guard's
};

/// Where a guard reached zero; guard -1: none did.
struct GuardCrossing {
  int guard = -1;
  double time = 0.0;
};

/// |guard|/scale below which a guard counts as at zero: rounding of a state of size one.
inline constexpr double kAtZero = 1e-11;

/// Four legs of a robot that roll and slide, their motors limited and geared, their hips with dry
/// friction, have 37.
inline constexpr int kMaxGuards = 37;
/// Most states of a mechanism, and of what a stepper integrates: with eight sensitivities of each.
/// A robot on four legs with mass whose motors lag and have gears has 38.
inline constexpr int kMaxStates = 38;

}  // namespace hoplab
