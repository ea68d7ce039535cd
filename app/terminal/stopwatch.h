#pragma once

#include <chrono>

namespace hoplab {

/// Wall-clock time since it was made, for `seconds` of run.json.
class Stopwatch {
 public:
  double Seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace hoplab
