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
  kSwitch           // mode change of a piecewise-smooth system without a leg
};
std::string_view NameOf(EventKind kind);

/// How a simulation ended. Only the first two let it speak for the whole horizon.
enum class Outcome {
  kCompleted,         // reached the horizon
  kHopLimit,          // reached the wanted number of hops
  kFellHeight,        // hip below y_min; later samples are missing, here and below
  kFellAngle,         // chord more than 80 deg from the vertical
  kFellArc,           // contact arc below 0.2 rad
  kFellNoReturn,      // lifted off, but never again as high as touch-down needs
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
/// One sentence for a message: what happened and what it means.
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
  /// mode is entered. A lift-off guard closed by a change of stance fires at once instead.
  std::optional<Outcome> if_closed = std::nullopt;
};

/// What a reset did: the next mode, and the outcome if the run ends there.
struct ResetResult {
  Mode next;
  std::optional<Outcome> end = std::nullopt;
};

inline constexpr int kMaxGuards = 6;

}  // namespace hoplab
