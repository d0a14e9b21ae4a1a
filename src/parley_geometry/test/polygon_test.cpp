// SPDX-License-Identifier: BSD-3-Clause
#include "parley_geometry/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "parley_geometry/footprint.h"

namespace parley {
namespace {

using Eigen::Vector2d;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vector2d randomPoint(std::mt19937& random, double reach) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach)};
}

/// Corners on an ellipse, counter-clockwise: convex.
Polygon randomConvex(std::mt19937& random, const Vector2d& middle) {
  std::vector<double> angles(3 + random() % 5);
  for (double& angle : angles) angle = uniform(random, -kPi, kPi);
  std::sort(angles.begin(), angles.end());
  const double a = uniform(random, 0.3, 1.5), b = uniform(random, 0.3, 1.5);
  Polygon polygon;
  for (const double angle : angles) polygon.push_back(middle + Vector2d(a * std::cos(angle), b * std::sin(angle)));
  return polygon;
}

/// A star about the origin: simple, seldom convex. `radii` are of corners at even angles.
Polygon star(const std::vector<double>& radii) {
  Polygon polygon;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double angle = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(radii.size());
    polygon.emplace_back(radii[i] * std::cos(angle), radii[i] * std::sin(angle));
  }
  return polygon;
}

/// Inside by winding: the angle that the polygon's corners turn about the point.
bool insideByWinding(const Polygon& polygon, const Vector2d& p) {
  double turned = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d a = polygon[i] - p, b = polygon[(i + 1) % polygon.size()] - p;
    turned += std::atan2(cross(a, b), a.dot(b));
  }
  return std::abs(turned) > kPi;
}

TEST(Polygon, containsAgreesWithTheWindingAngle) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    std::vector<double> radii(3 + random() % 9);
    for (double& r : radii) r = uniform(random, 0.2, 2.0);
    const Polygon polygon = star(radii);
    for (int k = 0; k < 100; ++k) {
      const Vector2d p = randomPoint(random, 2.0);
      ASSERT_EQ(contains(polygon, p), insideByWinding(polygon, p)) << "case " << i << " point " << p.transpose();
    }
  }
}

TEST(Polygon, areaAgreesWithPointSampling) {
  std::mt19937 random(2);
  for (int i = 0; i < 10; ++i) {
    const Polygon polygon = star({uniform(random, 0.5, 2.0), 1.0, uniform(random, 0.5, 2.0), 1.5, 0.4});
    constexpr int kSamples = 40000;
    int hits = 0;
    for (int k = 0; k < kSamples; ++k) hits += insideByWinding(polygon, randomPoint(random, 2.0)) ? 1 : 0;
    EXPECT_NEAR(signedArea(polygon), 16.0 * hits / kSamples, 0.15);
    EXPECT_NEAR(signedArea(Polygon(polygon.rbegin(), polygon.rend())), -signedArea(polygon), 1e-12);
  }
}

TEST(Polygon, knownShapes) {
  const Polygon square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_EQ(signedArea(square), 4.0);
  EXPECT_EQ(perimeter(square), 8.0);
  EXPECT_TRUE(isConvex(square));
  EXPECT_FALSE(isConvex(Polygon(square.rbegin(), square.rend()))) << "clockwise";
  EXPECT_TRUE(isConvex({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}})) << "straight corners are allowed";
  EXPECT_FALSE(isConvex({{0, 0}, {2, 0}, {1, 0.5}, {2, 2}}));
  EXPECT_TRUE(isSimple(square));
  EXPECT_TRUE(isSimple({{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_FALSE(isSimple({{0, 0}, {2, 2}, {2, 0}, {0, 2}})) << "a bow tie";
  EXPECT_FALSE(isSimple({{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}})) << "a corner on an edge";
  EXPECT_EQ(pathLength({{0, 0}, {3, 4}, {3, 5}}), 6.0);
}

TEST(Polygon, degenerateOnes) {
  for (const Polygon& polygon : {Polygon{}, Polygon{{1, 1}}, Polygon{{1, 1}, {2, 2}}}) {
    EXPECT_EQ(signedArea(polygon), 0.0);
    EXPECT_FALSE(contains(polygon, {1.5, 1.4}));
    EXPECT_FALSE(isSimple(polygon));
    EXPECT_FALSE(isConvex(polygon));
  }
  EXPECT_EQ(perimeter({}), 0.0);
  EXPECT_EQ(pathLength({}), 0.0);
  EXPECT_EQ(pathLength({{1, 1}}), 0.0);
}

/// By walking along both segments.
double sampledDistance(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  constexpr int kSteps = 150;
  double least = 1e9;
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      const Vector2d p = a + (b - a) * i / kSteps, q = c + (d - c) * k / kSteps;
      least = std::min(least, (p - q).norm());
    }
  }
  return least;
}

TEST(Segments, distanceAgreesWithSampling) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const Vector2d a = randomPoint(random, 1.0), c = randomPoint(random, 1.0), d = randomPoint(random, 1.0);
    const Vector2d b = i % 10 == 0 ? a : randomPoint(random, 1.0);  // a point now and then
    ASSERT_NEAR(segmentDistance(a, b, c, d), sampledDistance(a, b, c, d), 0.02) << "case " << i;
    ASSERT_NEAR(pointSegmentDistance(a, c, d), sampledDistance(a, a, c, d), 0.02) << "case " << i;
    ASSERT_EQ(segmentsIntersect(a, b, c, d), segmentDistance(a, b, c, d) == 0.0) << "case " << i;
  }
}

TEST(Segments, intersectionLiesOnBoth) {
  std::mt19937 random(4);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector2d a = randomPoint(random, 1.0), b = randomPoint(random, 1.0);
    const Vector2d c = randomPoint(random, 1.0), d = randomPoint(random, 1.0);
    const auto p = segmentIntersection(a, b, c, d);
    ASSERT_EQ(p.has_value(), segmentsIntersect(a, b, c, d)) << "case " << i;
    if (!p) continue;
    ++found;
    ASSERT_LT(pointSegmentDistance(*p, a, b), 1e-9);
    ASSERT_LT(pointSegmentDistance(*p, c, d), 1e-9);
  }
  EXPECT_GT(found, 200);
}

TEST(Segments, touchingAndParallel) {
  EXPECT_TRUE(segmentsIntersect({0, 0}, {2, 0}, {1, 0}, {1, 1})) << "an end on the other";
  EXPECT_TRUE(segmentsIntersect({1, 0}, {1, 1}, {0, 0}, {2, 0}));
  EXPECT_TRUE(segmentsIntersect({0, 0}, {1, 1}, {1, 1}, {2, 0})) << "end to end";
  EXPECT_TRUE(segmentsIntersect({0, 0}, {2, 0}, {1, 0}, {3, 0})) << "one over the other";
  EXPECT_FALSE(segmentsIntersect({0, 0}, {1, 0}, {2, 0}, {3, 0})) << "in line";
  EXPECT_FALSE(segmentsIntersect({0, 0}, {2, 0}, {0, 1}, {2, 1}));
  EXPECT_FALSE(segmentIntersection({0, 0}, {2, 0}, {1, 0}, {3, 0})) << "parallel ones have no single point";
  EXPECT_NEAR(segmentDistance({0, 0}, {1, 0}, {2, 0}, {3, 0}), 1.0, 1e-12);
}

/// Least distance between points spread over two convex areas, 0 if some point of one is in the other.
double sampledConvexDistance(const Polygon& a, const Polygon& b) {
  double least = 1e9;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int k = 0; k < 100; ++k) {
      const Vector2d p = a[i] + (a[(i + 1) % a.size()] - a[i]) * k / 100.0;
      if (insideByWinding(b, p)) return 0.0;
      for (std::size_t j = 0; j < b.size(); ++j) {
        least = std::min(least, pointSegmentDistance(p, b[j], b[(j + 1) % b.size()]));
      }
    }
  }
  return std::any_of(b.begin(), b.end(), [&](const Vector2d& p) { return insideByWinding(a, p); }) ? 0.0 : least;
}

TEST(Convex, distanceAndOverlapAgreeWithSampling) {
  std::mt19937 random(5);
  int overlaps = 0;
  for (int i = 0; i < 400; ++i) {
    const Polygon a = randomConvex(random, {0.0, 0.0}), b = randomConvex(random, randomPoint(random, 3.0));
    if (signedArea(a) < 0.01 || signedArea(b) < 0.01) continue;
    const double expected = sampledConvexDistance(a, b);
    ASSERT_NEAR(convexDistance(a, b), expected, 0.02) << "case " << i;
    ASSERT_EQ(convexDistance(a, b), convexDistance(b, a)) << "case " << i;
    if (expected > 0.02 || expected == 0.0) {
      ASSERT_EQ(convexOverlap(a, b), expected == 0.0) << "case " << i;
    }
    overlaps += convexOverlap(a, b) ? 1 : 0;
  }
  EXPECT_GT(overlaps, 30);
}

TEST(Convex, touchingCountsAsOverlap) {
  const Polygon a{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, b{{1, 0}, {2, 0}, {2, 1}, {1, 1}};
  EXPECT_TRUE(convexOverlap(a, b));
  EXPECT_EQ(convexDistance(a, b), 0.0);
  const Polygon inner{{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6}};
  EXPECT_TRUE(convexOverlap(a, inner)) << "one inside the other";
}

TEST(Convex, movesRigidly) {
  std::mt19937 random(6);
  for (int i = 0; i < 100; ++i) {
    const Polygon a = randomConvex(random, {0.0, 0.0}), b = randomConvex(random, randomPoint(random, 3.0));
    const Pose2 T{uniform(random, -5.0, 5.0), uniform(random, -5.0, 5.0), uniform(random, -kPi, kPi)};
    const Polygon moved = transformed(T, a);
    for (std::size_t k = 0; k < a.size(); ++k) ASSERT_LT((moved[k] - T * a[k]).norm(), 1e-12);
    ASSERT_NEAR(convexDistance(moved, transformed(T, b)), convexDistance(a, b), 1e-9);
    ASSERT_NEAR(signedArea(moved), signedArea(a), 1e-9);
  }
}

TEST(Footprint, containsWhatItsPolygonContains) {
  std::mt19937 random(7);
  const Footprint footprint{0.8, 0.4};
  for (int i = 0; i < 2000; ++i) {
    const Pose2 pose{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), uniform(random, -kPi, kPi)};
    const double margin = uniform(random, 0.0, 0.3);
    const Vector2d p = randomPoint(random, 0.8);
    ASSERT_EQ(footprint.contains(p, margin), insideByWinding(footprint.polygonAt(pose, margin), pose * p));
  }
}

TEST(Footprint, radiiTouchItsEdgesAndCorners) {
  for (const Footprint& footprint : {Footprint{0.8, 0.4}, Footprint{0.3, 0.9}, Footprint{0.5, 0.5}}) {
    const Polygon polygon = footprint.polygon();
    EXPECT_TRUE(isConvex(polygon));
    EXPECT_NEAR(signedArea(polygon), footprint.length * footprint.width, 1e-12);
    double nearest = 1e9, furthest = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      nearest = std::min(nearest, pointSegmentDistance({0.0, 0.0}, polygon[i], polygon[(i + 1) % 4]));
      furthest = std::max(furthest, polygon[i].norm());
    }
    EXPECT_NEAR(footprint.inscribedRadius(), nearest, 1e-12);
    EXPECT_NEAR(footprint.circumscribedRadius(), furthest, 1e-12);
  }
}

TEST(Footprint, discsCoverIt) {
  std::mt19937 random(8);
  for (const Footprint& footprint : {Footprint{0.8, 0.4}, Footprint{0.3, 0.9}, Footprint{0.5, 0.5}}) {
    double last_radius = 1e9;
    for (int count = 1; count <= 6; ++count) {
      const DiscCover cover = coverWithDiscs(footprint, count);
      ASSERT_EQ(cover.offsets.size(), static_cast<std::size_t>(count));
      EXPECT_LT(cover.radius, last_radius);
      last_radius = cover.radius;
      for (int i = 0; i < 1000; ++i) {
        const Vector2d p(uniform(random, -0.5, 0.5) * footprint.length, uniform(random, -0.5, 0.5) * footprint.width);
        const bool covered = std::any_of(cover.offsets.begin(), cover.offsets.end(), [&](double offset) {
          const Vector2d middle = cover.along_x ? Vector2d(offset, 0.0) : Vector2d(0.0, offset);
          return (p - middle).norm() <= cover.radius + 1e-12;
        });
        ASSERT_TRUE(covered) << p.transpose() << " with " << count << " discs";
      }
    }
  }
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
