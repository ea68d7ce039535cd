#include "app/progress.h"

#include <ostream>

namespace hoplab {
namespace {
constexpr std::chrono::milliseconds kLivePause{100};
constexpr std::chrono::milliseconds kPlainPause{5000};
}  // namespace

Progress::Progress(const Console& console, bool silent) : console_(console), silent_(silent) {}

Progress::~Progress() { Clear(); }

void Progress::Stage(const std::string& text) {
  if (silent_) return;
  Show(text);
}

void Progress::Step(const std::string& text) {
  if (silent_) return;
  const auto pause = console_.err_live ? kLivePause : kPlainPause;
  if (Clock::now() - last_ >= pause) Show(text);
}

void Progress::Clear() {
  if (line_shown_) console_.err << "\r\033[K" << std::flush;
  line_shown_ = false;
}

void Progress::Show(const std::string& text) {
  last_ = Clock::now();
  if (console_.err_live) {
    console_.err << "\r\033[K" << text << std::flush;
    line_shown_ = true;
  } else {
    console_.err << text << std::endl;
  }
}

}  // namespace hoplab
