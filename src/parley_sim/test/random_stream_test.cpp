// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/random_stream.h"

#include <gtest/gtest.h>

#include <cmath>

namespace parley::sim {
namespace {

TEST(RandomStreamTest, sameNamesGiveTheSameNumbersAndOthersDoNot) {
  RandomStream first(1, "robot_1", "lidar"), again(1, "robot_1", "lidar");
  RandomStream seed(2, "robot_1", "lidar"), name(1, "robot_2", "lidar"), purpose(1, "robot_1", "radio");
  RandomStream shifted(1, "robot_1l", "idar");
  for (int i = 0; i < 100; ++i) {
    const double value = first.uniform();
    EXPECT_EQ(value, again.uniform());
    EXPECT_NE(value, seed.uniform());
    EXPECT_NE(value, name.uniform());
    EXPECT_NE(value, purpose.uniform());
    EXPECT_NE(value, shifted.uniform());
  }
}

TEST(RandomStreamTest, momentsAreThoseOfTheDistributions) {
  RandomStream stream(5, "a", "b");
  const int count = 200000;
  double sum = 0.0, squares = 0.0, fourth = 0.0, uniform = 0.0;
  for (int i = 0; i < count; ++i) {
    const double value = stream.normal();
    sum += value;
    squares += value * value;
    fourth += value * value * value * value;
    const double flat = stream.uniform(2.0, 4.0);
    ASSERT_GE(flat, 2.0);
    ASSERT_LT(flat, 4.0);
    uniform += flat;
  }
  EXPECT_NEAR(sum / count, 0.0, 0.01);
  EXPECT_NEAR(squares / count, 1.0, 0.02);
  EXPECT_NEAR(fourth / count, 3.0, 0.1);
  EXPECT_NEAR(uniform / count, 3.0, 0.01);
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
