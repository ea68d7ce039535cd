#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/simulate.h"

namespace hoplab {

/// A filter that the logged pose of a body went through, M105 and M117.
struct PoseFilter {
  double time = 0.0;  // s, positive
  int effect = 0;     // which of the request's effects it is
  RecordFilter shape = RecordFilter::kTwoPass;
};
/// Channels that it filters: rates jump where the pose has a corner, and are of another sensor.
inline bool IsFiltered(Channel c) {
  return c == Channel::kBodyX || c == Channel::kBodyY || c == Channel::kBodyPitch;
}
/// In their order; one whose time is 0 is none: there its derivative by that time is 0, too.
std::vector<PoseFilter> PoseFiltersOf(std::span<const EffectSetting> effects);
/// Nor are those that rows as far apart as the request's do not see.
std::vector<PoseFilter> PoseFiltersOf(const SimulationRequest& request);

/// An evenly sampled column of its own, such as noise, through the filter.
std::vector<double> ThroughFilter(const PoseFilter& filter, std::span<const double> times,
                                  std::span<const double> values);

/// Beyond the last row a run goes on this long where its pose is filtered [s].
inline constexpr double kFilterMargin = 0.1;

/// The rows that a filtered run reads: the request's own, and between and after them those of an
/// even grid. Before the first, and after the last that the run reaches, the path goes on as the
/// parabola through three rows there: a body in the air is not simulated to be known.
class FilterRows {
 public:
  FilterRows(const SimulationRequest& request, std::span<const PoseFilter> filters);

  std::span<const double> times() const { return times_; }
  /// `run` has the rows `times()`; afterwards the request's own, their pose filtered, with
  /// derivatives.
  void Filter(Trajectory& run) const;

 private:
  std::size_t RowsReached(const Trajectory& run) const;
  Eigen::ArrayXXd ColumnsOf(const Trajectory& run, std::size_t rows) const;
  void WriteFiltered(const PoseFilter& filter, Trajectory& run) const;

  const SimulationRequest& request_;
  std::span<const PoseFilter> filters_;
  double step_;
  std::vector<double> times_;
  std::vector<std::size_t> own_;       // the request's among `times_`
  std::vector<std::size_t> filtered_;  // which of its channels are
};

}  // namespace hoplab
