#include "app/terminal/progress.h"

#include <ostream>

namespace hoplab {
namespace {
constexpr std::chrono::milliseconds kLivePause{100};
constexpr std::chrono::milliseconds kPlainPause{5000};
// A line that wraps could not be written over.
constexpr std::size_t kMargin = 1;
}  // namespace

Progress::Progress(const Console& console, bool silent) : console_(console), silent_(silent) {}

Progress::~Progress() { Clear(); }

void Progress::Stage(const std::string& text, long done) {
  stage_begin_ = Clock::now();
  pace_ = Pace(done);
  if (!silent_) Show(text);
}

void Progress::Step(const std::string& text) {
  if (!IsDue()) return;
  const Pace::Seconds elapsed = Clock::now() - stage_begin_;
  Show(elapsed.count() < 1.0 ? text : text + ", " + DurationText(elapsed) + " so far");
}

void Progress::Step(const std::string& text, long done, long total) {
  if (!IsDue()) return;
  const std::string pace = pace_.Text(done, total, Clock::now() - stage_begin_);
  Show(pace.empty() ? text : text + ", " + pace);
}

void Progress::Clear() {
  if (line_shown_) console_.err << "\r\033[K" << std::flush;
  line_shown_ = false;
}

bool Progress::IsDue() const {
  return !silent_ && Clock::now() - last_ >= (console_.err_live ? kLivePause : kPlainPause);
}

void Progress::Show(const std::string& text) {
  last_ = Clock::now();
  if (console_.err_live) {
    console_.err << "\r\033[K" << text.substr(0, console_.err_columns - kMargin) << std::flush;
    line_shown_ = true;
  } else {
    console_.err << text << std::endl;
  }
}

}  // namespace hoplab
