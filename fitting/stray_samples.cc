#include "fitting/stray_samples.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hoplab {
namespace {

constexpr std::size_t kBeside = 6;    // samples on a side that say how the body moves
constexpr std::size_t kFewest = 8;    // on both, near an end of the trace
constexpr std::size_t kJumpSide = 4;  // likewise, on either side of a jump
constexpr std::size_t kLongest = 10;  // stray samples in a row
constexpr std::size_t kRemnant = 3;   // samples between a gap and an end of the trace
constexpr double kStray = 6.0, kJump = 10.0, kSmooth = 2.0, kOneSide = 4.0;  // noise's deviations
constexpr double kBack = 3.0;     // likewise, of one that the motion leads to
constexpr double kRough = 0.08;   // of a trace's samples, those that may be off the motion before
constexpr double kEdge = 0.5;     // of a distance, what has to come about within one sample
constexpr double kWayBack = 0.1;  // of a jump, by which the way back may differ
constexpr double kGap = 4.0;      // median steps

// A parabola through a few samples, with a step at one of them or without.
class LocalMotion {
 public:
  // `step`: place in `at` from which on the step counts; 0: none.
  LocalMotion(const Samples& samples, const std::vector<std::size_t>& at, std::size_t step = 0)
      : middle_(samples.t[at[at.size() / 2]]),
        width_(samples.t[at.back()] - samples.t[at.front()]) {
    const Eigen::Index n = static_cast<Eigen::Index>(at.size()), k = step > 0 ? 4 : 3;
    Matrix A(n, k);
    Vector y(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      A.row(i).head(3) = Powers(samples.t[at[i]]);
      if (step > 0) A(i, 3) = i >= static_cast<Eigen::Index>(step) ? 1.0 : 0.0;
      y[i] = samples.y[at[i]];
    }
    const Eigen::HouseholderQR<Matrix> qr(A);
    motion_ = qr.solve(y);
    spread_ = n > k ? (y - A * motion_).norm() / std::sqrt(static_cast<double>(n - k)) : 0.0;
    cofactors_ = (A.transpose() * A).inverse();
  }
  double spread() const { return spread_; }
  double At(double t) const { return Powers(t).dot(motion_.head(3)); }
  // Of a sample's distance from it, over that of a sample.
  double Doubt(double t) const {
    const Eigen::RowVector3d powers = Powers(t);
    return std::sqrt(1.0 + powers.dot(cofactors_.topLeftCorner(3, 3) * powers.transpose()));
  }
  double step() const { return motion_[3]; }
  double StepDoubt() const { return std::sqrt(cofactors_(3, 3)); }

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * kBeside, 4>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2 * kBeside, 1>;
  Eigen::RowVector3d Powers(double t) const {
    const double u = (t - middle_) / width_;
    return {1.0, u, u * u};
  }

  double middle_, width_, spread_ = 0.0;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1> motion_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4> cofactors_;
};

class Column {
 public:
  Column(const Samples& samples, double sigma, double least, double blow)
      : s_(samples), sigma_(sigma), least_(least), blow_(blow), stray_(s_.size(), false) {}

  // Whether the samples are so close that few of them are off the motion before.
  bool IsSmooth() const {
    std::size_t off = 0, all = 0;
    for (std::size_t i = kBeside; i < s_.size(); ++i, ++all)
      if (IsOff(i, Before(i, kBeside), 0.0) && IsOffWithoutTwo(i)) ++off;
    return static_cast<double>(off) < kRough * static_cast<double>(all);
  }

  // Stray ones are seen once those beside them are known, too.
  void FindStray() {
    SetRemnants();
    for (int pass = 0; pass < 3; ++pass) {
      bool found = false;
      FindEdges();
      for (std::size_t count = 1; count <= kLongest; ++count)
        for (std::size_t first = 1; first + count < s_.size(); ++first)
          found |= AreStray(first, count);
      for (std::size_t i = 1; i + 1 < s_.size(); ++i) found |= IsStrayWhereMotionLeadsOn(i);
      if (!found) break;
    }
    SetOutermost();
  }

  // Where the motion comes back by what it went, it was elsewhere for a while: stray.
  void FindJumps() {
    std::vector<Jump> jumps;
    for (std::size_t i = 1; i < s_.size(); ++i) {
      if (stray_[i] || stray_[i - 1] || s_.t[i] - s_.t[i - 1] > kGap * s_.step) continue;
      std::vector<std::size_t> before = Before(i, kJumpSide), after = After(i - 1, kJumpSide);
      if (before.size() < kJumpSide || after.size() < kJumpSide) continue;
      const double bound = kJump * sigma_;
      if (!IsOff(i, before, kEdge * bound) || !IsOff(i - 1, after, kEdge * bound)) continue;
      std::vector<std::size_t> at(before.rbegin(), before.rend());
      at.insert(at.end(), after.begin(), after.end());
      const LocalMotion motion(s_, at, kJumpSide);
      const double size = std::abs(motion.step());
      if (motion.spread() > kSmooth * sigma_ || size < bound * motion.StepDoubt() ||
          size < least_ || !IsOff(i, Before(i, kBeside), kEdge * size) ||
          !IsOff(i - 1, After(i - 1, kBeside), kEdge * size))
        continue;
      jumps.push_back({s_.row[i], motion.step()});
    }
    for (std::size_t k = 0; k < jumps.size(); ++k) {
      if (k + 1 < jumps.size() && IsWayBack(jumps[k].size, jumps[k + 1].size)) {
        for (std::size_t i = 0; i < s_.size(); ++i)
          if (s_.row[i] >= jumps[k].row && s_.row[i] < jumps[k + 1].row) SetStray(i, i, 0.0);
        found_.largest_stray = std::max(found_.largest_stray, std::abs(jumps[k].size));
        ++k;
      } else {
        found_.jumps.push_back(jumps[k].row);
        found_.largest_jump = std::max(found_.largest_jump, std::abs(jumps[k].size));
      }
    }
  }

  OffMotion Found() const {
    OffMotion found = found_;
    for (std::size_t i = 0; i < s_.size(); ++i)
      if (stray_[i]) found.stray.push_back(s_.row[i]);
    return found;
  }

 private:
  struct Jump {
    std::size_t row;
    double size;
  };
  bool IsWayBack(double there, double back) const {
    return std::abs(there + back) <
           std::max(kJump * sigma_, kWayBack * std::min(std::abs(there), std::abs(back)));
  }

  // `count` neighbours of a place that are not stray, going away from it.
  std::vector<std::size_t> Before(std::size_t i, std::size_t count) const {
    std::vector<std::size_t> at;
    while (i-- > 0 && at.size() < count)
      if (!stray_[i]) at.push_back(i);
    return at;
  }
  std::vector<std::size_t> After(std::size_t i, std::size_t count) const {
    std::vector<std::size_t> at;
    while (++i < s_.size() && at.size() < count)
      if (!stray_[i]) at.push_back(i);
    return at;
  }

  // Whether the sample at place i, the next one, lies off the motion on that side by `least` or
  // more; too few samples tell no motion.
  bool IsOff(std::size_t i, std::vector<std::size_t> side, double least) const {
    if (side.size() < kJumpSide) return false;
    std::sort(side.begin(), side.end());
    const LocalMotion motion = MotionThrough(side);
    const double here = std::abs(s_.y[i] - motion.At(s_.t[i]));
    return here >= least && here >= kOneSide * sigma_ * motion.Doubt(s_.t[i]);
  }

  // Whether it is off the motion before it, of which the two worst samples are left out.
  bool IsOffWithoutTwo(std::size_t i) const {
    std::vector<std::size_t> side = Before(i, kBeside);
    std::sort(side.begin(), side.end());
    double least = std::numeric_limits<double>::infinity();
    bool off = true;
    for (std::size_t a = 0; a < side.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        std::vector<std::size_t> others = side;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(a));
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(b));
        const LocalMotion motion(s_, others);
        if (motion.spread() >= least) continue;
        least = motion.spread();
        off = std::abs(s_.y[i] - motion.At(s_.t[i])) >= kOneSide * sigma_ * motion.Doubt(s_.t[i]);
      }
    }
    return off;
  }

  // Where strays may begin and end: what is not off the motion on that side is no stray's edge.
  // Beside one that is stray already it has come about; near an end of the trace it is not asked.
  bool Begins(std::size_t i, double off) const {
    return i < kJumpSide || stray_[i - 1] || IsOff(i, Before(i, kBeside), kEdge * off);
  }
  bool Ends(std::size_t i, double off) const {
    return i + kJumpSide >= s_.size() || stray_[i + 1] || IsOff(i, After(i, kBeside), kEdge * off);
  }
  void FindEdges() {
    begins_.assign(s_.size(), false);
    ends_.assign(s_.size(), false);
    for (std::size_t i = 1; i + 1 < s_.size(); ++i) {
      begins_[i] = Begins(i, kStray * sigma_);
      ends_[i] = Ends(i, kStray * sigma_);
    }
  }

  bool AreStray(std::size_t first, std::size_t count) {
    const std::size_t last = first + count - 1;
    if (!begins_[first] || !ends_[last]) return false;
    for (std::size_t i = first; i <= last; ++i)
      if (stray_[i]) return false;
    const std::vector<std::size_t> before = Before(first, kBeside), after = After(last, kBeside);
    const bool near_end = std::min(before.size(), after.size()) < kBeside;
    if (before.empty() || after.empty() || before.size() + after.size() < kFewest ||
        (near_end && count > 1) ||
        s_.t[after.back()] - s_.t[before.back()] >
            kGap * static_cast<double>(after.back() - before.back()) * s_.step)
      return false;
    std::vector<std::size_t> at(before.rbegin(), before.rend());
    at.insert(at.end(), after.begin(), after.end());
    const LocalMotion motion = MotionThrough(at);
    double largest = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
      const double off = std::abs(s_.y[i] - motion.At(s_.t[i]));
      if (!IsFar(i, off, motion) || (i == first && !Begins(i, off)) || (i == last && !Ends(i, off)))
        return false;
      largest = std::max(largest, off);
    }
    SetStray(first, last, largest);
    return true;
  }

  // A few samples between a gap and an end of the trace that lie elsewhere than the motion leads.
  void SetRemnants() {
    const std::size_t n = s_.size();
    for (std::size_t count = 1; count <= kRemnant && count + kBeside <= n; ++count) {
      if (s_.t[n - count] - s_.t[n - count - 1] > kGap * s_.step)
        SetIfFar(n - count, n - 1, Before(n - count, kBeside));
      if (s_.t[count] - s_.t[count - 1] > kGap * s_.step)
        SetIfFar(0, count - 1, After(count - 1, kBeside));
    }
  }
  // The outermost ones, where the motion beside them does not lead there and no blow could.
  void SetOutermost() {
    const std::size_t n = s_.size();
    if (n < 2 * kBeside + 1) return;
    double fastest = 0.0;
    for (std::size_t i = 1; i + kJumpSide + 1 < n; i += kJumpSide)
      if (!stray_[i] && !stray_[i + kJumpSide])
        fastest = std::max(
            fastest, std::abs(s_.y[i + kJumpSide] - s_.y[i]) / (s_.t[i + kJumpSide] - s_.t[i]));
    SetIfOutside(0, After(0, kBeside), fastest);
    SetIfOutside(n - 1, Before(n - 1, kBeside), fastest);
  }
  void SetIfOutside(std::size_t i, std::vector<std::size_t> at, double fastest) {
    if (stray_[i] || at.size() < kBeside) return;
    const double thrown = blow_ * fastest * std::abs(s_.t[i] - s_.t[at.front()]);
    std::sort(at.begin(), at.end());
    const LocalMotion motion(s_, at);  // all of them: one that is left out may follow the blow
    const double off = std::abs(s_.y[i] - motion.At(s_.t[i]));
    if (IsFar(i, off - thrown, motion)) SetStray(i, i, off);
  }
  // A sample off the motion on one side of it, where that motion leads on to the next one: a blow
  // goes on.
  bool IsStrayWhereMotionLeadsOn(std::size_t i) {
    if (stray_[i]) return false;
    const std::vector<std::size_t> before = Before(i, kBeside), after = After(i, kBeside);
    if (before.size() == kBeside && LeadsTo(i + 1, before)) SetIfFar(i, i, before);
    if (!stray_[i] && after.size() == kBeside && LeadsTo(i - 1, after)) SetIfFar(i, i, after);
    return stray_[i];
  }
  bool LeadsTo(std::size_t i, std::vector<std::size_t> side) const {
    std::sort(side.begin(), side.end());
    const LocalMotion motion = MotionThrough(side);
    return std::abs(s_.y[i] - motion.At(s_.t[i])) < kBack * sigma_ * motion.Doubt(s_.t[i]);
  }
  void SetIfFar(std::size_t first, std::size_t last, std::vector<std::size_t> at) {
    std::sort(at.begin(), at.end());
    const LocalMotion motion = MotionThrough(at);
    double largest = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
      const double off = std::abs(s_.y[i] - motion.At(s_.t[i]));
      if (!IsFar(i, off, motion)) return;
      largest = std::max(largest, off);
    }
    SetStray(first, last, largest);
  }

  bool IsFar(std::size_t i, double off, const LocalMotion& motion) const {
    return motion.spread() <= kSmooth * sigma_ && off > least_ &&
           off > kStray * sigma_ * motion.Doubt(s_.t[i]);
  }
  void SetStray(std::size_t first, std::size_t last, double off) {
    for (std::size_t i = first; i <= last; ++i) stray_[i] = true;
    found_.largest_stray = std::max(found_.largest_stray, off);
  }
  // Through all, or without the one that is worst, which may be stray, too.
  LocalMotion MotionThrough(const std::vector<std::size_t>& at) const {
    LocalMotion best(s_, at);
    if (best.spread() <= kSmooth * sigma_ || at.size() <= kJumpSide) return best;
    for (std::size_t out = 0; out < at.size(); ++out) {
      std::vector<std::size_t> others = at;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(out));
      const LocalMotion motion(s_, others);
      if (motion.spread() < best.spread()) best = motion;
    }
    return best;
  }

  const Samples& s_;
  double sigma_, least_, blow_;
  std::vector<bool> stray_, begins_, ends_;
  OffMotion found_;  // but for the stray rows
};

}  // namespace

Samples Samples::From(std::size_t first) const {
  std::vector<bool> left_out(size(), false);
  std::fill_n(left_out.begin(), first, true);
  return Without(left_out);
}

Samples Samples::Without(const std::vector<bool>& left_out) const {
  Samples rest;
  rest.step = step;
  for (std::size_t i = 0; i < size(); ++i) {
    if (left_out[i]) continue;
    rest.t.push_back(t[i]);
    rest.y.push_back(y[i]);
    rest.row.push_back(row[i]);
  }
  return rest;
}

OffMotion FindOffMotion(const Samples& samples, double sigma, double least, double blow) {
  Column column(samples, sigma, least, blow);
  if (!column.IsSmooth()) return {};
  column.FindStray();
  column.FindJumps();
  return column.Found();
}

}  // namespace hoplab
