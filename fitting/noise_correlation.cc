#include "fitting/noise_correlation.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fitting/left_by_parabola.h"
#include "fitting/noise.h"

namespace hoplab {
namespace {

constexpr int kOfWindow = 20;               // samples of a window
constexpr double kLongestWindow_s = 0.21;   // flights are parabolas for so long
constexpr double kLeastCorrelation = 0.15;  // correlation that matters
constexpr double kStrongest = 0.95;         // that can be told
constexpr std::size_t kFewestWindows = 12;
// Standard error of a measured roughness (LeftInWindows) of AR(1) noise, rho 0.3 to 0.9, by
// simulation: 1.3 to 1.7 over the root of the samples.
constexpr double kRoughnessError = 1.5;
constexpr double kSquaresOfFlight = 10.0;  // of a window, over the noise's: more is no flight

// What parabolas leave in windows: sums of squares, of products of neighbours, and of squares of
// the first and the second differences.
struct LeftInWindows {
  double square = 0.0, product = 0.0, first = 0.0, second = 0.0;

  double Ratio() const { return product / square; }
  // 3 - rho of AR(1) noise without a parabola, so 2 at least; less of a motion, which is smooth.
  double Roughness() const { return second / first; }
};

// Expected in a window of n samples, over the noise's square.
struct ExpectedLeft : LeftInWindows {
  ExpectedLeft(double rho, int n) {
    Eigen::MatrixXd noise(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) noise(i, j) = std::pow(rho, std::abs(i - j));
    const Eigen::MatrixXd parabola = LeftByParabola(n), left = parabola * noise * parabola;
    square = left.trace();
    for (int i = 1; i < n; ++i) product += left(i, i - 1);
    const Eigen::MatrixXd once = Differences(left), twice = Differences(once);
    first = once.trace();
    second = twice.trace();
  }

 private:
  // Covariance of the differences of neighbours, from that of the values.
  static Eigen::MatrixXd Differences(const Eigen::MatrixXd& c) {
    const Eigen::Index m = c.rows() - 1;
    return c.topLeftCorner(m, m) + c.bottomRightCorner(m, m) - c.topRightCorner(m, m) -
           c.bottomLeftCorner(m, m);
  }
};

// The first place of a window behind its last gap, where rows are missing; 0: it has none.
std::size_t BehindGap(std::span<const double> times) {
  constexpr double kGap = 1.5;  // of the usual step
  std::array<double, kOfWindow - 1> steps;
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = times[i + 1] - times[i];
  std::array<double, kOfWindow - 1> sorted = steps;
  const auto middle = sorted.begin() + sorted.size() / 2;
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (std::size_t i = steps.size(); i > 0; --i)
    if (steps[i - 1] > kGap * *middle) return i;
  return 0;
}

// Of windows in flight.
struct SeenInFlight : LeftInWindows {
  std::size_t windows = 0;
};
SeenInFlight LookAtFlights(std::span<const SampledColumn> columns, double most) {
  const Eigen::MatrixXd parabola = LeftByParabola(kOfWindow);
  SeenInFlight seen;
  for (const SampledColumn& column : columns) {
    for (std::size_t begin = 0; begin + kOfWindow <= column.values.size();) {
      const std::span<const double> values = column.values.subspan(begin, kOfWindow);
      const auto missing = std::find_if(values.rbegin(), values.rend(),
                                        [](double value) { return std::isnan(value); });
      if (missing != values.rend()) {
        begin += static_cast<std::size_t>(values.rend() - missing);
        continue;
      }
      const std::span<const double> times = column.times.subspan(begin, kOfWindow);
      if (const std::size_t behind = BehindGap(times); behind > 0) {
        begin += behind;
        continue;
      }
      const double length = times.back() - times.front();
      begin += kOfWindow;
      const Eigen::VectorXd left =
          parabola * Eigen::Map<const Eigen::VectorXd>(values.data(), kOfWindow);
      const double square = left.squaredNorm();
      if (length > kLongestWindow_s || !(square < most)) continue;
      seen.square += square;
      const auto later = left.tail(kOfWindow - 1), earlier = left.head(kOfWindow - 1);
      const Eigen::VectorXd step = later - earlier;
      seen.product += later.dot(earlier);
      seen.first += step.squaredNorm();
      seen.second += (step.tail(kOfWindow - 2) - step.head(kOfWindow - 2)).squaredNorm();
      ++seen.windows;
    }
  }
  return seen;
}

}  // namespace

double NoiseCorrelation(std::span<const SampledColumn> columns) {
  const double sigma = EstimateNoise(columns);
  const SeenInFlight seen =
      LookAtFlights(columns, kSquaresOfFlight * (kOfWindow - 3) * sigma * sigma);
  if (seen.windows < kFewestWindows || !(seen.square > 0.0)) return 0.0;
  const double ratio = seen.product / seen.square;
  double low = -0.5, high = kStrongest;
  if (ratio < ExpectedLeft(low, kOfWindow).Ratio()) return 0.0;
  for (int halvings = 0; halvings < 40; ++halvings) {
    const double middle = 0.5 * (low + high);
    (ExpectedLeft(middle, kOfWindow).Ratio() < ratio ? low : high) = middle;
  }
  const double error = 1.0 / std::sqrt(static_cast<double>(kOfWindow * seen.windows));
  if (seen.Roughness() < ExpectedLeft(low, kOfWindow).Roughness() - 3.0 * kRoughnessError * error)
    return 0.0;
  return low > kLeastCorrelation + 3.0 * error ? low : 0.0;
}

double WhiteStrength(double correlation) {
  return std::sqrt((1.0 + correlation) / (1.0 - correlation));
}

double SeenByParabolas(double correlation) {
  return std::sqrt(ExpectedLeft(correlation, kNoiseWindow).square / (kNoiseWindow - 3));
}

}  // namespace hoplab
