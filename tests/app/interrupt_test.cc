// One signal that comes twice, as `timeout` sends it, and a second one.
#include "app/terminal/interrupt.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace hoplab {
namespace {

TEST(Interrupt, OneSignalThatComesTwiceSetsTheFlag) {
  const InterruptGuard guard;
  EXPECT_FALSE(guard.interrupted());
  std::raise(SIGTERM);
  std::raise(SIGTERM);
  EXPECT_TRUE(guard.interrupted());
}

TEST(Interrupt, ASecondOneEndsTheProcess) {
  EXPECT_EXIT(
      {
        const InterruptGuard guard;
        std::raise(SIGINT);
        std::this_thread::sleep_for(std::chrono::milliseconds(700));
        std::raise(SIGINT);
        std::exit(0);
      },
      ::testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace hoplab
