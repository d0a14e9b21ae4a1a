// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "test_world.h"

namespace parley {
namespace {

using VertexKey = std::tuple<double, double, double, double, std::string>;
using EdgeKey = std::tuple<double, double, double, double, double, double>;

std::vector<VertexKey> vertexSet(const Topology& topology) {
  std::vector<VertexKey> keys;
  for (const Vertex& v : topology.graph().vertices()) {
    keys.emplace_back(v.position.x(), v.position.y(), v.direction.x(), v.direction.y(), v.provenance.origin);
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::vector<EdgeKey> edgeSet(const Topology& topology) {
  const VisibilityGraph& graph = topology.graph();
  std::vector<EdgeKey> keys;
  for (const Edge& edge : graph.edges()) {
    Eigen::Vector2d a = graph.vertex(edge.from).position, b = graph.vertex(edge.to).position;
    if (std::make_pair(b.x(), b.y()) < std::make_pair(a.x(), a.y())) std::swap(a, b);
    keys.emplace_back(a.x(), a.y(), b.x(), b.y(), edge.cost, edge.clearance);
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

void expectSame(const Topology& a, const Topology& b, const std::string& what) {
  EXPECT_EQ(vertexSet(a), vertexSet(b)) << what;
  EXPECT_EQ(edgeSet(a), edgeSet(b)) << what;
  const LocalMap map_a = a.localMap({5, 5}, 40.0, 0.0), map_b = b.localMap({5, 5}, 40.0, 0.0);
  EXPECT_TRUE(map_a.frame == map_b.frame);
  EXPECT_TRUE(map_a.cells == map_b.cells) << what;
}

/// Poses on a random walk through free space.
std::vector<Pose2> wander(const TestWorld& world, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> turn(-0.5, 0.5), at(1.0, world.width() - 1.0);
  Pose2 pose;
  do {
    pose = {at(random), at(random), 4.0 * turn(random)};
  } while (!world.isClear(pose.position(), 0.3));
  std::vector<Pose2> poses;
  while (static_cast<int>(poses.size()) < count) {
    const Pose2 next = integrateTwist(pose, 2.0, turn(random), 0.2);
    if (world.isClear(next.position(), 0.3)) {
      pose = next;
      poses.push_back(pose);
    } else {
      pose.yaw += 4.0 * turn(random);
    }
  }
  return poses;
}

}  // namespace

TEST(Graph, isAFunctionOfTheMapAndNotOfHowItWasLearnt) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const TestWorld world = seed % 2 ? TestWorld::rooms(20.0, 5.0, seed) : TestWorld::boxes(20.0, 40, seed);
    std::mt19937 random(seed);
    Topology step_by_step({}, testFootprint()), at_once({}, testFootprint());
    int n = 0;
    for (const Pose2& pose : wander(world, 120, seed)) {
      const ObstacleScan scan = world.noisyScan(pose, 0.02, random);
      step_by_step.integrate(scan, pose);
      at_once.integrate(scan, pose);
      if (++n % 2 == 0) step_by_step.update();
      if (n % 10 == 0) step_by_step.route(pose, {10, 10});  // measures edges
    }
    step_by_step.update();
    at_once.update();
    ASSERT_GT(at_once.graph().edgeCount(), 20);
    expectSame(step_by_step, at_once, "seed " + std::to_string(seed));
  }
}

TEST(Graph, aLayerTakenAwayLeavesNothing) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const TestWorld world = TestWorld::rooms(20.0, 5.0, seed);
    const TestWorld other = TestWorld::boxes(20.0, 40, seed);
    std::mt19937 random(seed);
    Topology plain({}, testFootprint()), layered({}, testFootprint());
    LayerUpdate layer{"bob", 1, 0.0, {0.03, -0.08, 0.02}, true, world.outlines()};
    LayerUpdate wrong{"ann", 2, 0.0, {-3.0, 1.0, 1.0}, seed % 2 == 0, other.outlines()};
    int n = 0;
    for (const Pose2& pose : wander(world, 100, seed)) {
      const ObstacleScan scan = world.noisyScan(pose, 0.02, random);
      plain.integrate(scan, pose);
      layered.integrate(scan, pose);
      if (n == 20) layered.setLayer(layer);
      if (n == 40) layered.setLayer(wrong);
      if (n == 60) {
        layer.T_odom_peer.x += 0.1;
        layered.setLayer(layer);
      }
      if (n == 80) layered.removeLayer("bob");
      if (n == 90) layered.removeLayer("ann");
      if (n++ % 2) {
        plain.update();
        layered.update();
      }
      if (n == 70) {
        EXPECT_NE(vertexSet(plain), vertexSet(layered));
      }
    }
    plain.update();
    layered.update();
    expectSame(plain, layered, "seed " + std::to_string(seed));
  }
}

TEST(Graph, sameInputsSameBits) {
  const TestWorld world = TestWorld::rooms(20.0, 5.0, 3);
  Topology a({}, testFootprint()), b({}, testFootprint());
  for (Topology* topology : {&a, &b}) {
    std::mt19937 random(3);
    for (const Pose2& pose : wander(world, 60, 3)) {
      topology->integrate(world.noisyScan(pose, 0.02, random), pose);
      topology->update();
    }
  }
  const std::vector<Edge> edges_a = a.graph().edges(), edges_b = b.graph().edges();
  ASSERT_EQ(edges_a.size(), edges_b.size());
  for (std::size_t i = 0; i < edges_a.size(); ++i) {
    EXPECT_EQ(edges_a[i].from, edges_b[i].from);
    EXPECT_EQ(edges_a[i].cost, edges_b[i].cost);
  }
}

TEST(Graph, doesNotGrowUnderNoiseFromAStandingRobot) {
  const TestWorld world = TestWorld::rooms(20.0, 5.0, 5);
  std::mt19937 random(5);
  Topology topology({}, testFootprint());
  const Pose2 pose = wander(world, 1, 5).front();
  int settled = 0, least = 1 << 30, most = 0, changed = 0;
  for (int i = 0; i < 260; ++i) {
    topology.integrate(world.noisyScan(pose, 0.02, random), pose);
    const TopologyResult result = topology.update();
    if (i < 60) continue;
    if (i == 60) settled = result.vertices;
    least = std::min(least, result.vertices);
    most = std::max(most, result.vertices);
    changed += result.added;
  }
  EXPECT_GT(settled, 3);
  EXPECT_LE(most, settled + 2 + settled / 10);
  EXPECT_GE(least, settled - 2 - settled / 10);
  EXPECT_LT(changed, 200);
}

TEST(Graph, doesNotGrowUnderNoiseAndDriftFromAMovingRobot) {
  const TestWorld world = TestWorld::rooms(20.0, 5.0, 5);
  std::mt19937 random(5);
  std::normal_distribution<double> drift(0.0, 0.003);
  Topology topology({}, testFootprint());
  std::vector<Pose2> loop = wander(world, 100, 5);
  std::vector<Pose2> back(loop.rbegin(), loop.rend());
  Pose2 error;
  std::vector<int> counts;
  for (int lap = 0; lap < 6; ++lap) {
    for (const Pose2& pose : lap % 2 ? back : loop) {
      error.x += drift(random) * std::sqrt(0.4);
      error.y += drift(random) * std::sqrt(0.4);
      topology.integrate(world.noisyScan(pose, 0.02, random), {pose.x + error.x, pose.y + error.y, pose.yaw});
      topology.update();
    }
    counts.push_back(topology.update().vertices);
  }
  EXPECT_LT(counts.back(), 1.3 * counts[1] + 5) << counts[1] << " -> " << counts.back();
}

/// The vertices by the corner of the box: one or two, as its grown corner is round.
std::set<int> namesNear(const Topology& topology, const Eigen::Vector2d& corner) {
  std::set<int> names;
  for (const Vertex& v : topology.graph().vertices()) {
    if ((v.position - corner).norm() < 0.35) names.insert(v.id);
  }
  return names;
}

TEST(Graph, cornersKeepTheirNames) {
  TestWorld world(12.0, 12.0);
  world.setBox(5.0, 5.0, 6.0, 6.0);
  Topology topology({}, testFootprint());
  std::set<int> first;
  for (int i = 0; i < 60; ++i) {
    const Pose2 pose{3.0 + 0.05 * i, 3.5, 0.0};
    topology.integrate(world.scan(pose), pose);
    topology.update();
    if (i == 30) first = namesNear(topology, {4.79, 4.79});
  }
  ASSERT_FALSE(first.empty());
  const std::set<int> last = namesNear(topology, {4.79, 4.79});
  EXPECT_TRUE(std::includes(last.begin(), last.end(), first.begin(), first.end()));
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
