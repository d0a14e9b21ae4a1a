// SPDX-License-Identifier: BSD-3-Clause
#include "corners.h"

#include <gtest/gtest.h>

#include "parley_geometry/polygon.h"

namespace parley {
namespace {

constexpr double kSimplify = 0.04;

class Drawing {
 public:
  /// Cells whose middles are in the shape become occupied.
  template <class Shape>
  void draw(double x0, double y0, double x1, double y1, const Shape& inside) {
    for (int y = map.cellOf(y0); y <= map.cellOf(y1); ++y) {
      for (int x = map.cellOf(x0); x <= map.cellOf(x1); ++x) {
        if (!inside(map.centerOf(x, y))) continue;
        Tile& tile = *map.ensure(tileOf(x), tileOf(y));
        tile.flags[offsetOf(x, y)] |= kSeen | kOwn;
        tile.changed_cells = 0xffff;
        map.note(tile);
      }
    }
  }
  void box(double x0, double y0, double x1, double y1) {
    draw(x0, y0, x1, y1, [=](const Eigen::Vector2d& p) { return p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1; });
  }
  std::vector<Vertex> corners() {
    refreshField(map, shape);
    for (const auto& tile : map.tiles()) tile->chains = traceTile(map, tile->tx, tile->ty, shape, kSimplify);
    std::vector<Vertex> all;
    for (const auto& tile : map.tiles()) {
      for (const Vertex& corner : cornersOf(map, *tile, shape, kSimplify, layers)) all.push_back(corner);
    }
    return all;
  }
  TopologyOptions options;
  FieldShape shape{0.22, 1.0, 0.1};
  TiledMap map{0.05, 100.0, 1000};
  LayerStore layers{options, 0.22};
};

}  // namespace

TEST(Corners, aBoxHasFour) {
  for (double shift : {0.4, 1.9, 2.7, 3.1}) {  // the later ones lie across the border of tiles at 3.2 m
    Drawing drawing;
    drawing.box(shift, 0.5, shift + 1.0, 1.5);
    const std::vector<Vertex> corners = drawing.corners();
    ASSERT_GE(corners.size(), 4U) << shift;
    ASSERT_LE(corners.size(), 8U) << shift;
    int matched = 0;
    for (double x : {shift, shift + 1.0}) {
      for (double y : {0.5, 1.5}) {
        const Eigen::Vector2d out = (Eigen::Vector2d(x, y) - Eigen::Vector2d(shift + 0.5, 1.0)).normalized();
        const Eigen::Vector2d expected = Eigen::Vector2d(x, y) + 0.22 * std::sqrt(2.0) * out;
        for (const Vertex& corner : corners) {
          if ((corner.position - expected).norm() > 0.2) continue;
          ++matched;
          EXPECT_GT(corner.direction.dot(out), 0.8);
          break;
        }
      }
    }
    EXPECT_EQ(matched, 4) << shift;
  }
}

TEST(Corners, theInsideOfARoomHasNone) {
  Drawing drawing;
  drawing.draw(0.0, 0.0, 9.0, 9.0, [](const Eigen::Vector2d& p) {
    return p.x() > 0 && p.x() < 9 && p.y() > 0 && p.y() < 9 && (p.x() < 0.2 || p.x() > 8.8 || p.y() < 0.2 || p.y() > 8.8);
  });
  for (const Vertex& corner : drawing.corners()) {
    const Eigen::Vector2d& p = corner.position;
    EXPECT_TRUE(p.x() < 0.2 || p.x() > 8.8 || p.y() < 0.2 || p.y() > 8.8) << p.transpose();
  }
}

TEST(Corners, aRoundColumnIsGoneAroundWithinItsTolerance) {
  for (double radius : {0.1, 0.5, 2.0}) {
    Drawing drawing;
    const Eigen::Vector2d middle(3.3, 3.1);
    drawing.draw(0.0, 0.0, 7.0, 7.0, [&](const Eigen::Vector2d& p) { return (p - middle).norm() < radius; });
    std::vector<Vertex> corners = drawing.corners();
    ASSERT_GE(corners.size(), 4U);
    ASSERT_LE(corners.size(), 28U);
    std::sort(corners.begin(), corners.end(), [&](const Vertex& a, const Vertex& b) {
      const Eigen::Vector2d u = a.position - middle, v = b.position - middle;
      return std::atan2(u.y(), u.x()) < std::atan2(v.y(), v.x());
    });
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d& a = corners[i].position;
      const Eigen::Vector2d& b = corners[(i + 1) % corners.size()].position;
      EXPECT_GT(pointSegmentDistance(middle, a, b), radius + 0.22 - 0.13) << radius;
      EXPECT_LT((a - middle).norm(), radius + 0.22 + 0.2) << radius;
      EXPECT_GT(corners[i].direction.dot((a - middle).normalized()), 0.7);
    }
  }
}

TEST(Corners, smallObstaclesArePillars) {
  Drawing drawing;
  drawing.box(1.0, 1.0, 1.1, 1.1);
  drawing.box(5.0, 0.5, 6.0, 1.5);
  int pillars = 0, others = 0;
  for (const Vertex& corner : drawing.corners()) (corner.kind == VertexClass::kPillar ? pillars : others) += 1;
  EXPECT_GE(pillars, 4);
  EXPECT_GE(others, 4);
}

TEST(Corners, chainsOfNeighbouringTilesJoin) {
  Drawing drawing;
  drawing.draw(0.0, 0.0, 12.0, 12.0,
               [](const Eigen::Vector2d& p) { return std::abs((p - Eigen::Vector2d(6, 6)).norm() - 4.0) < 0.1; });
  drawing.corners();
  for (const auto& tile : drawing.map.tiles()) {
    for (const Chain& chain : tile->chains) {
      if (chain.closed) continue;
      const Tile* next = drawing.map.find(tileOf(chain.end.x()), tileOf(chain.end.y()));
      ASSERT_NE(next, nullptr);
      const auto follows = [&](const Chain& other) {
        return !other.closed && other.first == chain.end && other.before == chain.last &&
               other.points.front() == chain.points.back() && other.turn == chain.turn;
      };
      EXPECT_EQ(std::count_if(next->chains.begin(), next->chains.end(), follows), 1);
    }
  }
}

TEST(Corners, nameWhoSaysThatTheObstacleIsThere) {
  Drawing drawing;
  drawing.box(1.0, 1.0, 2.0, 2.0);
  LayerUpdate layer;
  layer.origin = "bob";
  layer.hops = 2;
  layer.contours.push_back({{{5.0, 1.0}, {6.0, 1.0}, {6.0, 2.0}, {5.0, 2.0}}, true});
  drawing.layers.set(drawing.map, layer);
  int own = 0, told = 0;
  for (const Vertex& corner : drawing.corners()) {
    const bool is_own = corner.position.x() < 3.5;
    EXPECT_EQ(corner.provenance.origin, is_own ? "" : "bob");
    EXPECT_EQ(corner.provenance.hops, is_own ? 0 : 2);
    (is_own ? own : told) += 1;
  }
  EXPECT_GE(own, 4);
  EXPECT_GE(told, 4);
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
