#pragma once

#include <chrono>
#include <string>

#include "app/console.h"

namespace hoplab {

/// Says on standard error how far a long command is: one line written over on a terminal, a plain
/// line now and then elsewhere, nothing if silenced. Not for several threads at a time.
class Progress {
 public:
  Progress(const Console& console, bool silent);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// A new stage: always shown.
  void Stage(const std::string& text);
  /// How far the stage is: shown at most ten times a second on a terminal, every five seconds else.
  void Step(const std::string& text);
  /// Takes the live line away, before something else is written.
  void Clear();

 private:
  using Clock = std::chrono::steady_clock;
  void Show(const std::string& text);

  const Console& console_;
  bool silent_;
  bool line_shown_ = false;
  Clock::time_point last_ = {};
};

}  // namespace hoplab
