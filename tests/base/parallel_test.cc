#include "base/parallel.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>

namespace hoplab {
namespace {

void Pause() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

// How many are inside at once, and the most there were.
struct Crowd {
  std::atomic<int> now{0}, most{0};
  void Enter() {
    const int here = ++now;
    for (int was = most; here > was && !most.compare_exchange_weak(was, here);) {
    }
    Pause();
    --now;
  }
};

TEST(ParallelFor, DoesEachOnceWhateverTheNumberOfJobs) {
  for (const int jobs : {0, 1, 3, 50}) {
    std::vector<int> done(20, 0);
    ParallelFor(20, jobs, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
    EXPECT_EQ(done, std::vector<int>(20, 1)) << jobs;
  }
}

TEST(ParallelFor, LoopsInsideLoopsKeepToTheJobsOfTheOutermost) {
  Crowd crowd;
  std::atomic<int> done{0};
  ParallelFor(5, 3, [&](int) {
    ParallelFor(4, 8, [&](int) {
      crowd.Enter();
      ++done;
    });
  });
  EXPECT_EQ(done, 20);
  EXPECT_LE(crowd.most, 3);
  EXPECT_GE(crowd.most, 2);
}

// The last item of a loop has the threads that the others are done with.
TEST(ParallelFor, ALoopInTheLastItemGetsTheThreadsThatAreLeft) {
  Crowd last;
  ParallelFor(3, 3, [&](int i) {
    if (i < 2) return;
    for (int round = 0; round < 20; ++round) ParallelFor(6, 3, [&](int) { last.Enter(); });
  });
  EXPECT_EQ(last.most, 3);
  // So has one that is alone.
  Crowd alone;
  ParallelFor(1, 3, [&](int) { ParallelFor(60, 3, [&](int) { alone.Enter(); }); });
  EXPECT_EQ(alone.most, 3);
}

TEST(ParallelFor, ThrowsWhatABodyInsideThrewAndGoesOnWorking) {
  const auto fails = [] {
    ParallelFor(4, 2, [](int i) {
      ParallelFor(4, 2, [&](int k) {
        if (i == 2 && k == 3) throw std::runtime_error("inside");
        Pause();
      });
    });
  };
  EXPECT_THROW(fails(), std::runtime_error);
  Crowd after;
  ParallelFor(8, 2, [&](int) { after.Enter(); });
  EXPECT_EQ(after.most, 2);
}

}  // namespace
}  // namespace hoplab
