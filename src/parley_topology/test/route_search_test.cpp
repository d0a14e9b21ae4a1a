// SPDX-License-Identifier: BSD-3-Clause
#include "route_search.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "indexed_heap.h"

namespace parley {
namespace {

/// A random graph in empty, seen or unseen space, with vertices that are tangent to everything.
struct RandomCase {
  explicit RandomCase(unsigned seed) : random(seed) {
    std::uniform_real_distribution<double> at(-6.0, 6.0), unit(0.0, 1.0);
    std::uniform_int_distribution<int> count(1, 14);
    for (int k = 0; k < 6; ++k) obstacle(at(random), at(random));
    refreshField(map, shape);
    const int n = count(random);
    for (int i = 0; i < n; ++i) {
      Vertex vertex;
      do {
        vertex.position = {at(random), at(random)};
      } while (!passable(vertex.position));
      vertex.previous = vertex.next = Eigen::Vector2d::Zero();
      graph.addVertex(vertex);
    }
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < i; ++j) {
        if (unit(random) > 0.6 || !sight.walk(graph.vertex(i).position, graph.vertex(j).position).open) continue;
        Edge edge;
        edge.from = i;
        edge.to = j;
        edge.length = (graph.vertex(i).position - graph.vertex(j).position).norm();
        graph.addEdge(edge);
      }
    }
    do {
      query.start = {at(random), at(random)};
    } while (!passable(query.start));
    do {
      query.goal = {at(random), at(random)};
    } while (!passable(query.goal));
    if (seed % 3 == 0) {
      for (int i = 0; i < n; ++i) query.allowed.push_back(unit(random) < 0.7);
    }
  }

  void obstacle(double x, double y) {
    for (int cy = map.cellOf(y); cy < map.cellOf(y) + 30; ++cy) {
      for (int cx = map.cellOf(x); cx < map.cellOf(x) + 30; ++cx) {
        Tile& tile = *map.ensure(tileOf(cx), tileOf(cy));
        tile.flags[offsetOf(cx, cy)] |= kSeen | kOwn;
        tile.changed_cells = 0xffff;
        map.note(tile);
      }
    }
  }
  bool passable(const Eigen::Vector2d& p) const { return map.flags(map.cellOf(p.x()), map.cellOf(p.y())) & kPassable; }

  /// Bellman-Ford over all edges, start and goal joined to everything in sight.
  double oracle() {
    const int n = graph.slotCount(), start = n, goal = n + 1;
    struct Arc {
      int a, b;
      double cost;
    };
    std::vector<Arc> arcs;
    const auto usable = [&](int i) { return i >= n || query.allowed.empty() || query.allowed[static_cast<std::size_t>(i)]; };
    const auto position = [&](int i) { return i == start ? query.start : i == goal ? query.goal : graph.vertex(i).position; };
    for (const Edge& edge : graph.edges())
      arcs.push_back({edge.from, edge.to, sight.measure(position(edge.from), position(edge.to)).cost});
    for (int i = 0; i <= n; ++i) {
      for (int end : {start, goal}) {
        if (i != end && sight.walk(position(i), position(end)).open)
          arcs.push_back({i, end, sight.measure(position(i), position(end)).cost});
      }
    }
    std::vector<double> cost(static_cast<std::size_t>(n + 2), std::numeric_limits<double>::infinity());
    cost[static_cast<std::size_t>(start)] = 0.0;
    for (int round = 0; round < n + 2; ++round) {
      for (const Arc& arc : arcs) {
        if (!usable(arc.a) || !usable(arc.b)) continue;
        double& a = cost[static_cast<std::size_t>(arc.a)];
        double& b = cost[static_cast<std::size_t>(arc.b)];
        a = std::min(a, b + arc.cost);
        b = std::min(b, a + arc.cost);
      }
    }
    return cost[static_cast<std::size_t>(goal)];
  }

  std::mt19937 random;
  TopologyOptions options;
  FieldShape shape{0.22, 1.0, 0.1};
  TiledMap map{0.05, 100.0, 1000};
  Sight sight{map, options, shape};
  VisibilityGraph graph;
  RouteQuery query;
};

}  // namespace

TEST(RouteSearch, bothSearchesFindTheCheapestWay) {
  int found = 0, detours = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    RandomCase c(seed);
    const double expected = c.oracle();
    const FoundRoute astar = searchAstar(c.graph, c.sight, c.query);
    const FoundRoute depth_first = searchDepthFirst(c.graph, c.sight, c.query, 1000000);
    ASSERT_EQ(astar.exists(), std::isfinite(expected)) << "seed " << seed;
    ASSERT_EQ(depth_first.exists(), std::isfinite(expected)) << "seed " << seed;
    if (!astar.exists()) continue;
    ++found;
    detours += astar.points.size() > 2 ? 1 : 0;
    EXPECT_NEAR(astar.cost, expected, 1e-9) << "seed " << seed;
    EXPECT_NEAR(depth_first.cost, expected, 1e-9) << "seed " << seed;
    EXPECT_EQ(astar.points.front(), c.query.start);
    EXPECT_EQ(astar.points.back(), c.query.goal);
    for (std::size_t i = 0; i + 1 < astar.points.size(); ++i)
      EXPECT_TRUE(c.sight.walk(astar.points[i], astar.points[i + 1]).open);
  }
  EXPECT_GT(found, 300);
  EXPECT_GT(detours, 50);
}

TEST(RouteSearch, depthFirstStopsAtItsBound) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    RandomCase c(seed);
    const FoundRoute bounded = searchDepthFirst(c.graph, c.sight, c.query, 2);
    EXPECT_TRUE(!bounded.exists() || bounded.cost >= c.oracle() - 1e-9) << "seed " << seed;
  }
}

TEST(RouteSearch, startAtTheGoalIsARouteOfNoLength) {
  RandomCase c(1);
  c.query.goal = c.query.start;
  const FoundRoute route = searchAstar(c.graph, c.sight, c.query);
  ASSERT_TRUE(route.exists());
  EXPECT_EQ(route.points.size(), 2U);
  EXPECT_EQ(route.length, 0.0);
}

TEST(IndexedHeap, sortsWithKeysThatFall) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 50; ++round) {
    IndexedHeap heap(100);
    std::vector<double> keys(100, 2.0);
    for (int k = 0; k < 300; ++k) {
      const int item = static_cast<int>(unit(random) * 100);
      const double key = unit(random);
      heap.put(item, key);
      keys[static_cast<std::size_t>(item)] = std::min(keys[static_cast<std::size_t>(item)], key);
    }
    double last = -1.0;
    int count = 0;
    for (; !heap.empty(); ++count) {
      const double key = heap.leastKey();
      EXPECT_GE(key, last);
      EXPECT_EQ(keys[static_cast<std::size_t>(heap.pop())], key);
      last = key;
    }
    EXPECT_EQ(count, 100 - std::count(keys.begin(), keys.end(), 2.0));
  }
}

TEST(IndexedHeap, equalKeysComeByNumber) {
  IndexedHeap heap(8);
  for (int item : {5, 3, 7, 1}) heap.put(item, 1.0);
  for (int item : {1, 3, 5, 7}) EXPECT_EQ(heap.pop(), item);
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
