#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "model/simulate.h"

namespace hoplab {

/// The filter without lag that the logged pose of a body went through, M105:
///     Y(f) = X(f)/(1 + (2 pi f tau)^4),
/// a Butterworth filter of order 2 run to and fro, or a cubic smoothing spline (Silverman 1984).
struct PoseFilter {
  double tau = 0.0;  // s, positive
  int effect = 0;    // which of the request's effects it is
};
/// Channels that it filters: rates jump where the pose has a corner, and are of another sensor.
inline bool IsFiltered(Channel c) {
  return c == Channel::kBodyX || c == Channel::kBodyY || c == Channel::kBodyPitch;
}
/// None where no effect is one, or its tau is 0: there its derivative by tau is 0, too.
std::optional<PoseFilter> PoseFilterOf(std::span<const EffectSetting> effects);
/// Nor where the rows of the request lie so far apart that they do not see it.
std::optional<PoseFilter> PoseFilterOf(const SimulationRequest& request);

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
  FilterRows(const SimulationRequest& request, const PoseFilter& filter);

  std::span<const double> times() const { return times_; }
  /// `run` has the rows `times()`; afterwards the request's own, their pose filtered, with
  /// derivatives.
  void Filter(Trajectory& run) const;

 private:
  // The rows that say how the path goes on beyond `end`; all alike: it stays where it is.
  struct Path {
    std::size_t end, middle, far;
  };
  Path PathFrom(std::size_t end, std::size_t other_end) const;
  double Share(std::size_t row, std::size_t rows) const;
  std::size_t RowsReached(const Trajectory& run) const;
  Eigen::ArrayXXd ColumnsOf(const Trajectory& run, std::size_t rows) const;
  template <class Take>
  void Pass(const Eigen::ArrayXXd& columns, bool forward, const Take& take) const;
  void WriteFiltered(Trajectory& run) const;

  const SimulationRequest& request_;
  PoseFilter filter_;
  double step_;
  std::vector<double> times_;
  std::vector<std::size_t> own_;       // the request's among `times_`
  std::vector<std::size_t> filtered_;  // which of its channels are
  std::optional<std::size_t> by_tau_;  // which of its directions is tau
};

}  // namespace hoplab
