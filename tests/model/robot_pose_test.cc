#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/support/robot_columns.h"
#include "tests/support/robot_requests.h"
#include "tests/support/tolerances.h"

// What tracks a robot's body: where it sits (M102), when it reports (M103), its gain.

namespace hoplab {
namespace {

using namespace testing;
using D = SensitivityDirection;

const std::vector<Channel> kChannels = {
    Channel::kBodyX,     Channel::kBodyY,     Channel::kBodyVx,    Channel::kBodyVy,
    Channel::kBodyPitch, Channel::kLegAngle1, Channel::kHipTorque2};
constexpr std::size_t kPoseChannels = 5;

Parameters<double> Tracked() {
  Parameters<double> p = RobotParametersFor(2);
  p.robot->friction = 0.9;
  p.robot->damping = 3e-4;
  return p;
}

std::vector<double> Read(SimulationRequest q, const std::vector<Channel>& channels,
                         const std::vector<double>& rows,
                         const std::vector<EffectSetting>& effects) {
  q.channels = channels;
  q.row_times = rows;
  q.effects = effects;
  const Trajectory run = Simulate(q);
  EXPECT_EQ(run.outcome, Outcome::kCompleted);
  EXPECT_EQ(run.rows_in_run, static_cast<int>(rows.size()));
  return run.samples;
}

EffectSetting MarkerAt(double dx, double dy) {
  EffectSetting marker = EffectOf("marker_offset", dx);
  marker.values[1] = dy;
  return marker;
}

// In flight body and marker are two points of a body that turns evenly about its centre of mass,
// also over a ground that slopes, which turns nothing that is seen.
TEST(MarkerOffset, IsAnotherPointOfABodyThatTurns) {
  const double dx = 0.03, dy = -0.05, pitch = 0.1, rate = 1.7, g = 9.81;
  for (const double slope : {0.0, 0.05}) {
    Parameters<double> p = Tracked();
    p.slope = slope;
    const SimulationRequest q = RobotDrop(p, {0.2, 0.5, 0.4, 0.3, pitch, rate}, 0.1);
    const double t = 0.08;
    const std::vector<double> seen =
        Read(q, {kChannels.begin(), kChannels.begin() + kPoseChannels}, {t}, {MarkerAt(dx, dy)});
    const double angle = pitch + rate * t;
    const double across = dx * std::cos(angle) - dy * std::sin(angle);
    const double up = dx * std::sin(angle) + dy * std::cos(angle);
    EXPECT_NEAR(seen[0], 0.2 + 0.4 * t + across, 1e-10) << slope;
    EXPECT_NEAR(seen[1], 0.5 + 0.3 * t - 0.5 * g * t * t + up, 1e-10) << slope;
    EXPECT_NEAR(seen[2], 0.4 - rate * up, 1e-9) << slope;
    EXPECT_NEAR(seen[3], 0.3 - g * t + rate * across, 1e-9) << slope;
    EXPECT_NEAR(seen[4], angle, 1e-10) << slope;
  }
}

// Also where position is all that is asked for.
TEST(MarkerOffset, IsSeenWithoutThePitchBeingAskedFor) {
  const SimulationRequest q = RandomRobotDrop(Tracked(), 3, 0.25);
  const std::vector<double> rows = {0.05, 0.15, 0.25};
  const std::vector<double> all = Read(q, kChannels, rows, {MarkerAt(0.01, 0.02)});
  const std::vector<double> two =
      Read(q, {Channel::kBodyX, Channel::kBodyY}, rows, {MarkerAt(0.01, 0.02)});
  for (std::size_t row = 0; row < rows.size(); ++row) {
    EXPECT_EQ(two[2 * row], all[kChannels.size() * row]);
    EXPECT_EQ(two[2 * row + 1], all[kChannels.size() * row + 1]);
  }
}

// The marker is not the mass: the run is the same.
TEST(MarkerOffset, ChangesNoMotion) {
  SimulationRequest q = RandomRobotDrop(Tracked(), 3, 0.25);
  const std::array rows = {0.05, 0.1, 0.25};
  q.row_times = rows;
  q.channels = kChannels;
  const Trajectory bare = Simulate(q);
  const std::array effects = {MarkerAt(0.01, 0.02), EffectOf("pose_delay", 0.01),
                              EffectOf("sensor_scale_pitch", 0.02)};
  q.effects = effects;
  const Trajectory marked = Simulate(q);
  // Statics begin where they were asked last, so another row moves them within their tolerance.
  for (std::size_t k = 0; k < bare.final_state.size(); ++k)
    EXPECT_NEAR(marked.final_state[k], bare.final_state[k], 1e-11) << k;
  EXPECT_NE(marked.samples, bare.samples);
}

// Late by tau is a row that was read tau before: the pose alone, also where the recording is late,
// too, and where its clock runs fast.
TEST(PoseDelay, ReadsThePoseOfAnEarlierTime) {
  const SimulationRequest q = RandomRobotDrop(Tracked(), 4, 0.4);
  const std::vector<double> rows = {0.03, 0.09, 0.11, 0.2, 0.3}, taus = {0.007, -0.02};
  for (const double tau : taus) {
    for (const bool others : {false, true}) {
      std::vector<EffectSetting> effects, delayed;
      if (others) effects = {EffectOf("sensor_delay", 0.004), EffectOf("clock_scale", 0.01)};
      delayed = effects;
      delayed.push_back(EffectOf("pose_delay", tau));
      std::vector<double> earlier = rows;
      for (double& t : earlier) t -= tau;
      const std::vector<double> late = Read(q, kChannels, rows, delayed);
      const std::vector<double> then = Read(q, kChannels, earlier, effects);
      const std::vector<double> now = Read(q, kChannels, rows, effects);
      for (std::size_t i = 0; i < late.size(); ++i) {
        const bool of_pose = i % kChannels.size() < kPoseChannels;
        EXPECT_NEAR(late[i], of_pose ? then[i] : now[i], of_pose ? 1e-9 : 1e-7)
            << tau << ' ' << others << ' ' << i;
      }
    }
  }
}

// What is late is read before the start at first: there the robot flies as it does after it.
TEST(PoseDelay, ReadsBeforeTheStartUnderEveryIntegrator) {
  const double tau = 0.02, vx = 0.4, vy = 0.3, rate = 1.7, g = 9.81;
  for (const IntegratorKind kind :
       {IntegratorKind::kDop853, IntegratorKind::kErkStep, IntegratorKind::kCvodes}) {
    SimulationRequest q = RobotDrop(Tracked(), {0.2, 0.25, vx, vy, 0.1, rate}, 0.3);
    q.integrator.kind = kind;
    const std::vector<double> rows = {0.0, 0.005, 0.03};
    const std::vector<double> seen = Read(q, kChannels, rows, {EffectOf("pose_delay", tau)});
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const double t = rows[row] - tau, *at = &seen[row * kChannels.size()];
      EXPECT_NEAR(at[0], 0.2 + vx * t, 1e-9) << NameOf(kind);
      EXPECT_NEAR(at[1], 0.25 + vy * t - 0.5 * g * t * t, 1e-9) << NameOf(kind);
      EXPECT_NEAR(at[3], vy - g * t, 1e-9) << NameOf(kind);
      EXPECT_NEAR(at[4], 0.1 + rate * t, 1e-9) << NameOf(kind);
    }
  }
}

TEST(SensorScalePitch, StretchesThePitchAlone) {
  const SimulationRequest q = RandomRobotDrop(Tracked(), 1, 0.2);
  const std::vector<double> straight = Read(q, kChannels, {0.1}, {});
  const std::vector<double> stretched =
      Read(q, kChannels, {0.1}, {EffectOf("sensor_scale_pitch", 0.03)});
  for (std::size_t c = 0; c < kChannels.size(); ++c) {
    const double by = kChannels[c] == Channel::kBodyPitch ? 1.03 : 1.0;
    EXPECT_DOUBLE_EQ(stretched[c], by * straight[c]) << c;
  }
}

// At null and off it, of what the marker's place and the reading's time do to every channel.
TEST(Pose, HasTheDerivativesOfDifferences) {
  for (const double size : {0.0, 1.0}) {
    SimulationRequest q = RandomRobotDrop(Tracked(), 2, 0.2);
    const std::vector effects = {MarkerAt(0.01 * size, -0.02 * size),
                                 EffectOf("pose_delay", 0.004 * size),
                                 EffectOf("sensor_scale_pitch", 0.03 * size)};
    q.effects = effects;
    q.integrator.relative_tolerance = kOracleRelative;
    q.integrator.absolute_tolerance = kOracleAbsolute;
    std::vector<double> late;  // where the pose has an event
    for (const Event& e : Simulate(q).events) late.push_back(e.time + 0.004 * size);
    EXPECT_GE(
        ExpectRobotExact(q, late,
                         {D::EffectParameter(0, 0), D::EffectParameter(0, 1),
                          D::EffectParameter(1, 0), D::EffectParameter(2, 0), D::InitialState(1)}),
        7)
        << size;
  }
}

}  // namespace
}  // namespace hoplab
