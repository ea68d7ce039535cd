#include "datasets/import/start_of_trace.h"

#include <Eigen/Dense>
#include <algorithm>
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

// The parabola through samples `v` at `u`, times in windows; nothing where they do not tell one.
std::optional<Estimate> Parabola(const Eigen::VectorXd& u, const Eigen::VectorXd& v) {
  Eigen::MatrixX3d powers(u.size(), 3);
  powers << Eigen::VectorXd::Ones(u.size()), u, u.cwiseAbs2();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixX3d> qr(powers);
  if (qr.rank() < 3) return std::nullopt;
  const Eigen::Vector3d c = qr.solve(v);
  const double noise = (v - powers * c).norm() / std::sqrt(static_cast<double>(u.size() - 3));
  const Eigen::Matrix3d covariance = (powers.transpose() * powers).inverse();
  return Estimate{SixDigits(c[0]), SixDigits(c[1] / kWindow_s),
                  2 * noise * std::sqrt(covariance(0, 0)),
                  2 * noise * std::sqrt(covariance(1, 1)) / kWindow_s};
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
  const auto rows = static_cast<Eigen::Index>(u.size());
  return Parabola(Eigen::VectorXd::Map(u.data(), rows), Eigen::VectorXd::Map(v.data(), rows));
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
