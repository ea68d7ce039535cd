#include "datasets/import/start_of_trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/text.h"

namespace hoplab {
namespace {

constexpr double kWindow_s = 0.04;
constexpr std::size_t kFewestSamples = 6;

struct Estimate {
  double value = 0, rate = 0;              // at the first row, a second
  double value_sigma = 0, rate_sigma = 0;  // twice their standard errors
};

// Six digits are enough for what stands behind a sigma.
double SixDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return ParseDouble(text).value_or(value);
}

using Matrix = std::array<std::array<double, 6>, 3>;  // [A | 1]

// The inverse of the left half, in the right one; false where there is none.
bool Invert(Matrix& m) {
  for (std::size_t i = 0; i < 3; ++i) {
    std::size_t pivot = i;
    for (std::size_t j = i + 1; j < 3; ++j)
      if (std::abs(m[j][i]) > std::abs(m[pivot][i])) pivot = j;
    std::swap(m[i], m[pivot]);
    if (std::abs(m[i][i]) < 1e-12) return false;
    const double by = m[i][i];
    for (double& value : m[i]) value /= by;
    for (std::size_t j = 0; j < 3; ++j) {
      const double times = m[j][i];
      if (j == i) continue;
      for (std::size_t k = 0; k < 6; ++k) m[j][k] -= times * m[i][k];
    }
  }
  return true;
}

// The parabola through samples `v` at `u`, times in windows; nothing where they do not tell one.
std::optional<Estimate> Parabola(const std::vector<double>& u, const std::vector<double>& v) {
  Matrix normal = {};
  std::array<double, 3> right = {}, c = {};
  for (std::size_t i = 0; i < u.size(); ++i) {
    const std::array<double, 3> powers = {1, u[i], u[i] * u[i]};
    for (std::size_t a = 0; a < 3; ++a) {
      right[a] += powers[a] * v[i];
      for (std::size_t b = 0; b < 3; ++b) normal[a][b] += powers[a] * powers[b];
    }
  }
  for (std::size_t a = 0; a < 3; ++a) normal[a][3 + a] = 1;
  if (!Invert(normal)) return std::nullopt;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) c[a] += normal[a][3 + b] * right[b];
  double squares = 0;
  for (std::size_t i = 0; i < u.size(); ++i)
    squares += std::pow(v[i] - c[0] - u[i] * (c[1] + u[i] * c[2]), 2);
  const double noise = std::sqrt(squares / static_cast<double>(u.size() - 3));
  return Estimate{SixDigits(c[0]), SixDigits(c[1] / kWindow_s), 2 * noise * std::sqrt(normal[0][3]),
                  2 * noise * std::sqrt(normal[1][4]) / kWindow_s};
}

std::optional<Estimate> Begin(const Trace& trace, Channel channel) {
  const std::vector<double>* values = trace.Find(channel);
  if (values == nullptr) return std::nullopt;
  std::vector<double> u, v;
  for (std::size_t i = 0; i < values->size(); ++i) {
    const double at = (trace.time_s[i] - trace.time_s.front()) / kWindow_s;
    if (at > 1) break;
    if (!std::isfinite((*values)[i])) continue;
    u.push_back(at);
    v.push_back((*values)[i]);
  }
  if (u.size() < kFewestSamples) return std::nullopt;
  return Parabola(u, v);
}

double AtLeast(double least, double sigma) { return SixDigits(std::max(least, sigma)); }

}  // namespace

RobotTrial StartOfTrace(const Trace& trace, int legs) {
  RobotTrial start;
  const auto x = Begin(trace, Channel::kBodyX), y = Begin(trace, Channel::kBodyY),
             pitch = Begin(trace, Channel::kBodyPitch);
  if (x && y && pitch) {
    StateSpec state, sigma;
    state.x_m = x->value;
    state.y_m = y->value;
    state.vx_m_per_s = x->rate;
    state.vy_m_per_s = y->rate;
    state.pitch_rad = pitch->value;
    state.pitch_rate_rad_per_s = pitch->rate;
    sigma.x_m = AtLeast(0.002, x->value_sigma);
    sigma.y_m = AtLeast(0.002, y->value_sigma);
    sigma.vx_m_per_s = AtLeast(0.02, x->rate_sigma);
    sigma.vy_m_per_s = AtLeast(0.02, y->rate_sigma);
    sigma.pitch_rad = AtLeast(0.005, pitch->value_sigma);
    sigma.pitch_rate_rad_per_s = AtLeast(0.05, pitch->rate_sigma);
    start.initial = state;
    start.initial_sigma = sigma;
  }
  for (int leg = 0; leg < legs; ++leg) {
    const std::vector<double>* angles = trace.Find(OfLeg(Channel::kLegAngle1, leg));
    if (angles == nullptr || !std::isfinite(angles->front()))
      return {start.initial, start.initial_sigma, {}};
    start.angles_rad.push_back(angles->front());
  }
  return start;
}

}  // namespace hoplab
