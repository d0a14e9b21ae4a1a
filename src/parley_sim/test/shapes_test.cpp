// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/shapes.h"

#include <gtest/gtest.h>

#include "parley_sim/random_stream.h"

namespace parley::sim {
namespace {

Box randomBox(RandomStream& random) {
  return boxAt({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-4, 4)}, random.uniform(0.1, 1.5),
               random.uniform(0.1, 1.5));
}

/// Whether the point lies in the box, told from its corners alone.
bool inside(const Box& box, const Eigen::Vector2d& p) {
  const auto corners = box.corners();
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d edge = corners[(i + 1) % 4] - corners[i], to = p - corners[i];
    if (edge.x() * to.y() - edge.y() * to.x() < 0.0) return false;
  }
  return true;
}

/// Points on a raster over a box.
std::vector<Eigen::Vector2d> samples(const Box& box, int count) {
  const auto corners = box.corners();
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i <= count; ++i) {
    for (int j = 0; j <= count; ++j) {
      points.push_back(corners[2] + double(i) / count * (corners[3] - corners[2]) +
                       double(j) / count * (corners[1] - corners[2]));
    }
  }
  return points;
}

TEST(ShapesTest, overlapAndDistanceOfBoxesAgreeWithSampling) {
  RandomStream random(7, "test", "boxes");
  for (int round = 0; round < 2000; ++round) {
    const Box a = randomBox(random), b = randomBox(random);
    bool shared = false;
    double nearest = 1e9;
    for (const Eigen::Vector2d& p : samples(a, 40)) {
      shared = shared || inside(b, p);
      nearest = std::min(nearest, distance(b, p));
    }
    if (shared) {
      EXPECT_TRUE(overlap(a, b)) << "round " << round;
    }
    if (!overlap(a, b)) {
      EXPECT_FALSE(shared) << "round " << round;
      EXPECT_LE(distance(a, b), nearest + 1e-9) << "round " << round;
      EXPECT_NEAR(distance(a, b), nearest, 0.04) << "round " << round;
    } else {
      EXPECT_EQ(distance(a, b), 0.0);
      EXPECT_LT(nearest, 0.04) << "round " << round;
    }
  }
}

TEST(ShapesTest, overlapWithDiscsAgreesWithSampling) {
  RandomStream random(8, "test", "discs");
  for (int round = 0; round < 1000; ++round) {
    const Box box = randomBox(random);
    const Disc disc{{random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5)}, random.uniform(0.05, 0.8)};
    double nearest = 1e9;
    for (const Eigen::Vector2d& p : samples(box, 60)) nearest = std::min(nearest, (p - disc.center).norm());
    if (nearest < disc.radius - 1e-6) {
      EXPECT_TRUE(overlap(box, disc)) << "round " << round;
    }
    if (nearest > disc.radius + 0.03) {
      EXPECT_FALSE(overlap(box, disc)) << "round " << round;
    }
    EXPECT_NEAR(distance(box, disc), std::max(0.0, nearest - disc.radius), 0.03) << "round " << round;
  }
}

TEST(ShapesTest, neighboursThatShareAnEdgeDoNotOverlap) {
  const Box a = boxAt({0, 0, 0}, 1, 1);
  EXPECT_FALSE(overlap(a, boxAt({1, 0, 0}, 1, 1)));
  EXPECT_TRUE(overlap(a, boxAt({0.999, 0, 0}, 1, 1)));
  EXPECT_FALSE(overlap(a, Disc{{1.0, 0.0}, 0.5}));
}

TEST(ShapesTest, raysEnterAndLeaveWhereTheBoundaryIs) {
  RandomStream random(9, "test", "rays");
  int hits = 0;
  for (int round = 0; round < 1000; ++round) {
    const Box box = randomBox(random);
    const double angle = random.uniform(-4, 4);
    const Eigen::Vector2d origin(random.uniform(-3, 3), random.uniform(-3, 3)), direction(std::cos(angle), std::sin(angle));
    const auto through = crossing(box, origin, direction);
    for (double t = -6.0; t < 6.0; t += 0.01) {
      const bool expected = through && t > through->enter + 1e-9 && t < through->leave - 1e-9;
      if (expected) {
        EXPECT_LT(distance(box, origin + t * direction), 1e-9);
      } else if (!through || t < through->enter - 1e-9 || t > through->leave + 1e-9) {
        EXPECT_GT(distance(box, origin + t * direction), 0.0) << "round " << round << " t " << t;
      }
    }
    hits += through ? 1 : 0;
    const auto disc = crossing(Disc{box.center, 0.5}, origin, direction);
    if (disc) {
      EXPECT_NEAR((origin + disc->enter * direction - box.center).norm(), 0.5, 1e-9);
      EXPECT_NEAR((origin + disc->leave * direction - box.center).norm(), 0.5, 1e-9);
    }
  }
  EXPECT_GT(hits, 100);
}

TEST(ShapesTest, aSegmentHasThickness) {
  const Box door = boxOfSegment({1, 1}, {1, 3}, 0.1);
  EXPECT_NEAR(distance(door, Eigen::Vector2d(1.1, 2.0)), 0.05, 1e-12);
  EXPECT_NEAR(distance(door, Eigen::Vector2d(1.0, 3.2)), 0.2, 1e-12);
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
