#include "tools/output/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>

namespace talus::interrupt_test {
namespace {

// A run of a sweep is a process that was forked while the sweep had one.
TEST(Interrupt, ThatArrivedBeforeARunHadItsOwnEndsThisRunToo) {
  const Interrupt of_the_sweep;
  std::raise(SIGTERM);
  const Interrupt of_the_run;
  EXPECT_TRUE(of_the_run.requested());
}

TEST(Interrupt, IsForgottenAtTheEndOfWhatItEnded) {
  {
    const Interrupt first;
    std::raise(SIGTERM);
    ASSERT_TRUE(first.requested());
  }
  const Interrupt second;
  EXPECT_FALSE(second.requested());
}

}  // namespace
}  // namespace talus::interrupt_test
