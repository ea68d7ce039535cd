#include "tests/support/bridge_sampling.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "base/random.h"

namespace hoplab::testing {
namespace {

constexpr double kDegrees = 6.0;  // of Student's t: tails that are heavier than a normal's

// Student's t in several dimensions, with the mean and the covariance given.
class StudentT {
 public:
  StudentT(Eigen::VectorXd mean, const Eigen::MatrixXd& covariance) : mean_(std::move(mean)) {
    const auto n = static_cast<double>(mean_.size());
    const Eigen::MatrixXd shape = covariance * (kDegrees - 2.0) / kDegrees;
    const Eigen::LLT<Eigen::MatrixXd> llt(shape);
    if (llt.info() != Eigen::Success) throw std::runtime_error("the spread of a chain is singular");
    L_ = llt.matrixL();
    log_constant_ = std::lgamma(0.5 * (kDegrees + n)) - std::lgamma(0.5 * kDegrees) -
                    0.5 * n * std::log(kDegrees * std::numbers::pi) -
                    L_.diagonal().array().log().sum();
  }
  Eigen::VectorXd Draw(RandomStream& random) const {
    double chi2 = 0.0;
    for (int i = 0; i < static_cast<int>(kDegrees); ++i) chi2 += std::pow(random.Normal(), 2);
    Eigen::VectorXd z(mean_.size());
    for (double& value : z) value = random.Normal();
    return mean_ + L_ * z * std::sqrt(kDegrees / chi2);
  }
  double LogDensity(const Eigen::VectorXd& x) const {
    const Eigen::VectorXd z = L_.triangularView<Eigen::Lower>().solve(x - mean_);
    return log_constant_ - 0.5 * (kDegrees + static_cast<double>(mean_.size())) *
                               std::log1p(z.squaredNorm() / kDegrees);
  }
  /// A step of a random walk.
  Eigen::VectorXd Step(RandomStream& random) const {
    Eigen::VectorXd z(mean_.size());
    for (double& value : z) value = random.Normal();
    return 2.0 / std::sqrt(static_cast<double>(mean_.size())) * (L_ * z);
  }

 private:
  Eigen::VectorXd mean_;
  Eigen::MatrixXd L_;
  double log_constant_ = 0.0;
};

struct Point {
  Eigen::VectorXd x;
  double log_f = 0.0;
};

// Mean and covariance of points.
StudentT FittedTo(const std::vector<Point>& points, std::size_t first, std::size_t end) {
  const auto n = static_cast<double>(end - first);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(points[first].x.size());
  for (std::size_t i = first; i < end; ++i) mean += points[i].x / n;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(mean.size(), mean.size());
  for (std::size_t i = first; i < end; ++i) {
    const Eigen::VectorXd off = points[i].x - mean;
    covariance += off * off.transpose() / n;
  }
  return {mean, covariance};
}

class Chain {
 public:
  Chain(const LogFunction& log_f, Point begin, RandomStream& random)
      : log_f_(log_f), at_(std::move(begin)), random_(random) {}

  void Walk(const StudentT& spread, double scale) {
    Take(at_.x + scale * spread.Step(random_), 0.0, 0.0);
  }
  void Jump(const StudentT& spread) {
    Eigen::VectorXd to = spread.Draw(random_);
    const double from_density = spread.LogDensity(at_.x), to_density = spread.LogDensity(to);
    Take(std::move(to), from_density, to_density);
  }
  const Point& at() const { return at_; }
  bool moved() const { return moved_; }

 private:
  void Take(Eigen::VectorXd x, double log_back, double log_there) {
    const double log_f = log_f_(x);
    moved_ = std::log(random_.Uniform(0.0, 1.0)) < log_f + log_back - at_.log_f - log_there;
    if (moved_) at_ = {std::move(x), log_f};
  }

  const LogFunction& log_f_;
  Point at_;
  RandomStream& random_;
  bool moved_ = false;
};

// Points of a random walk whose spread is learnt anew at every quarter.
std::vector<Point> WarmUp(const LogFunction& log_f, const Eigen::VectorXd& begin,
                          const Eigen::MatrixXd& covariance, const SamplingSettings& settings) {
  RandomStream random(settings.seed, 1);
  Chain chain(log_f, {begin, log_f(begin)}, random);
  if (!std::isfinite(chain.at().log_f)) throw std::runtime_error("a chain begins at zero");
  StudentT spread(begin, covariance);
  double scale = 1.0;
  std::vector<Point> points;
  const int quarter = settings.warm_up / 4;
  for (int step = 0; step < settings.warm_up; ++step) {
    if (step > 0 && step % quarter == 0) {
      spread = FittedTo(points, points.size() / 2, points.size());
      scale = 1.0;
    }
    chain.Walk(spread, scale);
    // A quarter of the steps shall move.
    scale *= std::exp((chain.moved() ? 0.75 : -0.25) * 0.05);
    points.push_back(chain.at());
  }
  points.erase(points.begin(), points.begin() + settings.warm_up / 2);
  return points;
}

// The ratio of the integrals of f and of the density, by the optimal bridge: `at_points` and
// `at_draws` are log f - log density at points of f and at draws from the density; `worth` is what
// share of the points counts as independent.
double LogBridge(const std::vector<double>& at_points, const std::vector<double>& at_draws,
                 double worth) {
  std::vector<double> sorted = at_points;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2),
                   sorted.end());
  const double middle = sorted[sorted.size() / 2];
  const auto n2 = static_cast<double>(at_draws.size());
  const double n1 = worth * static_cast<double>(at_points.size());
  const double s1 = n1 / (n1 + n2), s2 = n2 / (n1 + n2);
  double r = 1.0;
  for (int i = 0; i < 1000; ++i) {
    double above = 0.0, below = 0.0;
    for (const double l : at_draws) {
      const double ratio = std::exp(l - middle);
      above += ratio / (s1 * ratio + s2 * r) / n2;
    }
    for (const double l : at_points)
      below += 1.0 / (s1 * std::exp(l - middle) + s2 * r) / static_cast<double>(at_points.size());
    const double next = above / below;
    const bool ends = std::abs(next - r) < 1e-10 * next;
    r = next;
    if (ends) break;
  }
  return std::log(r) + middle;
}

}  // namespace

SampledIntegral SampleIntegral(const LogFunction& log_f, const Eigen::VectorXd& begin,
                               const Eigen::MatrixXd& covariance,
                               const SamplingSettings& settings) {
  constexpr double kWorth = 0.2;  // no more than the bridge's shape depends on it
  const std::vector<Point> warm = WarmUp(log_f, begin, covariance, settings);
  const StudentT spread = FittedTo(warm, 0, warm.size());
  SampledIntegral out;
  std::vector<double> values;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(begin.size()), squares = sum;
  for (int c = 0; c < settings.chains; ++c) {
    RandomStream random(settings.seed, 100 + static_cast<std::uint64_t>(c));
    const std::size_t from = warm.size() * static_cast<std::size_t>(c + 1) /
                             (static_cast<std::size_t>(settings.chains) + 1);
    Chain chain(log_f, warm[from], random);
    std::vector<Point> points;
    for (int step = 0; step < settings.draws; ++step) {
      if (step % 2 == 0) {
        chain.Walk(spread, 1.0);
      } else {
        chain.Jump(spread);
      }
      out.acceptance += chain.moved();
      points.push_back(chain.at());
      sum += points.back().x;
      squares += points.back().x.cwiseAbs2();
    }
    // Half of the points fit the density, the other half bridge to it.
    const std::size_t half = points.size() / 2;
    const StudentT density = FittedTo(points, 0, half);
    std::vector<double> at_points, at_draws;
    for (std::size_t i = half; i < points.size(); ++i)
      at_points.push_back(points[i].log_f - density.LogDensity(points[i].x));
    for (int i = 0; i < settings.proposals; ++i) {
      const Eigen::VectorXd x = density.Draw(random);
      at_draws.push_back(log_f(x) - density.LogDensity(x));
    }
    values.push_back(LogBridge(at_points, at_draws, kWorth));
  }
  const auto n = static_cast<double>(values.size());
  for (const double v : values) out.log_value += v / n;
  for (const double v : values) out.std_error += std::pow(v - out.log_value, 2) / (n * (n - 1.0));
  out.std_error = std::sqrt(out.std_error);
  const double steps = n * settings.draws;
  out.acceptance /= steps;
  out.evaluations = settings.warm_up + static_cast<long>(n) * (settings.draws + settings.proposals);
  out.mean = sum / steps;
  out.deviation = (squares / steps - out.mean.cwiseAbs2()).cwiseSqrt();
  return out;
}

}  // namespace hoplab::testing
