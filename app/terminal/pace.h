#pragma once

#include <chrono>
#include <string>

namespace hoplab {

/// How fast counted work goes on: the mean rate since it began.
class Pace {
 public:
  using Seconds = std::chrono::duration<double>;

  /// `done` of the work stand already, as of a run that is resumed.
  explicit Pace(long done) : begun_with_(done) {}

  /// "4.2/s, 1 min 20 s left", "3.1/min, 2 h 5 min left" when `done` of `total` are done `elapsed`
  /// after the beginning; empty while nothing is known or nothing is left.
  std::string Text(long done, long total, Seconds elapsed) const;

 private:
  long begun_with_;
};

/// "45 s", "1 min 20 s", "2 h 5 min".
std::string DurationText(Pace::Seconds duration);

}  // namespace hoplab
