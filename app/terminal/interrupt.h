#pragma once

#include <atomic>

namespace hoplab {

/// While it lives, the first Ctrl-C (SIGINT) or SIGTERM sets a flag instead of ending the process,
/// so that what was finished can be kept. One within half a second after it is taken for the same,
/// a later one ends the process at once. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard();

  const std::atomic<bool>* flag() const;
  bool interrupted() const { return *flag(); }
};

}  // namespace hoplab
