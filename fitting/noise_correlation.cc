#include "fitting/noise_correlation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "fitting/noise.h"

namespace hoplab {
namespace {

constexpr int kOfWindow = 20;               // samples of a window
constexpr double kLongestWindow_s = 0.21;   // flights are parabolas for so long
constexpr double kLeastCorrelation = 0.15;  // correlation that matters
constexpr double kStrongest = 0.95;         // that can be told
constexpr std::size_t kFewestWindows = 12;
constexpr double kSquaresOfFlight = 10.0;  // of a window, over the noise's: more is no flight

// What is left of a vector beside a parabola through `n` even times.
Eigen::MatrixXd LeftByParabola(int n) {
  Eigen::MatrixXd powers(n, 3);
  for (int i = 0; i < n; ++i) {
    const double s = 2.0 * i / (n - 1) - 1.0;
    powers.row(i) << 1.0, s, s * s;
  }
  const Eigen::MatrixXd q = powers.householderQr().householderQ() * Eigen::MatrixXd::Identity(n, 3);
  return Eigen::MatrixXd::Identity(n, n) - q * q.transpose();
}

// Expected squares and products of neighbours of what parabolas leave in a window of n samples,
// over the noise's square.
struct ExpectedLeft {
  double square = 0.0, product = 0.0;

  ExpectedLeft(double rho, int n) {
    Eigen::MatrixXd noise(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) noise(i, j) = std::pow(rho, std::abs(i - j));
    const Eigen::MatrixXd parabola = LeftByParabola(n), left = parabola * noise * parabola;
    square = left.trace();
    for (int i = 1; i < n; ++i) product += left(i, i - 1);
  }
  double Ratio() const { return product / square; }
};

// Of windows in flight.
struct SeenInFlight {
  double square = 0.0, product = 0.0;
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
      const double length = column.times[begin + kOfWindow - 1] - column.times[begin];
      begin += kOfWindow;
      const Eigen::VectorXd left =
          parabola * Eigen::Map<const Eigen::VectorXd>(values.data(), kOfWindow);
      const double square = left.squaredNorm();
      if (length > kLongestWindow_s || !(square < most)) continue;
      seen.square += square;
      seen.product += left.tail(kOfWindow - 1).dot(left.head(kOfWindow - 1));
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
  return low > kLeastCorrelation + 3.0 * error ? low : 0.0;
}

double WhiteStrength(double correlation) {
  return std::sqrt((1.0 + correlation) / (1.0 - correlation));
}

double SeenByParabolas(double correlation) {
  return std::sqrt(ExpectedLeft(correlation, kNoiseWindow).square / (kNoiseWindow - 3));
}

}  // namespace hoplab
