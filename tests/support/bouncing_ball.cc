#include "tests/support/bouncing_ball.h"

#include <cmath>

namespace hoplab::testing {

std::vector<BouncingBall::Bounce> BouncingBall::Bounces(int count) const {
  const long double w = std::sqrt(vy * vy + 2.0L * g * (y - radius));
  Column dw{};
  dw[kVy] = vy / w;
  dw[kY] = g / w;
  dw[kRadius] = -g / w;
  dw[kGravity] = (y - radius) / w;

  std::vector<Bounce> bounces;
  Bounce b{};
  b.speed = w;
  b.d_speed = dw;
  b.time = (vy + w) / g;
  for (int p = 0; p < kCount; ++p) b.d_time[p] = dw[p] / g;
  b.d_time[kVy] += 1.0L / g;
  b.d_time[kGravity] -= b.time / g;
  b.position = x + vx * b.time;
  for (int p = 0; p < kCount; ++p) b.d_position[p] = vx * b.d_time[p];
  b.d_position[kX] += 1.0L;
  b.d_position[kVx] += b.time;
  bounces.push_back(b);

  long double e_n = 1.0L, e_n1 = 0.0L;  // e^n and n e^(n-1)
  long double c_n = 1.0L, c_n1 = 0.0L;  // the same of c = 1 - tangential_loss
  const long double e = restitution, c = 1.0L - tangential_loss;
  for (int n = 1; n < count; ++n) {
    e_n1 = e_n + e * e_n1;
    e_n *= e;
    c_n1 = c_n + c * c_n1;
    c_n *= c;
    const long double interval = 2.0L * e_n * w / g;
    Column d_interval{};
    for (int p = 0; p < kCount; ++p) d_interval[p] = 2.0L * e_n * dw[p] / g;
    d_interval[kRestitution] += 2.0L * e_n1 * w / g;
    d_interval[kGravity] -= interval / g;
    const long double speed_x = vx * c_n;
    b.time += interval;
    b.position += speed_x * interval;
    b.speed = e_n * w;
    for (int p = 0; p < kCount; ++p) {
      b.d_time[p] += d_interval[p];
      b.d_position[p] += speed_x * d_interval[p];
      b.d_speed[p] = e_n * dw[p];
    }
    b.d_speed[kRestitution] += e_n1 * w;
    b.d_position[kVx] += c_n * interval;
    b.d_position[kTangentialLoss] -= vx * c_n1 * interval;
    bounces.push_back(b);
  }
  return bounces;
}

BouncingBall::State BouncingBall::StateAt(long double time, int count) const {
  const Bounce last = Bounces(count).back();
  const long double c = 1.0L - tangential_loss;
  const long double c_n = std::pow(c, count), c_n1 = count * std::pow(c, count - 1);
  const long double dt = time - last.time;
  const long double up = restitution * last.speed;  // just after the bounce
  const long double speed_x = vx * c_n;
  State s{};
  s.z = {last.position + speed_x * dt, radius + up * dt - 0.5L * g * dt * dt, speed_x, up - g * dt};
  for (int p = 0; p < kCount; ++p) {
    long double d_up = restitution * last.d_speed[p];
    if (p == kRestitution) d_up += last.speed;
    long double d_speed_x = 0.0L;
    if (p == kVx) d_speed_x = c_n;
    if (p == kTangentialLoss) d_speed_x = -vx * c_n1;
    const long double d_dt = -last.d_time[p];
    s.d[0][p] = last.d_position[p] + d_speed_x * dt + speed_x * d_dt;
    s.d[1][p] = d_up * dt + (up - g * dt) * d_dt;
    s.d[2][p] = d_speed_x;
    s.d[3][p] = d_up - g * d_dt;
    if (p == kRadius) s.d[1][p] += 1.0L;
    if (p == kGravity) {
      s.d[1][p] -= 0.5L * dt * dt;
      s.d[3][p] -= dt;
    }
  }
  return s;
}

}  // namespace hoplab::testing
