#include "tests/app/exported_leg.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "app/export/c_law.h"
#include "base/units.h"
#include "tests/support/run_process.h"

namespace hoplab::testing {
namespace {

constexpr double kSame = 1e-12;

// Reads states, writes what the file says of them.
constexpr const char* kDriver = R"(#include <stdio.h>
#include "leg.c"
int main(int argc, char **argv) {
  FILE *in = fopen(argv[1], "r");
  int mode;
  double contact, phi, angle;
  leg_hip hip;
  if (argc < 2 || !in) return 1;
  while (fscanf(in, "%d %lf %lf %lf %lf %lf %lf %lf", &mode, &contact, &phi, &angle, &hip.x, &hip.y,
                &hip.vx, &hip.vy) == 8) {
    leg_state leg;
    leg_load load;
    int lost;
    leg_start(&leg);
    leg.placed = 1;
    leg.mode = (leg_mode)mode;
    leg.contact = contact;
    leg.phi = phi;
    lost = leg_load_at(&leg, &hip, &load);
    printf("%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g", lost, load.fx, load.fy,
           load.torque, load.contact_x, load.length, load.arc, load.angle, load.angle_rate,
           load.contact_rate);
    leg_decide(&leg, &hip, angle);
    printf(" %d %.17g %.17g %.17g\n", (int)leg.mode, leg.contact, hip.vx, hip.vy);
  }
  return 0;
}
)";

int CodeOf(Mode mode) {
  return mode == Mode::kFlight ? 0 : mode == Mode::kRolling ? 1 : mode == Mode::kToe ? 2 : 3;
}

}  // namespace

ExportedLeg::ExportedLeg(ExportedModel model) : model_(std::move(model)) {
  ActiveEffects<double> effects;
  for (const EffectSetting& e : model_.effects) effects.Add(*e.effect, e.values);
  MechanismSetup<double> setup{.law = model_.law,
                               .parameters = model_.Effective(),
                               .effects = effects,
                               .liftoff = model_.liftoff};
  // The file leaves out what a torque does to the arc of an elastica (M120).
  LawTerms<double>& terms = setup.parameters.law_terms;
  if (model_.law == Law::kElastica) terms.active = terms.torque_active = true;
  LegLawOf(model_.law).body.Make(setup, body_);
  p_ = setup.parameters;
}

std::vector<ExportedLeg::State> ExportedLeg::Grid() const {
  std::vector<State> states;
  for (const double vx : {-0.3, 0.4, 1.3}) {
    for (const double vy : {-1.1, 0.2, 1.4}) {
      if (model_.law == Law::kStraightLeg) {
        for (const double u : {-0.2, 0.0, 0.25}) {
          for (const double y : {0.8, 0.93, 0.99})
            states.push_back({Mode::kStance, 0.1 + u, 0.0, {0.1, y, vx, vy}});
        }
        continue;
      }
      for (const double theta : {0.1, 0.4, 0.8, 1.3}) {
        for (const double dx : {-0.008, 0.0, 0.015}) {
          for (const double press : {0.0005, 0.006, 0.02}) {
            const double arc = kPi - theta, y = p_.r * (1.0 + std::cos(theta)) - press;
            const double x_c = p_.r * std::sin(theta);
            const bool half = model_.law == Law::kThesis || model_.law == Law::kNoSlip;
            states.push_back({Mode::kRolling, half ? x_c : x_c - p_.r * arc, arc, {dx, y, vx, vy}});
          }
        }
      }
      for (const double u : {-0.04, -0.005, 0.012}) {
        for (const double y : {0.14, 0.165, 0.1795})
          states.push_back({Mode::kToe, 0.1 + u, kPi, {0.1, y, vx, vy}});
      }
    }
  }
  for (const double vx : {0.2, 1.2})
    states.push_back({Mode::kFlight, 0.0, kPi, {0.3, 0.5 * Reach(), vx, -1.2}});
  states.push_back({Mode::kFlight, 0.0, kPi, {0.3, 3.0 * Reach(), 0.5, -1.2}});
  return states;
}

ExportedLeg::Answer ExportedLeg::Library(const State& s) {
  Answer a{};
  double z[8] = {s.z[0], s.z[1], s.z[2], s.z[3], s.contact};
  double g[kMaxGuards];
  a.next_contact = s.contact;
  a.vx = s.z[2];
  a.vy = s.z[3];
  a.next = CodeOf(s.mode);
  // Sinking or rising, and on the side of the torque's limit that this speed is on.
  double begun[8] = {s.z[0], s.z[1], s.z[2], s.z[3], s.z[0]};
  body_->Begin(s.mode, begun);
  if (s.mode == Mode::kFlight) {
    body_->Guards(Mode::kFlight, 0.0, z, g);
    if (g[0] > 0.0) return a;
    a.next = CodeOf(body_->Reset(Mode::kFlight, 0, 0.0, z).next);
    a.next_contact = z[kContact];
    a.vx = z[kVx];
    a.vy = z[kVy];
    return a;
  }
  body_->StartSearch(s.mode, z);
  double dz[8];
  for (int round = 0; round < 3; ++round) body_->Derivative(s.mode, 0.0, z, dz);
  const Observation<double> seen = body_->Observe(s.mode, 0.0, z);
  a.lost = std::isfinite(seen[Channel::kGroundForceY]) ? 0 : 1;
  a.fx = seen[Channel::kGroundForceX];
  a.fy = seen[Channel::kGroundForceY];
  a.torque = seen[Channel::kHipTorque];
  a.contact_x = seen[Channel::kContactX];
  a.length = seen[Channel::kLegLength];
  a.arc = model_.law == Law::kStraightLeg ? 0.0 : seen[Channel::kContactArc];
  a.angle = seen[Channel::kLegAngle];
  a.contact_rate = dz[kContact];
  if (a.lost != 0) return a;
  body_->Guards(s.mode, 0.0, z, g);
  for (int i = 0; i < body_->GuardCount(s.mode); ++i) {
    const EventKind event = body_->Guard(s.mode, i).event;
    if (event == EventKind::kLiftoff && g[i] < 0.0) {
      a.next = 0;
      return a;
    }
  }
  for (int i = 0; i < body_->GuardCount(s.mode); ++i) {
    const EventKind event = body_->Guard(s.mode, i).event;
    const bool rolls = event == EventKind::kRollingToToe || event == EventKind::kToeToRolling;
    if (!rolls || g[i] >= 0.0) continue;
    a.next = CodeOf(body_->Reset(s.mode, i, 0.0, z).next);
    a.next_contact = z[kContact];
  }
  return a;
}

std::vector<ExportedLeg::Answer> ExportedLeg::CFile(const std::vector<State>& states) {
  WriteText(temp_.path() / "leg.c", CSourceOf(model_, "run.json"));
  WriteText(temp_.path() / "driver.c", kDriver);
  std::ostringstream in;
  in.precision(17);
  for (const State& s : states) {
    in << CodeOf(s.mode) << ' ' << s.contact << ' ' << s.arc << ' ' << p_.theta_td;
    for (const double value : s.z) in << ' ' << value;
    in << '\n';
  }
  WriteText(temp_.path() / "states", in.str());
  const auto run = [&](const std::vector<std::string>& command) {
    const ProcessResult result = RunProcess({.command = command, .folder = temp_.path()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return result.out;
  };
  run({"/usr/bin/env", "cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-O0",
       "driver.c", "-o", "driver", "-lm"});
  std::istringstream out(run({(temp_.path() / "driver").string(), "states"}));
  std::vector<Answer> answers;
  for (Answer a; out >> a.lost >> a.fx >> a.fy >> a.torque >> a.contact_x >> a.length >> a.arc >>
                 a.angle >> a.angle_rate >> a.contact_rate >> a.next >> a.next_contact >> a.vx >>
                 a.vy;)
    answers.push_back(a);
  EXPECT_EQ(answers.size(), states.size());
  return answers;
}

double ExportedLeg::Compare() {
  const std::vector<State> states = Grid();
  const std::vector<Answer> answers = CFile(states);
  double worst = 0.0;
  int found = 0, landed = 0, left = 0, turned = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Answer c = answers[i], lib = Library(states[i]);
    EXPECT_EQ(c.lost, lib.lost) << Describe(states[i]);
    if (c.lost != 0 || lib.lost != 0) continue;
    EXPECT_EQ(c.next, lib.next) << Describe(states[i]);
    const double force = p_.m * p_.g + std::hypot(lib.fx, lib.fy);
    const auto off = [&](double a, double b, double scale) {
      EXPECT_NEAR(a, b, kSame * scale) << Describe(states[i]);
      worst = std::max(worst, std::abs(a - b) / scale);
    };
    off(c.fx, lib.fx, force);
    off(c.fy, lib.fy, force);
    off(c.torque, lib.torque, std::max(1.0, std::abs(lib.torque)));
    off(c.next_contact, lib.next_contact, 1.0);
    off(c.vx, lib.vx, 1.0);
    off(c.vy, lib.vy, 1.0);
    landed += states[i].mode == Mode::kFlight && c.next != 0 ? 1 : 0;
    if (states[i].mode == Mode::kFlight) continue;
    left += c.next == 0 ? 1 : 0;
    turned += c.next != 0 && c.next != CodeOf(states[i].mode) ? 1 : 0;
    ++found;
    off(c.contact_x, lib.contact_x, 1.0);
    off(c.length, lib.length, 1.0);
    off(c.arc, lib.arc, 1.0);
    off(c.angle, lib.angle, 1.0);
    off(c.contact_rate, lib.contact_rate, std::max(1.0, std::abs(lib.contact_rate)));
  }
  // The grid meets everything.
  EXPECT_GT(found, static_cast<int>(states.size()) / 2);
  EXPECT_EQ(landed, 2);
  EXPECT_GT(left, 0);
  EXPECT_TRUE(turned > 0 || model_.law == Law::kStraightLeg);
  return worst;
}

double ExportedLeg::CompareRates() {
  constexpr double kStep = 1e-5;  // s
  std::vector<State> states = Grid();
  std::erase_if(states, [](const State& s) { return s.mode == Mode::kFlight; });
  const std::vector<Answer> at = CFile(states);
  const auto moved = [&](double by) {
    std::vector<State> there = states;
    for (std::size_t i = 0; i < there.size(); ++i) {
      there[i].z[0] += by * there[i].z[2];
      there[i].z[1] += by * there[i].z[3];
      there[i].contact += by * at[i].contact_rate;
    }
    return CFile(there);
  };
  const std::vector<Answer> behind = moved(-kStep), ahead = moved(kStep);
  double worst = 0.0;
  int found = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (at[i].lost != 0 || behind[i].lost != 0 || ahead[i].lost != 0) continue;
    ++found;
    const double rate = (ahead[i].angle - behind[i].angle) / (2.0 * kStep);
    const double off = std::abs(at[i].angle_rate - rate) / (1.0 + std::abs(rate));
    EXPECT_LT(off, 1e-5) << Describe(states[i]);
    worst = std::max(worst, off);
  }
  EXPECT_GT(found, static_cast<int>(states.size()) / 2);
  return worst;
}

double ExportedLeg::Reach() const { return model_.law == Law::kStraightLeg ? p_.l0 : p_.r; }

std::string ExportedLeg::Describe(const State& s) const {
  std::ostringstream text;
  text << NameOf(model_.law) << ' ' << NameOf(s.mode) << " contact " << s.contact << " hip";
  for (const double value : s.z) text << ' ' << value;
  for (const EffectSetting& e : model_.effects) text << ' ' << e.effect->info.name;
  return text.str();
}

}  // namespace hoplab::testing
