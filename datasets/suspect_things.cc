#include "datasets/suspect_things.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/text.h"
#include "base/units.h"
#include "datasets/smoothness.h"

namespace hoplab {
namespace {

using Warnings = std::vector<std::string>;

// A hop lasts some tenths of a second; a hundred seconds without one hop's detail is no trace of
// it.
constexpr double kLongestTrial_s = 100;
constexpr double kCoarsestStep_s = 0.5;
// Angles below this, in degrees, are more often a radian than meant.
constexpr double kSmallestUsualAngle_deg = 1.6;
// The median over a trace that moves quickly overrates the noise by a factor of a few, and filtered
// or rounded recordings have less of it than their error.
constexpr double kSigmaFactor = 20;
// How a trace begins is told by this much of it, and by so many samples at least; a stated velocity
// is far from it by so much, and by that share of it.
constexpr double kBeginning_s = 0.05;
constexpr std::size_t kFewest = 8;
constexpr double kVelocity_m_per_s = 0.5;
constexpr double kVelocityShare = 0.5;
// Relative to the size of a column, what differences of doubles leave of a smooth one.
constexpr double kRounding = 1e-9;

std::vector<double> Finite(const std::vector<double>& values) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double v) { return std::isfinite(v); });
  return finite;
}

double Quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return std::nan("");
  const auto at = values.begin() +
                  static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Curvature (second derivative) of the parabola through the samples [first, last) by least squares.
double Curvature(const std::vector<double>& t, const std::vector<double>& y, std::size_t first,
                 std::size_t last) {
  const double n = static_cast<double>(last - first);
  double mean_t = 0, mean_y = 0;
  for (std::size_t i = first; i < last; ++i) {
    mean_t += t[i] / n;
    mean_y += y[i] / n;
  }
  // Time in units of the window, so that the sums below are of order one whatever its unit.
  const double width = t[last - 1] - t[first];
  double s2 = 0, s3 = 0, s4 = 0, sy1 = 0, sy2 = 0;
  for (std::size_t i = first; i < last; ++i) {
    const double u = (t[i] - mean_t) / width;
    const double v = y[i] - mean_y;
    s2 += u * u / n;
    s3 += u * u * u / n;
    s4 += u * u * u * u / n;
    sy1 += u * v / n;
    sy2 += u * u * v / n;
  }
  const double determinant = s2 * (s4 - s2 * s2) - s3 * s3;
  return 2 * (s2 * sy2 - s3 * sy1) / determinant / (width * width);
}

// Milliseconds divide an acceleration by 1e6, millimetres multiply it by 1e3; a factor of 20 is
// left for noise, counterweights and windows that see some stance.
constexpr double kMilliseconds = 1e-6;
bool IsNear(double ratio, double factor) { return ratio > factor / 20 && ratio < factor * 20; }

// How fast the trial falls in flight, over its gravity; NaN if its heights do not tell.
double FallRatio(const Trial& trial) {
  const std::vector<double>* heights = trial.trace.Find(Channel::kBodyY);
  return heights == nullptr
             ? std::nan("")
             : ApparentGravity(trial.trace.time_s, *heights) / trial.mechanism.gravity_m_per_s2;
}

class Inspector {
 public:
  explicit Inspector(const Dataset& dataset) : dataset_(dataset) {}

  Warnings Inspect() {
    const bool has_test =
        std::any_of(dataset_.trials.begin(), dataset_.trials.end(),
                    [](const Trial& trial) { return trial.role == TrialRole::kTest; });
    if (!has_test)
      Warn(dataset_.origin.place,
           "no trial has role: test, so nothing is held out to measure a fit on");
    InspectSection(dataset_.mechanism);
    for (const Trial& trial : dataset_.trials) {
      InspectAngle(trial);
      InspectLength(trial);
      InspectTimes(trial);
      InspectStart(trial);
      for (const ChannelSpec& channel : dataset_.channels) InspectColumn(trial, channel.id);
    }
    for (const ChannelSpec& channel : dataset_.channels) InspectSigma(channel);
    return warnings_;
  }

 private:
  void Warn(const std::string& place, const std::string& sentence) {
    warnings_.push_back(place + ": " + sentence);
  }

  // The CSV file as it is named in other messages.
  std::string FilePlace(const Trial& trial) const {
    const std::string& yaml = dataset_.origin.place;
    const std::size_t slash = yaml.rfind('/');
    return (slash == yaml.npos ? "" : yaml.substr(0, slash + 1)) + trial.file;
  }

  // A strip is far thinner than its arc is wide.
  void InspectSection(const MechanismSpec& mechanism) {
    const std::optional<double>& thickness = mechanism.c_leg.thickness_m;
    if (mechanism.type != MechanismKind::kCLeg || !thickness ||
        *thickness < mechanism.c_leg.rest_radius_m)
      return;
    Warn(dataset_.origin.place, "thickness_m = " + Rounded(*thickness) +
                                    " is more than the leg's radius; in metres it may be " +
                                    Rounded(1e-3 * *thickness));
  }

  void InspectAngle(const Trial& trial) {
    const double angle_deg = RadToDeg(trial.touchdown_angle_rad);
    if (angle_deg == 0 || std::abs(angle_deg) >= kSmallestUsualAngle_deg) return;
    Warn(trial.origin.place, "touchdown_angle_deg = " + Rounded(angle_deg) +
                                 " looks like radians; in degrees it would be " +
                                 Rounded(RadToDeg(angle_deg)));
  }

  void InspectLength(const Trial& trial) {
    const std::size_t samples = trial.trace.time_s.size();
    if (samples == 1) Warn(FilePlace(trial), "has a single sample, which shows no motion");
    const bool has_channel = std::any_of(
        dataset_.channels.begin(), dataset_.channels.end(), [&](const ChannelSpec& channel) {
          const std::vector<double>* values = trial.trace.Find(channel.id);
          return values != nullptr && !Finite(*values).empty();
        });
    if (!has_channel) Warn(FilePlace(trial), "has no sample of any channel and says nothing");
  }

  void InspectTimes(const Trial& trial) {
    const std::vector<double>& times = trial.trace.time_s;
    if (times.size() < 2) return;
    const double ratio = FallRatio(trial);
    const double duration = times.back() - times.front();
    const double step = duration / static_cast<double>(times.size() - 1);
    const bool slow = duration > kLongestTrial_s || step >= kCoarsestStep_s;
    const auto near = [&](double factor) { return IsNear(ratio, factor); };
    if (near(kMilliseconds) || (slow && !near(1))) {
      Warn(FilePlace(trial), "time_s spans " + Rounded(duration) + " s in steps of " +
                                 Rounded(step) + " s, which looks like milliseconds");
    } else if (near(1e3)) {
      Warn(FilePlace(trial),
           "body_y_m falls at " + Rounded(ratio) + " times gravity, which looks like millimetres");
    } else if (std::isfinite(ratio) && !near(1)) {
      Warn(FilePlace(trial), "body_y_m falls at " + Rounded(ratio) +
                                 " times gravity; check the units of body_y_m and time_s");
    }
  }

  void InspectStart(const Trial& trial) {
    if (trial.initial && trial.initial->mode != StartMode::kFlight) return;
    const double height_m = TouchdownHeight(trial.mechanism, trial.touchdown_angle_rad);
    const std::vector<double>* column = trial.trace.Find(Channel::kBodyY);
    const std::vector<double> heights = column == nullptr ? std::vector<double>{} : Finite(*column);
    double sigma_m = 0.005;  // where the file states no uncertainty
    if (trial.initial_sigma && std::isfinite(trial.initial_sigma->y_m))
      sigma_m = std::max(sigma_m, trial.initial_sigma->y_m);
    const double lowest_m = height_m - 3 * sigma_m;
    if (!heights.empty() && *std::max_element(heights.begin(), heights.end()) < lowest_m) {
      Warn(FilePlace(trial), "body_y_m never reaches the touch-down height of " +
                                 Rounded(height_m) + " m: the trace is never in flight");
    } else if (trial.initial && trial.initial->y_m < lowest_m) {
      Warn(trial.origin.place, "initial.y_m = " + Rounded(trial.initial->y_m) +
                                   " lies below the touch-down height of " + Rounded(height_m) +
                                   " m; the first row must lie in flight");
    } else if (!heights.empty() && heights.front() < lowest_m) {
      Warn(FilePlace(trial), "body_y_m starts at " + Rounded(heights.front()) +
                                 ", below the touch-down height of " + Rounded(height_m) +
                                 " m; the first row must lie in flight");
    }
    const double ratio = FallRatio(trial);
    const bool in_flight = trial.initial && trial.initial->mode == StartMode::kFlight;
    if (!in_flight || column == nullptr || (std::isfinite(ratio) && !IsNear(ratio, 1))) return;
    const StateSpec known = trial.initial_sigma.value_or(StateSpec{});
    InspectVelocity(trial, Channel::kBodyX,
                    {"initial.vx_m_per_s", trial.initial->vx_m_per_s, known.vx_m_per_s, 0.0});
    InspectVelocity(trial, Channel::kBodyY,
                    {"initial.vy_m_per_s", trial.initial->vy_m_per_s, known.vy_m_per_s,
                     -trial.mechanism.gravity_m_per_s2});
  }

  struct StatedVelocity {
    const char* key;
    double value, sigma;  // m/s
    double acceleration;  // in flight [m/s^2]
  };
  // A start that is stated far from how the trace begins: an axis that points the other way, a
  // velocity in other units.
  void InspectVelocity(const Trial& trial, Channel id, const StatedVelocity& stated) {
    const std::vector<double>* column = trial.trace.Find(id);
    if (column == nullptr || !std::isfinite(stated.value)) return;
    const std::vector<double>& times = trial.trace.time_s;
    const std::vector<double>& heights = *trial.trace.Find(Channel::kBodyY);
    const double lands_m = TouchdownHeight(trial.mechanism, trial.touchdown_angle_rad);
    std::vector<double> t, y;
    for (std::size_t i = 0; i < times.size() && times[i] - times[0] <= kBeginning_s; ++i) {
      if (heights[i] < lands_m) break;
      if (!std::isfinite((*column)[i])) continue;
      const double since = times[i] - times[0];
      t.push_back(since);
      y.push_back((*column)[i] - 0.5 * stated.acceleration * since * since);
    }
    if (t.size() < kFewest) return;
    const double begins = MedianSlope(t, y), off = std::abs(begins - stated.value);
    const double doubt = std::isfinite(stated.sigma) ? 3.0 * stated.sigma : 0.0;
    if (off < kVelocity_m_per_s + doubt || off < kVelocityShare * std::abs(begins)) return;
    if (std::all_of(column->begin(), column->end(), [&](double v) { return v == (*column)[0]; }))
      return;
    Warn(trial.origin.place, std::string(stated.key) + " = " + Rounded(stated.value) + ", but " +
                                 ChannelName(id) + " begins at " + Rounded(begins) +
                                 " m/s; check the direction of the axis and the units");
  }

  void InspectColumn(const Trial& trial, Channel id) {
    const std::vector<double>* column = trial.trace.Find(id);
    if (column == nullptr) return;
    const std::vector<double> values = Finite(*column);
    if (values.size() < 2) return;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    if (*low == *high)
      Warn(FilePlace(trial), std::string(ChannelName(id)) + " is " + FormatDouble(*low) +
                                 " throughout: a constant channel measures nothing");
  }

  void InspectSigma(const ChannelSpec& channel) {
    if (!channel.sigma || IsContact(channel.id)) return;
    std::vector<double> noises;
    std::vector<SampledColumn> columns;
    for (const Trial& trial : dataset_.trials) {
      const std::vector<double>* values = trial.trace.Find(channel.id);
      if (values == nullptr) continue;
      columns.push_back({trial.trace.time_s, *values});
      const double noise = HighFrequencyNoise(trial.trace.time_s, *values);
      const std::vector<double> finite = Finite(*values);
      // Rounding alone, as in a constant or simulated trace, says nothing of the sensor.
      const double size = std::max(std::abs(Quantile(finite, 0)), std::abs(Quantile(finite, 1)));
      if (noise > kRounding * size) noises.push_back(noise);
    }
    const double noise = Quantile(noises, 0.5);
    if (std::isnan(noise) || IsSmoothed(columns)) return;
    const double ratio = *channel.sigma / noise;
    if (ratio > 1 / kSigmaFactor && ratio < kSigmaFactor) return;
    Warn(channel.origin.place, std::string(ChannelName(channel.id)) +
                                   ": sigma = " + FormatDouble(*channel.sigma) + " is far " +
                                   (ratio < 1 ? "below" : "above") + " the noise of the traces, " +
                                   Rounded(noise) + "; `sigma: estimate` measures it");
  }

  const Dataset& dataset_;
  Warnings warnings_;
};

}  // namespace

std::string UnreadableTimes(const Dataset& dataset) {
  for (const Trial& trial : dataset.trials) {
    if (!IsNear(FallRatio(trial), kMilliseconds)) return "";
  }
  return dataset.trials.empty() ? ""
                                : "every trial falls at a millionth of gravity: time_s looks like "
                                  "milliseconds; divide it by 1000";
}

double MedianSlope(const std::vector<double>& t, const std::vector<double>& y) {
  std::vector<double> slopes;
  const std::size_t apart = t.size() / 2;
  for (std::size_t i = 0; i + apart < t.size(); ++i)
    slopes.push_back((y[i + apart] - y[i]) / (t[i + apart] - t[i]));
  return Quantile(slopes, 0.5);
}

std::vector<std::string> SuspectThings(const Dataset& dataset) {
  return Inspector(dataset).Inspect();
}

double HighFrequencyNoise(const std::vector<double>& times_s, const std::vector<double>& values) {
  std::vector<double> off;
  for (std::size_t i = 2; i + 2 < values.size(); ++i) {
    // Lagrange weights of the four neighbours at this sample's time.
    const std::array<std::size_t, 4> at = {i - 2, i - 1, i + 1, i + 2};
    double predicted = 0, variance = 1;
    for (const std::size_t j : at) {
      double weight = 1;
      for (const std::size_t k : at)
        if (k != j) weight *= (times_s[i] - times_s[k]) / (times_s[j] - times_s[k]);
      predicted += weight * values[j];
      variance += weight * weight;
    }
    const double residual = (values[i] - predicted) / std::sqrt(variance);
    if (std::isfinite(residual)) off.push_back(std::abs(residual));
  }
  if (off.size() < 20) return std::nan("");
  constexpr double kMedianOfAbsNormal = 0.6745;
  return Quantile(off, 0.5) / kMedianOfAbsNormal;
}

double ApparentGravity(const std::vector<double>& times_s, const std::vector<double>& heights_m) {
  std::vector<double> t, y;
  for (std::size_t i = 0; i < heights_m.size(); ++i) {
    if (!std::isfinite(heights_m[i])) continue;
    t.push_back(times_s[i]);
    y.push_back(heights_m[i]);
  }
  if (t.size() < 10) return std::nan("");
  const std::size_t window = std::max<std::size_t>(6, t.size() / 12);
  std::vector<double> curvatures;
  const std::size_t stride = std::max<std::size_t>(1, window / 6);
  for (std::size_t first = 0; first + window <= t.size(); first += stride)
    curvatures.push_back(Curvature(t, y, first, first + window));
  return -Quantile(Finite(curvatures), 0.1);
}

}  // namespace hoplab
