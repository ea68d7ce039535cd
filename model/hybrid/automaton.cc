#include "model/hybrid/automaton.h"

#include <iterator>

namespace hoplab {

std::string_view NameOf(Mode mode) {
  switch (mode) {
    case Mode::kFlight:
      return "flight";
    case Mode::kRolling:
      return "rolling";
    case Mode::kToe:
      return "toe";
    case Mode::kStance:
      return "stance";
  }
  return "";
}

namespace {
// In the order of EventKind.
constexpr EventTraits kEvents[] = {
    {.name = "touchdown", .begins_stance = true, .meets_ground = true},
    {.name = "liftoff", .ends_stance = true, .begins_hop = true},
    {.name = "rolling_to_toe"},
    {.name = "toe_to_rolling"},
    {.name = "apex", .is_section = true, .ends_hop = true},
    {.name = "bounce", .is_hop = true, .meets_ground = true},
    {.name = "max_compression"},
    {.name = "torque_limit"},
    {.name = "fall_height"},
    {.name = "fall_angle"},
    {.name = "fall_arc"},
    {.name = "fall_pitch"},
    {.name = "slide", .waits_to_open = true},
    {.name = "stick", .waits_to_open = true, .opens_slowly = true},
    {.name = "press", .changes_flow = true},
    {.name = "brush"},
    {.name = "gear_mesh"},
    {.name = "hip_stop", .waits_to_open = true, .opens_slowly = true},
    {.name = "hip_slip", .waits_to_open = true},
    {.name = "switch"},
    {.name = "corner", .changes_flow = true},
};
static_assert(std::size(kEvents) == static_cast<std::size_t>(EventKind::kCorner) + 1);
}  // namespace

const EventTraits& TraitsOf(EventKind kind) { return kEvents[static_cast<std::size_t>(kind)]; }
std::string_view NameOf(EventKind kind) { return TraitsOf(kind).name; }

std::string_view NameOf(Outcome outcome) {
  switch (outcome) {
    case Outcome::kCompleted:
      return "completed";
    case Outcome::kHopLimit:
      return "hop_limit";
    case Outcome::kFellHeight:
      return "fell_height";
    case Outcome::kFellAngle:
      return "fell_angle";
    case Outcome::kFellArc:
      return "fell_arc";
    case Outcome::kFellPitch:
      return "fell_pitch";
    case Outcome::kFellNoReturn:
      return "fell_no_return";
    case Outcome::kNoSupport:
      return "no_support";
    case Outcome::kStartsInGround:
      return "starts_in_ground";
    case Outcome::kGrazing:
      return "grazing";
    case Outcome::kChattering:
      return "chattering";
    case Outcome::kCameToRest:
      return "came_to_rest";
    case Outcome::kEventLimit:
      return "event_limit";
    case Outcome::kStepLimit:
      return "step_limit";
    case Outcome::kIntegrationFailed:
      return "integration_failed";
  }
  return "";
}

std::string_view SentenceOf(Outcome outcome) {
  switch (outcome) {
    case Outcome::kCompleted:
      return "ran to the end";
    case Outcome::kHopLimit:
      return "made the wanted number of hops";
    case Outcome::kFellHeight:
      return "fell: the hip sank below its lowest allowed height";
    case Outcome::kFellAngle:
      return "fell: the leg tipped more than 80 deg from the vertical";
    case Outcome::kFellArc:
      return "fell: the leg rolled up to the hip";
    case Outcome::kFellPitch:
      return "fell: the body pitched beyond its limit";
    case Outcome::kFellNoReturn:
      return "fell: after a lift-off it never rose to touch-down height again, and sank to the "
             "ground";
    case Outcome::kNoSupport:
      return "touched down without the leg pushing back";
    case Outcome::kStartsInGround:
      return "starts below touch-down height";
    case Outcome::kGrazing:
      return "met an event without crossing it; no derivative exists there";
    case Outcome::kChattering:
      return "stops where two events undo each other at one instant";
    case Outcome::kCameToRest:
      return "came to rest: the bounces crowded together";
    case Outcome::kEventLimit:
      return "had more events than a hop trace has";
    case Outcome::kStepLimit:
      return "needs more solver steps than allowed: a stiff leg, try the integrator cvodes";
    case Outcome::kIntegrationFailed:
      return "could not go on: the state left the domain of the leg law";
  }
  return "";
}

}  // namespace hoplab
