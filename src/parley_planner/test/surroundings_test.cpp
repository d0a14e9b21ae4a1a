// SPDX-License-Identifier: BSD-3-Clause
#include "surroundings.h"

#include <gtest/gtest.h>

#include <random>

#include "parley_geometry/polygon.h"
#include "scenes.h"

namespace parley {
namespace {

TEST(DistanceField, MeasuresToTheNearestMarkedCell) {
  const GridFrame frame{{-1.0, 2.0}, 0.05, 100, 80};
  std::vector<unsigned char> marked(8000, 0);
  std::vector<Eigen::Vector2d> places;
  std::mt19937 random(3);
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector2i cell(static_cast<int>(random() % 100), static_cast<int>(random() % 80));
    marked[static_cast<std::size_t>(frame.indexOf(cell))] = 1;
    places.push_back(frame.centerOf(cell));
  }
  const DistanceField field(frame, marked);
  std::uniform_real_distribution<double> x(-0.9, 3.9), y(2.1, 5.9);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d p(x(random), y(random));
    double truth = 1e9;
    for (const Eigen::Vector2d& place : places) truth = std::min(truth, (place - p).norm());
    EXPECT_NEAR(field.at(p), std::min(2.0, truth), 0.03);
    const DistanceField::Sample sample = field.sample(p);
    EXPECT_NEAR(sample.distance, field.at(p), 1e-9);
  }
}

TEST(DistanceField, GradientPointsAway) {
  LocalMap map = seenMap(World(10, 10, false));
  setCells(&map, 4.9, 0.0, 5.0, 10.0, CellState::kOccupied);
  const Surroundings surroundings(map, {}, {}, {});
  EXPECT_NEAR(surroundings.obstacles().sample({5.5, 5.0}).gradient.x(), 1.0, 0.05);
  EXPECT_NEAR(surroundings.obstacles().sample({4.3, 5.0}).gradient.x(), -1.0, 0.05);
  EXPECT_GT(surroundings.obstacles().at({50.0, 5.0}), 1.0);  // outside: as at the rim
}

TEST(Surroundings, FarWhereNothingIs) {
  const Surroundings surroundings(seenMap(World(10, 10, false)), {}, {}, {});
  EXPECT_FALSE(surroundings.empty());
  EXPECT_NEAR(surroundings.obstacles().at({5.0, 5.0}), 2.0, 1e-6);
  EXPECT_NEAR(surroundings.unseen().at({5.0, 5.0}), 2.0, 1e-6);
  EXPECT_TRUE(Surroundings().empty());
}

TEST(Surroundings, BlockedPlacesAreTheCellsInsideThem) {
  const LocalMap map = seenMap(World(10, 8, false));
  const Surroundings empty(map, {}, {}, {});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(-1.0, 11.0), y(-1.0, 9.0), size(0.0, 0.6), yaw(-kPi, kPi);
  for (int round = 0; round < 20; ++round) {
    Blocked blocked;
    blocked.addStrip({{x(random), y(random)}, {x(random), y(random)}, {x(random), y(random)}}, size(random));
    for (int i = 0; i < 3; ++i) {
      blocked.bodies.push_back({{x(random), y(random), yaw(random)}, {0.1 + size(random), 0.1 + size(random)}, size(random)});
    }
    const Surroundings shape = empty.with(blocked);
    for (int cy = 0; cy < map.frame.height; ++cy) {
      for (int cx = 0; cx < map.frame.width; ++cx) {
        const Eigen::Vector2d p = map.frame.centerOf({cx, cy});
        bool inside = empty.obstacles().atCell(cx, cy) == 0.0F;
        for (const Blocked::Disc& disc : blocked.discs) inside = inside || (p - disc.center).norm() < disc.radius;
        for (const Blocked::Body& body : blocked.bodies) {
          const Eigen::Vector2d away = p - body.pose.position();
          const Eigen::Vector2d along = body.pose.direction(), across(-along.y(), along.x());
          inside = inside || (std::abs(away.dot(along)) <= 0.5 * body.footprint.length + body.growth &&
                              std::abs(away.dot(across)) <= 0.5 * body.footprint.width + body.growth);
        }
        ASSERT_EQ(shape.obstacles().atCell(cx, cy) == 0.0F, inside) << "round " << round << ", " << p.transpose();
      }
    }
    EXPECT_EQ(shape.unseen().atCell(3, 3), empty.unseen().atCell(3, 3));
  }
}

TEST(Surroundings, ScanReturnsBlockUnlessTheyMove) {
  World world(10, 10, false);
  world.fill(6.0, 4.8, 6.4, 5.2, true);
  std::mt19937 random(1);
  const Pose2 pose{5.0, 5.0, 0.4};
  const ObstacleScan scan = castScan(world, pose, 0.0, 0.0, random);
  const LocalMap map = seenMap(World(10, 10, false));
  EXPECT_LT(Surroundings(map, scan, pose, {}).obstacles().at({6.0, 5.0}), 0.06);
  TrackedObject track;
  track.position = {6.2, 5.0};
  track.radius = 0.3;
  EXPECT_LT(Surroundings(map, scan, pose, {track}).obstacles().at({6.0, 5.0}), 0.06);
  track.moving = track.has_moved = true;
  EXPECT_GT(Surroundings(map, scan, pose, {track}).obstacles().at({6.0, 5.0}), 1.0);
}

TEST(Surroundings, SingleUnknownCellsAreSpecks) {
  LocalMap map = seenMap(World(10, 10, false));
  map.cells[static_cast<std::size_t>(map.frame.indexOf({100, 100}))] = CellState::kUnknown;
  setCells(&map, 7.0, 7.0, 8.0, 8.0, CellState::kUnknown);
  const Surroundings surroundings(map, {}, {}, {});
  EXPECT_GT(surroundings.unseen().at({5.0, 5.0}), 1.0);
  EXPECT_LT(surroundings.unseen().at({7.5, 7.5}), 0.01);
}

class ProbeTest : public testing::TestWithParam<Footprint> {};

TEST_P(ProbeTest, AgreesWithTheExactRectangle) {
  const Footprint footprint = GetParam();
  const FootprintProbe probe(footprint);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.7, 0.7), yaw(-3.1, 3.1);
  for (int i = 0; i < 300; ++i) {
    LocalMap map = seenMap(World(10, 10, false));
    const Eigen::Vector2i cell = map.frame.cellOf({5.0 + place(random), 5.0 + place(random)});
    map.cells[static_cast<std::size_t>(map.frame.indexOf(cell))] = CellState::kOccupied;
    const Pose2 pose{5.0, 5.0, yaw(random)};
    const Eigen::Vector2d p = pose.inverse() * map.frame.centerOf(cell);
    const double truth = std::hypot(std::max(0.0, std::abs(p.x()) - 0.5 * footprint.length),
                                    std::max(0.0, std::abs(p.y()) - 0.5 * footprint.width));
    const double found = probe.clearance(Surroundings(map, {}, {}, {}).obstacles(), pose);
    if (truth > 0.0) {
      EXPECT_NEAR(found, truth, 0.05 + 0.02 * truth) << "seed 5, case " << i;
    } else {
      EXPECT_LT(found, 0.06);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, ProbeTest, testing::Values(Footprint{0.8, 0.4}, Footprint{0.4, 0.8}, Footprint{0.5, 0.5}));

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
