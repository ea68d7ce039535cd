#pragma once

#include <array>
#include <vector>

namespace hoplab::testing {

/// Closed form of a bouncing ball in long double, with derivatives written out by hand: the
/// impact speed of bounce n is e^n w with w^2 = vy^2 + 2 g (y - radius); the first bounce comes at
/// (vy + w)/g, the next ones 2 e^n w/g apart.
struct BouncingBall {
  enum Direction { kRestitution, kTangentialLoss, kGravity, kRadius, kX, kY, kVx, kVy, kCount };
  using Column = std::array<long double, kCount>;

  long double restitution, tangential_loss, g, radius, x, y, vx, vy;

  struct Bounce {
    long double time, position, speed;  // speed: downward, just before [m/s]
    Column d_time, d_position, d_speed;
  };
  /// The first `count` bounces.
  std::vector<Bounce> Bounces(int count) const;

  struct State {
    std::array<long double, 4> z;  // x, y, vx, vy
    std::array<Column, 4> d;       // by direction, at fixed time
  };
  /// State at `time`, after exactly `bounces` bounces.
  State StateAt(long double time, int bounces) const;
};

}  // namespace hoplab::testing
