#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace hoplab {
namespace internal {

/// Threads that may begin beside those at work, of the outermost ParallelFor's jobs; null outside.
inline thread_local std::atomic<int>* spare_threads = nullptr;

/// At most `most` of the spare ones.
inline int TakeThreads(std::atomic<int>& spare, int most) {
  int left = spare.load(), taken = 0;
  do {
    taken = std::clamp(left, 0, most);
  } while (taken > 0 && !spare.compare_exchange_weak(left, left - taken));
  return taken;
}

}  // namespace internal

/// Calls body(i) for i = 0 .. count - 1 on up to `jobs` threads. Each i must write only its own
/// results, so that the outcome does not depend on `jobs`. A body may call ParallelFor in turn: it
/// gets the threads that the outermost one's `jobs` leave over, at the end of a loop as well. The
/// first exception is rethrown after all threads have stopped.
template <class Body>
void ParallelFor(int count, int jobs, const Body& body) {
  std::atomic<int> own{jobs - 1};
  std::atomic<int>* const outer = internal::spare_threads;
  std::atomic<int>& spare = outer ? *outer : own;
  const int more = count > 1 && jobs > 1 ? internal::TakeThreads(spare, count - 1) : 0;
  if (more == 0) {
    for (int i = 0; i < count; ++i) body(i);
    return;
  }
  std::atomic<int> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    internal::spare_threads = &spare;
    for (int i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
    internal::spare_threads = outer;
  };
  {
    std::vector<std::jthread> pool;
    for (int t = 0; t < more; ++t)
      pool.emplace_back([&] {
        work();
        ++spare;
      });
    work();
    if (!outer) ++spare;  // this one only waits now
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace hoplab
