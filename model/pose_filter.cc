#include "model/pose_filter.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace hoplab {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

// Beyond this many time constants a weight is below 1e-13 of the first.
constexpr double kReach = 30.0 * std::numbers::sqrt2;
constexpr double kUnseen = 0.05;  // of a step: the row beside has a weight of 1e-6
constexpr double kBeside = 0.5;  // of a step, within which a row takes the place of one of the grid
constexpr double kWidestGrid = 0.004;  // s
constexpr double kPathBase = 0.004;    // s, between the rows that say how the path goes on

// The mean distance of two rows, or less.
double GridStep(std::span<const double> rows) {
  if (rows.size() < 2 || !(rows.back() > rows.front())) return kWidestGrid;
  const double mean = (rows.back() - rows.front()) / static_cast<double>(rows.size() - 1);
  return mean / std::ceil(mean / kWidestGrid);
}

// M105 as a mean over rows s: weights Re (1 - i) exp(-(1 - i) u) = exp(-u) (cos u + sin u),
// u = |t - s|/(sqrt(2) tau). Their derivative by tau is 2/tau Im u exp(-(1 - i) u).
constexpr Complex kTurn(1.0, -1.0);

// The sums over the rows on one side of a row, its own with them, of several columns at once. From
// row to row they shrink by one factor.
class OneSide {
 public:
  OneSide(double tau, Index columns)
      : unit_(std::numbers::sqrt2 * tau),
        sum_(Eigen::ArrayXcd::Zero(columns)),
        moment_(Eigen::ArrayXcd::Zero(columns)) {}
  // A row that is `distance` away from where the sums stand.
  template <class Values>
  void AddAt(double distance, double weight, const Values& values) {
    const double u = distance / unit_;
    const Complex decay = weight * std::exp(-kTurn * u);
    sum_ += decay * values;
    moment_ += u * decay * values;
  }
  void Advance(double distance) {
    const double u = distance / unit_;
    const Complex decay = std::exp(-kTurn * u);
    moment_ = decay * (moment_ + u * sum_);
    sum_ *= decay;
  }
  Eigen::ArrayXd Sum() const { return sum_.real() + sum_.imag(); }
  Eigen::ArrayXd Moment() const { return moment_.imag(); }

 private:
  double unit_;
  Eigen::ArrayXcd sum_, moment_;
};

}  // namespace

std::vector<double> ThroughFilter(const PoseFilter& filter, std::span<const double> times,
                                  std::span<const double> values) {
  const auto n = static_cast<Index>(times.size());
  Eigen::ArrayXXd sums = Eigen::ArrayXXd::Zero(n, 2);  // of the values, of the weights
  const auto at = [&](Index i) { return times[static_cast<std::size_t>(i)]; };
  const auto row = [&](Index i) {
    return Eigen::Array2d(values[static_cast<std::size_t>(i)], 1.0);
  };
  OneSide before(filter.tau, 2), after(filter.tau, 2);
  for (Index i = 0; i < n; ++i) {
    if (i > 0) before.Advance(at(i) - at(i - 1));
    before.AddAt(0.0, 1.0, row(i));
    sums.row(i) += before.Sum().transpose() - row(i).transpose();
  }
  for (Index i = n - 1; i >= 0; --i) {
    if (i < n - 1) after.Advance(at(i + 1) - at(i));
    after.AddAt(0.0, 1.0, row(i));
    sums.row(i) += after.Sum().transpose();
  }
  std::vector<double> filtered;
  for (Index i = 0; i < n; ++i) filtered.push_back(sums(i, 0) / sums(i, 1));
  return filtered;
}

std::optional<PoseFilter> PoseFilterOf(std::span<const EffectSetting> effects) {
  for (std::size_t e = 0; e < effects.size(); ++e) {
    const EffectSetting& setting = effects[e];
    const auto change = setting.effect->hooks0.change_filter_time;
    if (!change) continue;
    PoseFilter filter{0.0, static_cast<int>(e)};
    change(setting.values.data(), filter.tau);
    if (filter.tau > 0.0) return filter;
  }
  return std::nullopt;
}

std::optional<PoseFilter> PoseFilterOf(const SimulationRequest& request) {
  const std::optional<PoseFilter> filter = PoseFilterOf(request.effects);
  if (!filter || request.row_times.empty()) return std::nullopt;
  return filter->tau < kUnseen * GridStep(request.row_times) ? std::nullopt : filter;
}

FilterRows::FilterRows(const SimulationRequest& request, const PoseFilter& filter)
    : request_(request), filter_(filter), step_(GridStep(request.row_times)) {
  const std::span<const double> rows = request.row_times;
  const double last = std::min(rows.back() + kReach * filter.tau, request.horizon);
  const auto own_until = [&](double time) {
    for (; own_.size() < rows.size() && rows[own_.size()] <= time;) {
      times_.push_back(rows[own_.size()]);
      own_.push_back(times_.size() - 1);
    }
  };
  for (int k = 0; rows.front() + k * step_ <= last; ++k) {
    const double time = rows.front() + k * step_;
    own_until(time + kBeside * step_);
    if (times_.back() < time - kBeside * step_) times_.push_back(time);
  }
  own_until(rows.back());
  for (std::size_t c = 0; c < request.channels.size(); ++c)
    if (IsFiltered(request.channels[c])) filtered_.push_back(c);
  for (std::size_t k = 0; k < request.directions.size() && !by_tau_; ++k) {
    const SensitivityDirection& d = request.directions[k];
    if (d.of == SensitivityDirection::Of::kEffect && d.index == filter.effect) by_tau_ = k;
  }
}

FilterRows::Path FilterRows::PathFrom(std::size_t end, std::size_t other_end) const {
  const auto further = [&](std::size_t row) {
    const double begin = times_[row];
    while (row != other_end && std::abs(times_[row] - begin) < kPathBase)
      row += other_end > end ? 1 : -1;
    return row;
  };
  const std::size_t middle = further(end), far = further(middle);
  if (far == middle) return {end, end, end};
  return {end, middle, far};
}

// What every row of the run says: 1, and of each filtered channel the sample and its derivatives.
Eigen::ArrayXXd FilterRows::ColumnsOf(const Trajectory& run, std::size_t rows) const {
  const std::size_t channels = request_.channels.size(), width = request_.directions.size();
  Eigen::ArrayXXd columns(static_cast<Index>(filtered_.size() * (1 + width) + 1),
                          static_cast<Index>(rows));
  for (std::size_t row = 0; row < rows; ++row) {
    double* to = columns.col(static_cast<Index>(row)).data();
    *to++ = 1.0;
    for (const std::size_t c : filtered_) {
      const std::size_t cell = row * channels + c;
      *to++ = run.samples[cell];
      to = std::copy_n(run.sensitivities.data() + cell * width, width, to);
    }
  }
  return columns;
}

// The sums at each of the first `rows`, on one side: `first` is the row they begin with.
template <class Take>
void FilterRows::Pass(const Eigen::ArrayXXd& columns, bool forward, const Take& take) const {
  const auto rows = static_cast<std::size_t>(columns.cols());
  const auto column = [&](std::size_t row) { return columns.col(static_cast<Index>(row)); };
  const std::size_t first = forward ? 0 : rows - 1, last = forward ? rows - 1 : 0;
  OneSide side(filter_.tau, columns.rows());
  // Beyond the first row the path goes on.
  const Path path = PathFrom(first, last);
  const double a = times_[path.end], b = times_[path.middle], c = times_[path.far];
  for (int k = 1; k * step_ <= kReach * filter_.tau; ++k) {
    const double t = forward ? a - k * step_ : a + k * step_;
    if (path.far == path.end) {
      side.AddAt(k * step_, 2.0 * step_, column(path.end));
      continue;
    }
    side.AddAt(k * step_, 2.0 * step_ * (t - b) * (t - c) / ((a - b) * (a - c)), column(path.end));
    side.AddAt(k * step_, 2.0 * step_ * (t - a) * (t - c) / ((b - a) * (b - c)),
               column(path.middle));
    side.AddAt(k * step_, 2.0 * step_ * (t - a) * (t - b) / ((c - a) * (c - b)), column(path.far));
  }
  for (std::size_t count = 0; count < rows; ++count) {
    const std::size_t row = forward ? count : rows - 1 - count;
    if (count > 0) side.Advance(std::abs(times_[row] - times_[forward ? row - 1 : row + 1]));
    side.AddAt(0.0, Share(row, rows), column(row));
    take(row, side);
  }
}

// The stretch of time that a row stands for, twice.
double FilterRows::Share(std::size_t row, std::size_t rows) const {
  const double before = row > 0 ? times_[row - 1] : times_[row] - step_;
  const double after = row + 1 < rows ? times_[row + 1] : times_[row] + step_;
  return after - before;
}

// The first rows of which the run tells every filtered channel.
std::size_t FilterRows::RowsReached(const Trajectory& run) const {
  std::size_t rows = filtered_.empty() ? 0 : times_.size();
  for (const std::size_t c : filtered_)
    for (std::size_t row = 0; row < rows; ++row)
      if (std::isnan(run.samples[row * request_.channels.size() + c])) rows = row;
  return rows;
}

void FilterRows::WriteFiltered(Trajectory& run) const {
  const std::size_t rows = RowsReached(run), width = request_.directions.size();
  if (rows == 0) return;
  const Eigen::ArrayXXd columns = ColumnsOf(run, rows);
  Eigen::ArrayXXd sums = -columns, moments = Eigen::ArrayXXd::Zero(columns.rows(), columns.cols());
  for (std::size_t row = 0; row < rows; ++row)
    sums.col(static_cast<Index>(row)) *= Share(row, rows);
  for (const bool forward : {true, false})
    Pass(columns, forward, [&](std::size_t row, const OneSide& side) {
      sums.col(static_cast<Index>(row)) += side.Sum();
      moments.col(static_cast<Index>(row)) += side.Moment();
    });
  for (std::size_t row = 0; row < rows; ++row) {
    const auto sum = sums.col(static_cast<Index>(row));
    const auto moment = moments.col(static_cast<Index>(row));
    for (std::size_t k = 0; k < filtered_.size(); ++k) {
      const std::size_t cell = row * request_.channels.size() + filtered_[k];
      const auto at = static_cast<Index>(1 + k * (1 + width));
      run.samples[cell] = sum[at] / sum[0];
      for (std::size_t i = 0; i < width; ++i)
        run.sensitivities[cell * width + i] = sum[at + 1 + static_cast<Index>(i)] / sum[0];
      if (by_tau_)
        run.sensitivities[cell * width + *by_tau_] +=
            2.0 / filter_.tau * (moment[at] - run.samples[cell] * moment[0]) / sum[0];
    }
  }
}

void FilterRows::Filter(Trajectory& run) const {
  WriteFiltered(run);
  const std::size_t columns = request_.channels.size(), width = request_.directions.size();
  for (std::size_t i = 0; i < own_.size(); ++i) {
    std::copy_n(run.samples.begin() + static_cast<std::ptrdiff_t>(own_[i] * columns), columns,
                run.samples.begin() + static_cast<std::ptrdiff_t>(i * columns));
    std::copy_n(run.sensitivities.begin() + static_cast<std::ptrdiff_t>(own_[i] * columns * width),
                columns * width,
                run.sensitivities.begin() + static_cast<std::ptrdiff_t>(i * columns * width));
  }
  run.samples.resize(own_.size() * columns);
  run.sensitivities.resize(own_.size() * columns * width);
  const auto in_run = static_cast<std::size_t>(run.rows_in_run);
  run.rows_in_run =
      static_cast<int>(std::lower_bound(own_.begin(), own_.end(), in_run) - own_.begin());
}

}  // namespace hoplab
