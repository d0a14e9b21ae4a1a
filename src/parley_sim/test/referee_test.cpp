// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/referee.h"

#include <gtest/gtest.h>

#include "parley_sim/random_stream.h"
#include "worlds.h"

namespace parley::sim {
namespace {

constexpr double kStep = 0.01;

struct Court {
  explicit Court(const std::vector<Pose2>& poses) : world(emptyWorld(20, 20)) {
    for (const Pose2& pose : poses) {
      scenario.robots.push_back(robotAt("robot_" + std::to_string(scenario.robots.size()), pose, {15, 15}));
      snapshot.bodies.push_back({true, {pose, {}}, 0.8, 0.4});
    }
    referee = std::make_unique<Referee>(scenario, world);
  }
  void judge(double seconds = kStep) {
    for (double t = 0.0; t < seconds - 1e-9; t += kStep) {
      snapshot.time += kStep;
      referee->judge(snapshot, std::vector<Pose2>(snapshot.bodies.size(), believed), kStep);
    }
  }
  Pose2& pose(std::size_t i) { return snapshot.bodies[i].state.pose; }

  World world;
  Scenario scenario;
  Snapshot snapshot;
  Pose2 believed;
  std::unique_ptr<Referee> referee;
};

TEST(RefereeTest, aContactCountsOnceUntilItEnds) {
  Court court({{5, 5, 0}, {8, 5, 0}});
  court.judge(1.0);
  EXPECT_TRUE(court.referee->incidents().empty());
  court.pose(0).x = 7.3;
  court.judge(2.0);
  EXPECT_EQ(court.referee->collisions(ContactKind::kRobot), 1);
  court.pose(0).x = 5.0;
  court.judge();
  court.pose(0).x = 7.3;
  court.judge();
  EXPECT_EQ(court.referee->collisions(ContactKind::kRobot), 2);
  EXPECT_EQ(court.referee->collisions(ContactKind::kStatic), 0);
  EXPECT_EQ(court.referee->records()[0].min_clearance, 0.0);
}

TEST(RefereeTest, bodiesThatRubAgainstEachOtherAreInOneContact) {
  Court court({{5, 5, 0}, {8, 5, 0}});
  for (int i = 0; i < 20; ++i) {
    court.pose(0).x = i % 2 == 0 ? 7.2001 : 7.1999;
    court.judge();
  }
  EXPECT_EQ(court.referee->collisions(ContactKind::kRobot), 1);
  for (int i = 0; i < 20; ++i) {
    court.pose(0) = {i % 2 == 0 ? 0.3999 : 0.4001, 5, 0};
    court.judge();
  }
  EXPECT_EQ(court.referee->collisions(ContactKind::kStatic), 1);
  court.pose(0).x = 10;
  for (int i = 0; i < 20; ++i) {
    court.snapshot.discs = {{{10.0, i % 2 == 0 ? 5.4999 : 5.5001}, 0.3}};
    court.judge();
  }
  EXPECT_EQ(court.referee->touched(), 1);
}

TEST(RefereeTest, wallsAndDoorsAreSolid) {
  Court court({{5, 5, 0}});
  court.pose(0) = {0.39, 5, 0};
  court.judge();
  EXPECT_EQ(court.referee->collisions(ContactKind::kStatic), 1);
  court.pose(0) = {5, 5, 0};
  court.snapshot.doors.push_back(boxOfSegment({5.3, 4}, {5.3, 6}, 0.1));
  court.judge();
  EXPECT_EQ(court.referee->collisions(ContactKind::kStatic), 1);  // a contact with something solid all along
  court.snapshot.doors.clear();
  court.judge();
  court.snapshot.doors.push_back(boxOfSegment({5.3, 4}, {5.3, 6}, 0.1));
  court.judge();
  EXPECT_EQ(court.referee->collisions(ContactKind::kStatic), 2);
  EXPECT_FALSE(court.referee->success());
}

TEST(RefereeTest, beingTouchedWhileStandingIsNoCollision) {
  for (const double speed : {0.0, 0.04, 0.06, -1.0}) {
    Court court({{5, 5, 0}});
    court.snapshot.bodies[0].state.twist.speed = speed;
    court.snapshot.discs.push_back({{5.5, 5.0}, 0.3});
    court.judge(0.5);
    const bool touched = std::abs(speed) < 0.05;
    EXPECT_EQ(court.referee->touched(), touched ? 1 : 0) << speed;
    EXPECT_EQ(court.referee->collisions(ContactKind::kMoving), touched ? 0 : 1) << speed;
  }
}

TEST(RefereeTest, agreesWithSamplingOnRandomPairs) {
  RandomStream random(3, "test", "referee");
  int contacts = 0;
  for (int round = 0; round < 1000; ++round) {
    const Pose2 a{5 + random.uniform(-0.5, 0.5), 5 + random.uniform(-0.5, 0.5), random.uniform(-4, 4)};
    const Pose2 b{5 + random.uniform(-0.5, 0.5), 5 + random.uniform(-0.5, 0.5), random.uniform(-4, 4)};
    Court court({a, b});
    court.judge();
    const int counted = court.referee->collisions(ContactKind::kRobot);
    int shared = 0, nearly = 0;  // samples of a that are in b, and in b grown a little
    for (double x = -0.4; x <= 0.4001; x += 0.01) {
      for (double y = -0.2; y <= 0.2001; y += 0.01) {
        const Eigen::Vector2d p = b.inverse() * (a * Eigen::Vector2d(x, y));
        shared += std::abs(p.x()) < 0.399999 && std::abs(p.y()) < 0.199999 ? 1 : 0;
        nearly += std::abs(p.x()) < 0.41 && std::abs(p.y()) < 0.21 ? 1 : 0;
      }
    }
    if (shared > 0) {
      EXPECT_EQ(counted, 1) << "round " << round;
    }
    if (nearly == 0) {
      EXPECT_EQ(counted, 0) << "round " << round;
    }
    contacts += counted;
  }
  EXPECT_GT(contacts, 300);
  EXPECT_LT(contacts, 990);
}

TEST(RefereeTest, arrivalIsStandingWithinTheToleranceForHalfASecond) {
  Court court({{15.2, 15, 0}});
  court.snapshot.bodies[0].state.twist.speed = 0.03;
  court.judge(2.0);
  EXPECT_FALSE(court.referee->records()[0].reached);
  court.snapshot.bodies[0].state.twist = {0.0, 0.03};
  court.judge(2.0);
  EXPECT_FALSE(court.referee->records()[0].reached);
  court.snapshot.bodies[0].state.twist = {0.01, 0.0};
  court.judge(0.49);
  EXPECT_FALSE(court.referee->records()[0].reached);
  court.judge(0.02);
  EXPECT_TRUE(court.referee->records()[0].reached);
  EXPECT_NEAR(court.referee->records()[0].time, 4.5, 0.011);
  EXPECT_TRUE(court.referee->success());
  court.pose(0) = {10, 10, 0};  // goes away again: neither time nor length count any more
  court.judge(1.0);
  EXPECT_EQ(court.referee->records()[0].length, 0.0);
  EXPECT_NEAR(court.referee->records()[0].time, 4.5, 0.011);
}

TEST(RefereeTest, outsideTheToleranceIsNotArrived) {
  Court court({{15.31, 15, 0}});
  court.judge(2.0);
  EXPECT_FALSE(court.referee->allReached());
}

TEST(RefereeTest, odometryMayBeTheJudge) {
  Court court({{5, 5, 0}});
  court.scenario.judge = Judge::kOdometry;
  court.referee = std::make_unique<Referee>(court.scenario, court.world);
  court.believed = {10.1, 10, 0};  // the goal is at (10, 10) of its odom frame
  court.judge(1.0);
  EXPECT_TRUE(court.referee->records()[0].reached);
}

TEST(RefereeTest, theKilledDoNotCount) {
  Court court({{15, 15, 0}, {5, 5, 0}});
  court.judge(1.0);
  EXPECT_FALSE(court.referee->allReached());
  court.referee->noteKilled(1);
  EXPECT_TRUE(court.referee->allReached());
  EXPECT_TRUE(court.referee->success());
}

TEST(RefereeTest, measuresLengthTimeAndClearance) {
  Court court({{5, 5, 0}, {5, 7, 0}});
  court.snapshot.bodies[0].state.twist.speed = 1.0;
  for (int i = 0; i < 100; ++i) {
    court.pose(0).x += 0.01;
    court.judge();
  }
  court.snapshot.bodies[0].state.twist.speed = 0.0;
  court.judge(0.5);
  const RobotRecord& record = court.referee->records()[0];
  EXPECT_NEAR(record.length, 1.0, 1e-9);
  EXPECT_NEAR(record.time, 1.5, 1e-9);
  EXPECT_NEAR(record.stopped, 0.5, 1e-9);
  EXPECT_NEAR(record.min_clearance, 1.6, 1e-9);
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
