#include "app/terminal/interrupt.h"

#include <time.h>

#include <csignal>
#include <cstdint>

namespace hoplab {
namespace {

// A signal handler reaches globals only.
std::atomic<bool> stop_flag{false};
std::atomic<std::int64_t> stopped_at{0};  // ms; 0: not yet
static_assert(std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

// `timeout` and batch systems send to the process and to its group, which are two signals for one.
constexpr std::int64_t kSameSignal = 500;  // ms

// What a signal handler may call.
std::int64_t Now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1000 * static_cast<std::int64_t>(now.tv_sec) + now.tv_nsec / 1000000;
}

extern "C" void OnSignal(int signal) {
  std::int64_t first = 0;
  if (stopped_at.compare_exchange_strong(first, Now())) {
    stop_flag = true;
  } else if (Now() - first > kSameSignal) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

InterruptGuard::InterruptGuard() {
  stop_flag = false;
  stopped_at = 0;
  std::signal(SIGINT, OnSignal);
  std::signal(SIGTERM, OnSignal);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

const std::atomic<bool>* InterruptGuard::flag() const { return &stop_flag; }

}  // namespace hoplab
