#pragma once

#include <chrono>
#include <string>

#include "app/terminal/console.h"
#include "app/terminal/pace.h"

namespace hoplab {

/// Says on standard error how far a long command is: one line written over on a terminal, a plain
/// line now and then elsewhere, nothing if silenced. Not for several threads at a time.
class Progress {
 public:
  Progress(const Console& console, bool silent);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// A new stage: always shown. `done` of its countable work stand already.
  void Stage(const std::string& text, long done = 0);
  /// How far the stage is, with the time it has taken: shown at most ten times a second on a
  /// terminal, every five seconds else.
  void Step(const std::string& text);
  /// The same where the end is known: with the rate and the time left.
  void Step(const std::string& text, long done, long total);
  /// Takes the live line away, before something else is written.
  void Clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool IsDue() const;
  void Show(const std::string& text);

  const Console& console_;
  bool silent_;
  bool line_shown_ = false;
  Clock::time_point last_ = {}, stage_begin_ = Clock::now();
  Pace pace_{0};
};

}  // namespace hoplab
