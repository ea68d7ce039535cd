#include "model/pose_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hoplab {
namespace {

// Beyond this many time constants its weights are below 1e-13 of the first: where one more row
// comes in as tau grows, differences of a hundred-thousandth of tau do not see it.
constexpr double kReach = 30.0 * std::numbers::sqrt2;
constexpr double kUnseen = 0.05;       // of a step: the row beside has a weight of 1e-6
constexpr double kBeside = 1e-6;       // of a step, below which two rows are one
constexpr double kWidestGrid = 0.004;  // s
constexpr double kEven = 1e-9;         // of a step
constexpr double kPathBase = 0.004;    // s, between the rows that say how the path goes on

// The mean distance of two rows, or less.
double GridStep(std::span<const double> rows) {
  if (rows.size() < 2 || !(rows.back() > rows.front())) return kWidestGrid;
  const double mean = (rows.back() - rows.front()) / static_cast<double>(rows.size() - 1);
  return mean / std::ceil(mean / kWidestGrid);
}

// M105 as a mean: exp(-u) (cos u + sin u), u = |distance|/(sqrt(2) tau).
FilterShare ShareOf(double distance, double tau) {
  const double u = std::abs(distance) / (std::numbers::sqrt2 * tau);
  const double decay = std::exp(-u), sine = std::sin(u);
  return {decay * (std::cos(u) + sine), 2.0 * u / tau * decay * sine};
}

}  // namespace

std::vector<double> ThroughFilter(const PoseFilter& filter, std::span<const double> times,
                                  std::span<const double> values) {
  std::vector<double> filtered;
  for (const double time : times) {
    double sum = 0.0, weights = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (std::abs(time - times[i]) > kReach * filter.tau) continue;
      const double weight = ShareOf(time - times[i], filter.tau).value;
      sum += weight * values[i];
      weights += weight;
    }
    filtered.push_back(sum / weights);
  }
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
  for (int k = 0; k * step_ <= kReach * filter.tau; ++k)
    shares_.push_back(ShareOf(k * step_, filter.tau));
}

FilterShare FilterRows::ShareAt(double distance) const {
  const double steps = std::abs(distance) / step_, even = std::round(steps);
  const auto place = static_cast<std::size_t>(even);
  return std::abs(steps - even) < kEven && place < shares_.size() ? shares_[place]
                                                                  : ShareOf(distance, filter_.tau);
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

void FilterRows::AddBeyond(const Path& path, double time, double sign,
                           std::vector<Weight>& weights) const {
  const double a = times_[path.end], b = times_[path.middle], c = times_[path.far];
  Weight at[] = {{path.end}, {path.middle}, {path.far}};
  for (int k = 1;; ++k) {
    const double t = a + sign * k * step_;
    if (std::abs(t - time) > kReach * filter_.tau) break;
    const FilterShare share = ShareAt(time - t);
    double lagrange[] = {1.0, 0.0, 0.0};
    if (path.far != path.end) {
      lagrange[0] = (t - b) * (t - c) / ((a - b) * (a - c));
      lagrange[1] = (t - a) * (t - c) / ((b - a) * (b - c));
      lagrange[2] = (t - a) * (t - b) / ((c - a) * (c - b));
    }
    for (int i = 0; i < 3; ++i) {
      at[i].value += 2.0 * step_ * lagrange[i] * share.value;
      at[i].by_tau += 2.0 * step_ * lagrange[i] * share.by_tau;
    }
  }
  weights.insert(weights.end(), std::begin(at), std::end(at));
}

void FilterRows::WeightsAt(double time, std::size_t read, std::vector<Weight>& weights) const {
  weights.clear();
  const double reach = kReach * filter_.tau;
  const auto end = times_.begin() + static_cast<std::ptrdiff_t>(read);
  const auto begin = std::lower_bound(times_.begin(), end, time - reach);
  for (auto at = begin; at != end && *at <= time + reach; ++at) {
    const auto row = static_cast<std::size_t>(at - times_.begin());
    const double before = row > 0 ? times_[row - 1] : *at - step_;
    const double after = row + 1 < read ? times_[row + 1] : *at + step_;
    const FilterShare share = ShareAt(time - *at);
    weights.push_back({row, share.value * (after - before), share.by_tau * (after - before)});
  }
  if (time - reach < times_.front()) AddBeyond(PathFrom(0, read - 1), time, -1.0, weights);
  if (time + reach > times_[read - 1]) AddBeyond(PathFrom(read - 1, 0), time, 1.0, weights);
  double sum = 0.0, sum_by_tau = 0.0;
  for (const Weight& w : weights) {
    sum += w.value;
    sum_by_tau += w.by_tau;
  }
  for (Weight& w : weights) {
    w.value /= sum;
    w.by_tau = w.by_tau / sum - w.value * sum_by_tau / sum;
  }
}

// The first rows of a filtered channel that the run tells.
std::size_t FilterRows::RowsReached(const Trajectory& run) const {
  const auto channel = std::find_if(request_.channels.begin(), request_.channels.end(), IsFiltered);
  if (channel == request_.channels.end()) return 0;
  auto cell = static_cast<std::size_t>(channel - request_.channels.begin());
  std::size_t rows = 0;
  for (; rows < times_.size() && !std::isnan(run.samples[cell]); ++rows)
    cell += request_.channels.size();
  return rows;
}

void FilterRows::Filter(Trajectory& run) const {
  const std::size_t columns = request_.channels.size(), width = request_.directions.size();
  std::vector<double> samples(own_.size() * columns);
  std::vector<double> slopes(samples.size() * width);
  const auto is_tau = [&](const SensitivityDirection& d) {
    return d.of == SensitivityDirection::Of::kEffect && d.index == filter_.effect;
  };
  std::optional<std::size_t> by_tau;
  for (std::size_t k = 0; k < width && !by_tau; ++k)
    if (is_tau(request_.directions[k])) by_tau = k;
  const auto slopes_of = [&](std::size_t cell) { return run.sensitivities.data() + cell * width; };
  const std::size_t read = RowsReached(run);
  std::vector<Weight> weights;
  for (std::size_t i = 0; i < own_.size(); ++i) {
    const bool reached = own_[i] < read;
    if (reached) WeightsAt(times_[own_[i]], read, weights);
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t from = own_[i] * columns + c, to = i * columns + c;
      double* const slope = slopes.data() + to * width;
      if (!reached || !IsFiltered(request_.channels[c])) {
        samples[to] = run.samples[from];
        std::copy_n(slopes_of(from), width, slope);
        continue;
      }
      for (const Weight& w : weights) {
        const std::size_t cell = w.row * columns + c;
        samples[to] += w.value * run.samples[cell];
        for (std::size_t k = 0; k < width; ++k) slope[k] += w.value * slopes_of(cell)[k];
        if (by_tau) slope[*by_tau] += w.by_tau * run.samples[cell];
      }
    }
  }
  const auto in_run = static_cast<std::size_t>(run.rows_in_run);
  run.rows_in_run =
      static_cast<int>(std::lower_bound(own_.begin(), own_.end(), in_run) - own_.begin());
  run.samples = std::move(samples);
  run.sensitivities = std::move(slopes);
}

}  // namespace hoplab
