#include "model/filtered_columns.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "base/check.h"

namespace hoplab {
namespace {

using Complex = std::complex<double>;
using Eigen::ArrayXXd;
using Eigen::Index;

// Beyond so many units of time a weight that decays is below 1e-13 of the first.
constexpr double kDecayed = 30.0;
constexpr double kPathBase = 0.004;  // s, between the rows that say how the path goes on

struct Rows {
  std::span<const double> times;
  const ArrayXXd& values;
  double step;
  bool goes_on;  // beyond both ends

  double time(Index row) const { return times[static_cast<std::size_t>(row)]; }
  Index count() const { return values.cols(); }
  // The stretch of time that a row stands for, twice, and that after it.
  double After(Index row) const { return row + 1 < count() ? time(row + 1) - time(row) : step; }
  double Before(Index row) const { return row > 0 ? time(row) - time(row - 1) : step; }
};

// The parabola on which the path goes on beyond one end: through that row and two further in.
class Path {
 public:
  Path(const Rows& rows, bool at_first) : rows_(rows) {
    const Index last = at_first ? rows.count() - 1 : 0, inward = at_first ? 1 : -1;
    const auto further = [&](Index row) {
      const Index begin = row;
      while (row != last && std::abs(rows.time(row) - rows.time(begin)) < kPathBase) row += inward;
      return row;
    };
    end_ = at_first ? 0 : rows.count() - 1;
    middle_ = further(end_);
    far_ = further(middle_);
  }
  // Adds the values at `t` by `weight`: add(weight, row).
  template <class Add>
  void At(double t, const Add& add) const {
    if (far_ == middle_) return add(1.0, end_);  // it stays where it is
    const double a = rows_.time(end_), b = rows_.time(middle_), c = rows_.time(far_);
    add((t - b) * (t - c) / ((a - b) * (a - c)), end_);
    add((t - a) * (t - c) / ((b - a) * (b - c)), middle_);
    add((t - a) * (t - b) / ((c - a) * (c - b)), far_);
  }

 private:
  const Rows& rows_;
  Index end_, middle_, far_;
};

// A weight that decays away from a row, u units of time from it: exp(-u) (cos u + sin u) of
// kTwoPass, exp(-u) sin u of kOnePass, exp(-u) of kFirstOrder; its unit [s]. Below, exp(-turn u) is
// summed from row to row, of which these are parts.
struct Decay {
  RecordFilter shape;
  double unit;
  Complex turn;

  Decay(RecordFilter of, double time)
      : shape(of),
        unit(of == RecordFilter::kFirstOrder ? time : std::numbers::sqrt2 * time),
        turn(of == RecordFilter::kFirstOrder ? Complex(1.0, 0.0) : Complex(1.0, -1.0)) {}

  Eigen::ArrayXd Weights(const Eigen::ArrayXcd& sum) const {
    if (shape == RecordFilter::kOnePass) return sum.imag();
    if (shape == RecordFilter::kFirstOrder) return sum.real();
    return sum.real() + sum.imag();
  }
  // -u dw/du, from the sums of u exp(-turn u).
  Eigen::ArrayXd Slopes(const Eigen::ArrayXcd& moment) const {
    if (shape == RecordFilter::kOnePass) return moment.imag() - moment.real();
    if (shape == RecordFilter::kFirstOrder) return moment.real();
    return 2.0 * moment.imag();
  }
};

// The sums over the rows on one side of a row, its own with them, of several columns at once. From
// row to row they shrink by one factor.
class OneSide {
 public:
  OneSide(const Decay& decay, Index columns)
      : decay_(decay),
        sum_(Eigen::ArrayXcd::Zero(columns)),
        moment_(Eigen::ArrayXcd::Zero(columns)) {}
  // A row that is `distance` away from where the sums stand.
  template <class Values>
  void AddAt(double distance, double weight, const Values& values) {
    const double u = distance / decay_.unit;
    const Complex decay = weight * std::exp(-decay_.turn * u);
    sum_ += decay * values;
    moment_ += u * decay * values;
  }
  void Advance(double distance) {
    const double u = distance / decay_.unit;
    const Complex decay = std::exp(-decay_.turn * u);
    moment_ = decay * (moment_ + u * sum_);
    sum_ *= decay;
  }
  Eigen::ArrayXd Weights() const { return decay_.Weights(sum_); }
  Eigen::ArrayXd Slopes() const { return decay_.Slopes(moment_); }

 private:
  const Decay& decay_;
  Eigen::ArrayXcd sum_, moment_;
};

// Adds the sums at each row over those before it (`forward`) or after it.
void AddOneSide(const Rows& rows, const Decay& decay, bool forward, FilteredColumns& out) {
  OneSide side(decay, rows.values.rows());
  const Index first = forward ? 0 : rows.count() - 1;
  const Path path(rows, forward);
  const double step = rows.step;
  const double reach = rows.goes_on ? kDecayed * decay.unit : 0.0;
  for (int k = 1; k * step <= reach; ++k)
    path.At(forward ? rows.time(first) - k * step : rows.time(first) + k * step,
            [&](double weight, Index row) {
              side.AddAt(k * step, 2.0 * step * weight, rows.values.col(row));
            });
  for (Index count = 0; count < rows.count(); ++count) {
    const Index row = forward ? count : rows.count() - 1 - count;
    if (count > 0) side.Advance(forward ? rows.Before(row) : rows.After(row));
    side.AddAt(0.0, rows.Before(row) + rows.After(row), rows.values.col(row));
    out.sums.col(row) += side.Weights();
    out.slopes.col(row) += side.Slopes();
  }
}

// What a filter that looks back has of the past: the integrals of exp(-turn u) and u exp(-turn u)
// times the path, straight from row to row.
class Past {
 public:
  Past(const Decay& decay, Index columns)
      : decay_(decay),
        sum_(Eigen::ArrayXcd::Zero(columns)),
        moment_(Eigen::ArrayXcd::Zero(columns)) {}
  // On to the next row, `step` later.
  template <class Values>
  void GoOn(double step, const Values& from, const Values& to) {
    const double h = step / decay_.unit;
    const Complex z = decay_.turn * h, shrinks = std::exp(-z);
    const Complex whole = (1.0 - shrinks) / z, first = (1.0 - shrinks * (1.0 + z)) / (z * z),
                  second = (2.0 - shrinks * (z * z + 2.0 * z + 2.0)) / (z * z * z);
    moment_ = shrinks * (moment_ + h * sum_) + step * h * (second * from + (first - second) * to);
    sum_ = shrinks * sum_ + step * (first * from + (whole - first) * to);
  }
  Eigen::ArrayXd Weights() const { return decay_.Weights(sum_); }
  Eigen::ArrayXd Slopes() const { return decay_.Slopes(moment_); }

 private:
  const Decay& decay_;
  Eigen::ArrayXcd sum_, moment_;
};

FilteredColumns LookingBack(const Rows& rows, const Decay& decay) {
  const Index columns = rows.values.rows();
  FilteredColumns out{ArrayXXd(columns, rows.count()), ArrayXXd(columns, rows.count())};
  Past past(decay, columns);
  const Path path(rows, true);
  const auto before = [&](int steps) {
    Eigen::ArrayXd value = Eigen::ArrayXd::Zero(columns);
    path.At(rows.time(0) - steps * rows.step,
            [&](double weight, Index row) { value += weight * rows.values.col(row); });
    return value;
  };
  // Without a past it was what the first row is.
  Eigen::ArrayXd last = rows.values.col(0);
  const int far = static_cast<int>(std::ceil(kDecayed * decay.unit / rows.step));
  if (rows.goes_on) last = before(far);
  for (int k = far; k > 0; --k) {
    const Eigen::ArrayXd next = rows.goes_on && k > 1 ? before(k - 1) : rows.values.col(0);
    past.GoOn(rows.step, last, next);
    last = next;
  }
  for (Index row = 0; row < rows.count(); ++row) {
    const Eigen::ArrayXd next = rows.values.col(row);
    if (row > 0) past.GoOn(rows.Before(row), last, next);
    last = next;
    out.sums.col(row) = past.Weights();
    out.slopes.col(row) = past.Slopes();
  }
  return out;
}

FilteredColumns ToAndFro(const Rows& rows, const Decay& decay) {
  const Index columns = rows.values.rows();
  FilteredColumns out{ArrayXXd::Zero(columns, rows.count()), ArrayXXd::Zero(columns, rows.count())};
  AddOneSide(rows, decay, true, out);
  AddOneSide(rows, decay, false, out);
  // The row itself counts once in all.
  for (Index row = 0; row < rows.count(); ++row)
    out.sums.col(row) -= (rows.Before(row) + rows.After(row)) * rows.values.col(row);
  return out;
}

// The path as cubics between rows, with its integral from the first on.
class Integral {
 public:
  Integral(const Rows& rows, double reach) {
    const auto beyond = static_cast<Index>(std::ceil(reach / rows.step)) + 2;
    const Index n = rows.count(), all = n + 2 * beyond;
    times_.resize(static_cast<std::size_t>(all));
    values_ = ArrayXXd::Zero(rows.values.rows(), all);
    for (Index k = 1; k <= beyond; ++k) {
      const double away = static_cast<double>(k) * rows.step;
      for (const bool first : {true, false}) {
        const Index to = first ? beyond - k : beyond + n - 1 + k;
        const double t = first ? rows.time(0) - away : rows.time(n - 1) + away;
        times_[static_cast<std::size_t>(to)] = t;
        if (!rows.goes_on) continue;
        Path(rows, first).At(t, [&](double weight, Index row) {
          values_.col(to) += weight * rows.values.col(row);
        });
      }
    }
    values_.middleCols(beyond, n) = rows.values;
    std::copy_n(rows.times.begin(), n, times_.begin() + beyond);
    slopes_ = ArrayXXd::Zero(values_.rows(), all);
    for (Index i = 1; i + 1 < all; ++i) {
      const double before = Step(i - 1), after = Step(i);
      slopes_.col(i) = (before / after * (values_.col(i + 1) - values_.col(i)) +
                        after / before * (values_.col(i) - values_.col(i - 1))) /
                       (before + after);
    }
    sums_ = ArrayXXd::Zero(values_.rows(), all);
    for (Index i = 2; i + 1 < all; ++i)
      sums_.col(i) = sums_.col(i - 1) + Within(i - 1, 1.0, /*summed=*/true);
  }

  Eigen::ArrayXd SumTo(double t) const {
    const auto [cell, part] = Find(t);
    return sums_.col(cell) + Within(cell, part, /*summed=*/true);
  }
  Eigen::ArrayXd At(double t) const {
    const auto [cell, part] = Find(t);
    return Within(cell, part, /*summed=*/false);
  }

 private:
  double Step(Index i) const {
    return times_[static_cast<std::size_t>(i + 1)] - times_[static_cast<std::size_t>(i)];
  }
  struct Place {
    Index cell;
    double part;
  };
  Place Find(double t) const {
    const auto after = std::upper_bound(times_.begin() + 2, times_.end() - 2, t);
    const Index cell = after - times_.begin() - 1;
    return {cell, (t - times_[static_cast<std::size_t>(cell)]) / Step(cell)};
  }
  // At a part s of a cell, or its integral up to there.
  Eigen::ArrayXd Within(Index cell, double s, bool summed) const {
    const double h = Step(cell), s2 = s * s, s3 = s2 * s, s4 = s2 * s2;
    const double end = summed ? h * (s3 - 0.5 * s4) : 3.0 * s2 - 2.0 * s3;
    const double begin = (summed ? h * s : 1.0) - end;
    const double out =
        h * (summed ? h * (0.5 * s2 - 2.0 / 3.0 * s3 + 0.25 * s4) : s - 2.0 * s2 + s3);
    const double in = h * (summed ? h * (0.25 * s4 - s3 / 3.0) : s3 - s2);
    return begin * values_.col(cell) + end * values_.col(cell + 1) + out * slopes_.col(cell) +
           in * slopes_.col(cell + 1);
  }

  std::vector<double> times_;
  ArrayXXd values_, slopes_, sums_;
};

FilteredColumns Averaged(const Rows& rows, double width) {
  const Integral path(rows, 0.5 * width);
  FilteredColumns out{ArrayXXd(rows.values.rows(), rows.count()),
                      ArrayXXd(rows.values.rows(), rows.count())};
  for (Index row = 0; row < rows.count(); ++row) {
    const double from = rows.time(row) - 0.5 * width, to = rows.time(row) + 0.5 * width;
    out.sums.col(row) = path.SumTo(to) - path.SumTo(from);
    out.slopes.col(row) = 0.5 * width * (path.At(to) + path.At(from));
  }
  return out;
}

}  // namespace

FilteredColumns ThroughFilter(RecordFilter shape, double time, double step,
                              std::span<const double> times, const Eigen::ArrayXXd& values,
                              bool goes_on) {
  HOPLAB_CHECK(static_cast<Index>(times.size()) == values.cols() && shape != RecordFilter::kNone);
  const Rows rows{times, values, step, goes_on};
  if (shape == RecordFilter::kMovingAverage) return Averaged(rows, time);
  const Decay decay(shape, time);
  return shape == RecordFilter::kTwoPass ? ToAndFro(rows, decay) : LookingBack(rows, decay);
}

double ReachOf(RecordFilter shape, double time) {
  if (shape == RecordFilter::kMovingAverage) return 0.5 * time;
  return kDecayed * Decay(shape, time).unit;
}

}  // namespace hoplab
