#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace hoplab {

/// Calls body(i) for i = 0 .. count - 1 on up to `jobs` threads. Each i must write only its own
/// results, so that the outcome does not depend on `jobs`. The first exception is rethrown after
/// all threads have stopped.
template <class Body>
void ParallelFor(int count, int jobs, const Body& body) {
  const int threads = std::min(std::max(jobs, 1), count);
  if (threads <= 1) {
    for (int i = 0; i < count; ++i) body(i);
    return;
  }
  std::atomic<int> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> pool;
    for (int t = 1; t < threads; ++t) pool.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace hoplab
