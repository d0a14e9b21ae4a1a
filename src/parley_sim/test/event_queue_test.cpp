// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/event_queue.h"

#include <gtest/gtest.h>

#include "parley_sim/moving_obstacle.h"

namespace parley::sim {
namespace {

Event kill(double time, std::size_t robot) {
  Event event;
  event.time = time;
  event.robot = robot;
  return event;
}

Event door(double time, bool closed) {
  Event event;
  event.time = time;
  event.kind = EventKind::kDoor;
  event.from = {0, 0};
  event.to = {1, 0};
  event.closed = closed;
  return event;
}

TEST(EventQueueTest, happenInOrderWhenTheirTimeHasCome) {
  EventQueue queue({kill(1.0, 0), kill(2.0, 1), kill(2.0, 2)});
  std::vector<std::size_t> happened;
  const auto note = [&happened](const Event& event) {
    happened.push_back(event.robot);
    return true;
  };
  queue.advance(0.98, note);
  EXPECT_TRUE(happened.empty());
  queue.advance(1.0, note);
  EXPECT_EQ(happened, std::vector<std::size_t>({0}));
  queue.advance(5.0, note);
  queue.advance(6.0, note);
  EXPECT_EQ(happened, std::vector<std::size_t>({0, 1, 2}));
}

TEST(EventQueueTest, whatCannotHappenWaits) {
  EventQueue queue({kill(1.0, 0)});
  int tries = 0;
  const auto third = [&tries](const Event&) { return ++tries == 3; };
  for (int i = 0; i < 10; ++i) queue.advance(1.0 + i, third);
  EXPECT_EQ(tries, 3);
}

TEST(EventQueueTest, aDoorThatOpensAgainNeverCloses) {
  EventQueue queue({door(1.0, true), door(3.0, false)});
  bool blocked = true;
  std::vector<bool> states;
  const auto happens = [&](const Event& event) {
    if (event.closed && blocked) return false;
    states.push_back(event.closed);
    return true;
  };
  queue.advance(1.0, happens);
  queue.advance(3.0, happens);
  blocked = false;
  queue.advance(4.0, happens);
  EXPECT_EQ(states, std::vector<bool>({false}));
  EXPECT_TRUE(sameDoor(door(0, true), door(1, false)));
}

TEST(MovingObstacleTest, goesThereAndBackAtItsSpeed) {
  const MovingObstacle obstacle({0.4, 2.0, {{0, 0}, {3, 0}, {3, 1}}});
  EXPECT_EQ(obstacle.at(0.0).radius, 0.4);
  EXPECT_NEAR((obstacle.at(1.0).center - Eigen::Vector2d(2, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((obstacle.at(1.75).center - Eigen::Vector2d(3, 0.5)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((obstacle.at(2.0).center - Eigen::Vector2d(3, 1)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((obstacle.at(3.0).center - Eigen::Vector2d(2, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((obstacle.at(4.0).center - Eigen::Vector2d(0, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((obstacle.at(5.0).center - Eigen::Vector2d(2, 0)).norm(), 0.0, 1e-12);
}

TEST(MovingObstacleTest, aPathOfOnePointIsAPlace) {
  const MovingObstacle obstacle({0.3, 1.0, {{1, 2}}});
  EXPECT_EQ(obstacle.at(17.0).center, Eigen::Vector2d(1, 2));
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
