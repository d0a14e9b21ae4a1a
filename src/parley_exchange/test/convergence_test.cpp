// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "team.h"

namespace parley {
namespace {

/// Robots that each publish a few walls, some of which change or go on the way.
class Convergence : public testing::Test {
 protected:
  void start(std::size_t count, std::uint64_t seed) {
    team = Team(seed);
    for (std::size_t i = 0; i < count; ++i) {
      team.add(0.7 * static_cast<double>(i));
      drive(i);
    }
  }
  void drive(std::size_t i) { team[i].setOdometry(standing({}, team.timeOf(i)), DriveState::kStopped); }
  void publish(std::size_t i, int phase) {
    std::vector<OwnContour> walls;
    for (int k = phase; k < 6 + phase; ++k) walls.push_back(wall(k, 1.0, 0.5 * k, 2.0 + (k % 2) * phase));
    team[i].publishContours(walls, team.timeOf(i));
  }
  /// All robots hold the same of every origin.
  bool agree() {
    for (std::size_t of = 0; of < team.members.size(); ++of) {
      const auto truth = team[of].contoursOf(team[of].id());
      for (std::size_t by = 0; by < team.members.size(); ++by) {
        const auto held = team[by].contoursOf(team[of].id());
        if (held.size() != truth.size() || team[by].anchorsOf(team[of].id()).size() != 1) return false;
        for (std::size_t k = 0; k < held.size(); ++k) {
          if (!(held[k].name == truth[k].name) || held[k].polygon != truth[k].polygon) return false;
        }
      }
    }
    return true;
  }
  double secondsUntilAgreed(double limit) {
    const double begin = team.now;
    while (team.now - begin < limit && !agree()) {
      team.run(1.0, [this](std::size_t i) { drive(i); });
    }
    return team.now - begin;
  }

  Team team;
};

}  // namespace

TEST_F(Convergence, everyRecordReachesEveryRobotAtNinetyPercentLoss) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    start(5, seed);
    team.connectAll();
    team.loss = 0.9;
    for (std::size_t i = 0; i < 5; ++i) publish(i, 0);
    team.run(10.0, [this](std::size_t i) { drive(i); });
    for (std::size_t i = 0; i < 5; ++i) publish(i, 1);
    team.run(3.0);
    for (std::size_t i = 0; i < 5; ++i) publish(i, 1);
    EXPECT_LT(secondsUntilAgreed(400.0), 400.0) << "seed " << seed;
  }
}

TEST_F(Convergence, alongAChainWithHeavyLoss) {
  start(5, 11);
  for (std::size_t i = 0; i + 1 < 5; ++i) team.connect(i, i + 1);
  team.loss = 0.7;
  for (std::size_t i = 0; i < 5; ++i) publish(i, 0);
  EXPECT_LT(secondsUntilAgreed(300.0), 300.0);
}

TEST_F(Convergence, afterTheTeamWasSplit) {
  start(6, 12);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < i; ++j) team.connect(i, j);
    for (std::size_t j = 0; j < i; ++j) team.connect(i + 3, j + 3);
  }
  team.loss = 0.3;
  for (std::size_t i = 0; i < 6; ++i) publish(i, 0);
  team.run(20.0, [this](std::size_t i) { drive(i); });
  for (std::size_t i = 0; i < 6; ++i) publish(i, 1);
  team.run(5.0, [this](std::size_t i) { drive(i); });
  for (std::size_t i = 0; i < 6; ++i) publish(i, 1);
  EXPECT_FALSE(agree());
  team.connect(0, 5);
  EXPECT_LT(secondsUntilAgreed(120.0), 120.0);
}

TEST_F(Convergence, aLateComerGetsAWholeMapInAMinuteAtEightyPercentLoss) {
  start(2, 13);
  std::vector<OwnContour> walls;
  for (int k = 0; k < 150; ++k) walls.push_back(wall(k, 1.0 + 0.05 * (k % 7), 0.1 * k - 7.0, 2.0));
  team[0].publishContours(walls, team.timeOf(0));
  publish(1, 0);
  team.connectAll();
  team.loss = 0.8;
  EXPECT_LT(secondsUntilAgreed(60.0), 60.0);
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
