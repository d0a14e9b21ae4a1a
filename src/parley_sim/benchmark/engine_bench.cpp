// SPDX-License-Identifier: BSD-3-Clause
// How fast the engine is without robots' minds: one simulated second of N robots that drive round in circles.
#include <benchmark/benchmark.h>

#include <cmath>

#include "parley_sim/planar_lidar.h"
#include "parley_sim/shortest_path.h"
#include "parley_sim/simulation.h"

namespace parley::sim {
namespace {

/// Rooms of 5 m with doors of 1.5 m, at 5 cm a cell.
World rooms() {
  GridFrame frame;
  frame.width = frame.height = 800;
  std::vector<std::uint8_t> solid;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const bool wall_x = x % 100 < 3 && (y % 100 < 35 || y % 100 > 65);
      const bool wall_y = y % 100 < 3 && (x % 100 < 35 || x % 100 > 65);
      solid.push_back(wall_x || wall_y ? 1 : 0);
    }
  }
  return {frame, solid};
}

Scenario fleet(int robots, LidarMode mode) {
  Scenario scenario;
  scenario.duration = 1e6;
  for (int i = 0; i < robots; ++i) {
    RobotSpec robot;
    robot.name = "robot_" + std::to_string(i);
    robot.start = {2.5 + 5.0 * (i % 8), 1.5 + 5.0 * (i / 8), 0.0};
    robot.lidar.mode = mode;
    scenario.robots.push_back(robot);
  }
  return scenario;
}

void simulatedSecond(benchmark::State& state, LidarMode mode) {
  const World world = rooms();
  Simulation simulation(fleet(static_cast<int>(state.range(0)), mode), world);
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.range(0)); ++i) simulation.command(i, {1.0, 1.0});
  for (auto _ : state) {
    for (int step = 0; step < 50; ++step) benchmark::DoNotOptimize(simulation.step());
  }
  state.counters["x_real_time"] = benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK_CAPTURE(simulatedSecond, planar, LidarMode::kPlanar)->Arg(1)->Arg(8)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulatedSecond, spatial, LidarMode::kSpatial)->Arg(1)->Arg(8)->Unit(benchmark::kMillisecond);

void planarScan(benchmark::State& state) {
  const World world = rooms();
  Scene scene;
  scene.world = &world;
  PlanarLidar lidar({}, RandomStream(1, "robot", "lidar"));
  double x = 2.5;
  for (auto _ : state) {
    benchmark::DoNotOptimize(lidar.scan(0.0, {x, 2.5, x}, scene, 0));
    x = x < 37.0 ? x + 0.01 : 2.5;
  }
}
BENCHMARK(planarScan)->Unit(benchmark::kMicrosecond);

void pathAcross(benchmark::State& state) {
  const World world = rooms();
  for (auto _ : state) benchmark::DoNotOptimize(shortestLength(world, {2.5, 2.5}, {37.5, 37.0}, 0.25));
}
BENCHMARK(pathAcross)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace parley::sim

BENCHMARK_MAIN();
