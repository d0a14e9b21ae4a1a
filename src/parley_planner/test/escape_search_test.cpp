// SPDX-License-Identifier: BSD-3-Clause
#include "escape_search.h"

#include <gtest/gtest.h>

#include "scenes.h"

namespace parley {
namespace {

class EscapeTest : public testing::Test {
 protected:
  EscapeTest() {
    world_.fill(0.5, 4.4, 9.5, 5.6, false);  // a corridor 1.2 m wide
    PeerMotion pusher;
    pusher.id = 9;
    pusher.footprint = robotFootprint();
    pusher.trajectory = SampledTrajectory::standing({2.0, 5.0, 0.0}, 0.0);
    pusher.intent = {{1.0, 9, 0}, {{2.0, 5.0}, {9.5, 5.0}}};
    first_ = {tubeOf(pusher, 0.0, 0.1)};
  }

  std::optional<Path> escape(const Pose2& start, std::vector<Eigen::Vector2d> failed = {}) {
    const Surroundings surroundings(seenMap(world_), {}, {}, {});
    std::vector<PeerTube> all = first_;
    all.insert(all.end(), others_.begin(), others_.end());
    return escapePath(
        {surroundings, footprint_, start, {1.0, 5.0}, first_, all, {1.0, 9, 1}, std::nullopt, std::move(failed), room_});
  }

  PeerTube standing(std::uint32_t id, double x, double y, const RightOfWay& right) const {
    PeerTube tube;
    tube.id = id;
    tube.right = right;
    tube.footprint = footprint_;
    tube.pose = {x, y, 0.0};
    tube.way = {{x, y}};
    return tube;
  }

  const Footprint footprint_ = robotFootprint();
  World world_{10, 10, true};
  std::vector<PeerTube> first_, others_;
  double room_ = 0.0;
};

TEST_F(EscapeTest, LeadsIntoTheNearestPlaceAside) {
  world_.fill(5.0, 5.5, 6.2, 7.0, false);  // a niche
  const auto path = escape({4.0, 5.0, 0.0});
  ASSERT_TRUE(path);
  EXPECT_NEAR((path->front() - Eigen::Vector2d(4.0, 5.0)).norm(), 0.0, 1e-9);
  EXPECT_GT(path->back().y(), 5.6);
  EXPECT_NEAR(path->back().x(), 5.6, 0.5);
  // Having failed there, it goes on to the next.
  world_.fill(7.5, 5.5, 8.7, 7.0, false);
  const auto next = escape({4.0, 5.0, 0.0}, {path->back(), {5.6, 6.3}, {5.6, 5.8}});
  ASSERT_TRUE(next);
  EXPECT_GT(next->back().x(), 7.0);
}

TEST_F(EscapeTest, BacksAwayWhereThereIsNoPlaceAside) {
  const auto path = escape({4.0, 5.0, 0.0});
  ASSERT_TRUE(path);
  EXPECT_GT(path->back().x(), 7.5);
}

TEST_F(EscapeTest, GoesThroughThoseWhoMakeRoomOnly) {
  others_ = {standing(5, 5.5, 5.0, {1.0, 5, 0})};
  const auto path = escape({4.0, 5.0, 0.0});
  ASSERT_TRUE(path);
  EXPECT_GT(path->back().x(), 7.5);
  others_ = {standing(11, 5.5, 5.0, {1.0, 11, 0})};
  const auto closed = escape({4.0, 5.0, 0.0});
  EXPECT_TRUE(!closed || closed->back().x() < 5.5);
}

TEST_F(EscapeTest, GoesThroughThoseFurtherOnWhoMakeRoomForTheSame) {
  others_ = {standing(11, 5.5, 5.0, {1.0, 9, 1})};
  const auto path = escape({4.0, 5.0, 0.0});
  ASSERT_TRUE(path);
  EXPECT_GT(path->back().x(), 7.5);
  // It is they who are pushed on, not who stands nearer to the one that goes first.
  others_ = {standing(11, 4.0, 5.0, {1.0, 9, 1})};
  world_.fill(0.0, 5.5, 1.4, 7.0, false);
  const auto back = escape({5.5, 5.0, 0.0});
  ASSERT_TRUE(back);
  EXPECT_GT(back->back().x(), 7.5);
  // Whose right it is itself does not make room.
  others_ = {standing(11, 5.5, 5.0, {1.0, 9, 0})};
  const auto closed = escape({4.0, 5.0, 0.0});
  EXPECT_TRUE(!closed || closed->back().x() < 5.5);
}

TEST_F(EscapeTest, KnowsADeadEnd) {
  world_.fill(4.6, 0.0, 10.0, 10.0, true);
  EXPECT_FALSE(escape({4.0, 5.0, 0.0}));
}

TEST_F(EscapeTest, LooksForRoomAndElseForTheFarEnd) {
  room_ = 0.9;
  EXPECT_FALSE(escape({4.0, 5.0, 0.0}));
  const Surroundings surroundings(seenMap(world_), {}, {}, {});
  const EscapeTask task{surroundings, footprint_, {8.0, 5.0, 0.0}, {1.0, 5.0}, first_, {}, {2.0, 1, 0}, std::nullopt, {}, room_};
  const auto away = pathAwayFrom(task, {9.0, 5.0});
  ASSERT_TRUE(away);
  EXPECT_LT(away->back().x(), 1.6);
  world_.fill(4.0, 3.0, 6.5, 7.0, false);
  const auto place = escape({3.2, 5.0, 0.0});
  ASSERT_TRUE(place);
  EXPECT_GT(std::abs(place->back().y() - 5.0), 0.5);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
