#pragma once

#include <functional>
#include <string>
#include <vector>

namespace hoplab::bench {

/// Times of one thing [s per call].
struct Timing {
  std::vector<double> seconds;
  double Min() const;     // NaN without any
  double Median() const;  // NaN without any
};

/// Times several things in turn, round after round, so that what else the machine does meets all of
/// them alike.
class RoundRobin {
 public:
  /// `body` is called as often as fills about `batch_s` [s]; its mean is one entry of a Timing.
  explicit RoundRobin(double batch_s) : batch_s_(batch_s) {}

  /// Adds a thing to time; returns its number. Calls it once.
  int Add(std::string name, std::function<void()> body);
  /// One more batch of everything.
  void Round();

  int count() const { return static_cast<int>(things_.size()); }
  const std::string& name(int i) const { return things_[i].name; }
  const Timing& timing(int i) const { return things_[i].timing; }

 private:
  struct Thing {
    std::string name;
    std::function<void()> body;
    long calls;
    Timing timing;
  };
  double batch_s_;
  std::vector<Thing> things_;
};

}  // namespace hoplab::bench
