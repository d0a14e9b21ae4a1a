// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/localization_judge.h"

#include <gtest/gtest.h>

namespace parley::sim {
namespace {

/// Two robots whose odometries have drifted, each with a belief about the other that is off by a given pose.
class Pair {
 public:
  Pair() : judge_({"a", "b"}) {}
  void observe(double time, const Pose2& off_a, bool a_confirmed, bool b_confirmed) {
    const Pose2 T_world_odom_a = truth_a * odometry_a.inverse(), T_world_odom_b = truth_b * odometry_b.inverse();
    beliefs_a_.clear();
    beliefs_b_.clear();
    if (a_confirmed) beliefs_a_.push_back({"b", off_a * (T_world_odom_a.inverse() * T_world_odom_b)});
    if (b_confirmed) beliefs_b_.push_back({"a", T_world_odom_b.inverse() * T_world_odom_a});
    judge_.observe(time, {BelievedState{truth_a, odometry_a, &beliefs_a_}, BelievedState{truth_b, odometry_b, &beliefs_b_}},
                   {{0, 1, 1.0, 6.0, {0.0, 0.0}}});
  }
  const LocalizationJudge& judge() const { return judge_; }

  Pose2 truth_a{1.0, 2.0, 0.3}, truth_b{4.0, 2.5, -2.0};
  Pose2 odometry_a{0.0, 0.0, 0.0}, odometry_b{-7.0, 3.0, 1.1};

 private:
  LocalizationJudge judge_;
  std::vector<PeerBelief> beliefs_a_, beliefs_b_;
};

}  // namespace

TEST(LocalizationJudge, aPerfectBeliefHasNoError) {
  Pair pair;
  pair.observe(2.0, {}, true, true);
  ASSERT_EQ(pair.judge().errors().size(), 2U);
  for (const PoseError& error : pair.judge().errors()) EXPECT_LT(error.translation + error.rotation, 1e-9);
  EXPECT_EQ(pair.judge().falsePairs(), 0);
  ASSERT_EQ(pair.judge().secondsToLocalize().size(), 1U);
  EXPECT_DOUBLE_EQ(pair.judge().secondsToLocalize()[0], 1.0);
}

TEST(LocalizationJudge, anErrorIsThatOfThePlaceAsSeen) {
  Pair pair;
  pair.observe(2.0, {0.1, 0.0, 0.0}, true, false);
  ASSERT_EQ(pair.judge().errors().size(), 1U);
  EXPECT_NEAR(pair.judge().errors()[0].translation, 0.1, 1e-9);
  EXPECT_TRUE(pair.judge().secondsToLocalize().empty());  // the other does not know
}

TEST(LocalizationJudge, whatGoesWrongLaterIsFalseToo) {
  Pair pair;
  pair.observe(2.0, {}, true, true);
  pair.observe(3.0, {0.0, 0.0, 0.1}, true, true);  // 5.7 degrees
  EXPECT_EQ(pair.judge().falsePairs(), 1);
  EXPECT_EQ(pair.judge().errors().size(), 2U);  // errors are those at confirmation
  pair.observe(4.0, {}, false, true);
  pair.observe(5.0, {0.2, 0.0, 0.0}, true, true);  // confirmed once more
  EXPECT_EQ(pair.judge().errors().size(), 3U);
  EXPECT_EQ(pair.judge().falsePairs(), 1);
}

TEST(LocalizationJudge, tooLateIsNotWithinTheEncounter) {
  Pair pair;
  pair.observe(7.0, {}, true, true);
  EXPECT_TRUE(pair.judge().secondsToLocalize().empty());
}

}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
