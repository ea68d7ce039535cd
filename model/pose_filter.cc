#include "model/pose_filter.h"

#include <algorithm>
#include <cmath>

#include "model/filtered_columns.h"

namespace hoplab {
namespace {

using Eigen::Index;

constexpr double kUnseen = 0.05;  // of a step: the row beside has a weight of 1e-6
constexpr double kBeside = 0.5;  // of a step, within which a row takes the place of one of the grid
constexpr double kWidestGrid = 0.004;  // s

// The mean distance of two rows, or less.
double GridStep(std::span<const double> rows) {
  if (rows.size() < 2 || !(rows.back() > rows.front())) return kWidestGrid;
  const double mean = (rows.back() - rows.front()) / static_cast<double>(rows.size() - 1);
  return mean / std::ceil(mean / kWidestGrid);
}

}  // namespace

std::vector<double> ThroughFilter(const PoseFilter& filter, std::span<const double> times,
                                  std::span<const double> values) {
  if (times.empty()) return {};
  Eigen::ArrayXXd columns = Eigen::ArrayXXd::Ones(2, static_cast<Index>(times.size()));
  std::copy(values.begin(), values.end(), columns.row(1).begin());
  const FilteredColumns out =
      ThroughFilter(filter.shape, filter.time, GridStep(times), times, columns, /*goes_on=*/false);
  std::vector<double> filtered(values.size());
  for (std::size_t i = 0; i < filtered.size(); ++i) {
    const auto row = static_cast<Index>(i);
    filtered[i] = out.sums(1, row) / out.sums(0, row);
  }
  return filtered;
}

std::vector<PoseFilter> PoseFiltersOf(std::span<const EffectSetting> effects) {
  std::vector<PoseFilter> filters;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    const RecordFilter shape = effects[e].effect->info.filter;
    if (shape != RecordFilter::kNone && effects[e].values[0] > 0.0)
      filters.push_back({effects[e].values[0], static_cast<int>(e), shape});
  }
  return filters;
}

std::vector<PoseFilter> PoseFiltersOf(const SimulationRequest& request) {
  std::vector<PoseFilter> filters;
  if (request.effects.empty() || request.row_times.empty()) return filters;
  filters = PoseFiltersOf(request.effects);
  if (filters.empty()) return filters;
  const double unseen = kUnseen * GridStep(request.row_times);
  std::erase_if(filters, [unseen](const PoseFilter& filter) { return filter.time < unseen; });
  return filters;
}

FilterRows::FilterRows(const SimulationRequest& request, std::span<const PoseFilter> filters)
    : request_(request), filters_(filters), step_(GridStep(request.row_times)) {
  const std::span<const double> rows = request.row_times;
  double reach = 0.0;
  for (const PoseFilter& filter : filters) reach += ReachOf(filter.shape, filter.time);
  const double last = std::min(rows.back() + reach, request.horizon);
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

// The first rows of which the run tells every filtered channel.
std::size_t FilterRows::RowsReached(const Trajectory& run) const {
  std::size_t rows = filtered_.empty() ? 0 : times_.size();
  for (const std::size_t c : filtered_)
    for (std::size_t row = 0; row < rows; ++row)
      if (std::isnan(run.samples[row * request_.channels.size() + c])) rows = row;
  return rows;
}

void FilterRows::WriteFiltered(const PoseFilter& filter, Trajectory& run) const {
  const std::size_t rows = RowsReached(run), width = request_.directions.size();
  if (rows == 0) return;
  const FilteredColumns out = ThroughFilter(filter.shape, filter.time, step_,
                                            std::span(times_).first(rows), ColumnsOf(run, rows));
  std::size_t by_time = 0;  // which of the directions it is, if any
  const auto is_time = [&](const SensitivityDirection& d) {
    return d.of == SensitivityDirection::Of::kEffect && d.index == filter.effect;
  };
  while (by_time < width && !is_time(request_.directions[by_time])) ++by_time;
  for (std::size_t row = 0; row < rows; ++row) {
    const auto sum = out.sums.col(static_cast<Index>(row));
    const auto slope = out.slopes.col(static_cast<Index>(row));
    for (std::size_t k = 0; k < filtered_.size(); ++k) {
      const std::size_t cell = row * request_.channels.size() + filtered_[k];
      const auto at = static_cast<Index>(1 + k * (1 + width));
      run.samples[cell] = sum[at] / sum[0];
      for (std::size_t i = 0; i < width; ++i)
        run.sensitivities[cell * width + i] = sum[at + 1 + static_cast<Index>(i)] / sum[0];
      if (by_time < width)
        run.sensitivities[cell * width + by_time] +=
            (slope[at] - run.samples[cell] * slope[0]) / (filter.time * sum[0]);
    }
  }
}

void FilterRows::Filter(Trajectory& run) const {
  for (const PoseFilter& filter : filters_) WriteFiltered(filter, run);
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
