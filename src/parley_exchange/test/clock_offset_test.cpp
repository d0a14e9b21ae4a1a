// SPDX-License-Identifier: BSD-3-Clause
#include "clock_offset.h"

#include <gtest/gtest.h>

#include <cmath>

#include "random_content.h"

namespace parley {
namespace {

/// Two clocks that tell each other stamps over a radio with delay, jitter and loss.
struct Pair {
  double offset = 1234.5;  // [s] b's clock minus a's
  double drift = 0.0;      // [s/s] of b's clock
  double least = 0.01;     // [s]
  double jitter = 0.02;    // [s]
  double loss = 0.0;       // [-]
  RandomContent random{1};
  ClockOffset a, b;
  double now = 1e6;  // [s] a's clock
  double begin = now;

  double timeOfB(double time) const { return time + offset + drift * (time - begin); }

  void run(double duration) {
    for (const double end = now + duration; now < end; now += 0.25) {
      if (!random.chance(loss)) {
        const double arrival = now + least + jitter * random.real(0.0, 1.0);
        b.heard(ticksOf(now), timeOfB(arrival));
        if (a.difference()) b.echoed(*a.difference(), timeOfB(arrival));
      }
      if (!random.chance(loss)) {
        const double arrival = now + least + jitter * random.real(0.0, 1.0);
        a.heard(ticksOf(timeOfB(now)), arrival);
        if (b.difference()) a.echoed(*b.difference(), arrival);
      }
    }
  }
  double error() const { return std::abs(a.ownTime(ticksOf(timeOfB(now - 1.0)), now) - (now - 1.0)); }
};

}  // namespace

TEST(ClockOffset, isWithinItsBoundAndTwentyMilliseconds) {
  for (const double loss : {0.0, 0.5, 0.8}) {
    for (const double offset : {0.0, -0.3, 1234.5, -5e5, 1.7e9}) {
      Pair pair;
      pair.loss = loss;
      pair.offset = offset;
      pair.drift = 50e-6;
      pair.run(60.0);
      EXPECT_TRUE(pair.a.known(pair.now));
      EXPECT_LT(pair.error(), 0.006) << loss << " " << offset;
      EXPECT_LE(pair.error(), pair.a.error(pair.now)) << loss << " " << offset;
    }
  }
}

TEST(ClockOffset, oneDirectionAloneIsOffByTheDelay) {
  ClockOffset clock;
  EXPECT_FALSE(clock.difference());
  EXPECT_EQ(clock.ownTime(5, 7.0), 7.0);
  clock.heard(ticksOf(500.0), 10.02);
  EXPECT_FALSE(clock.known(10.0));
  EXPECT_NEAR(clock.ownTime(ticksOf(500.0), 10.1), 10.0, 0.02);
  EXPECT_GT(clock.error(10.0), 0.05);
}

TEST(ClockOffset, anEchoThatCannotBeIsIgnored) {
  ClockOffset clock;
  clock.heard(ticksOf(500.0), 10.0);
  clock.echoed(12345, 10.0);
  EXPECT_FALSE(clock.known(10.0));
}

TEST(ClockOffset, aClockThatWasSetIsLearntAnew) {
  Pair pair;
  pair.run(20.0);
  pair.offset += 100.0;
  pair.run(20.0);
  EXPECT_TRUE(pair.a.known(pair.now));
  EXPECT_LT(pair.error(), 0.01);
  EXPECT_FALSE(pair.a.known(pair.now + 100.0)) << "echoes age";
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
