// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <limits>
#include <vector>

#include "parley_control/controller.h"

namespace {

using namespace parley;

/// What a lidar with 4 m of sight sees from the middle of a corridor of some width. [m]
ObstacleScan corridorScan(double width) {
  ObstacleScan scan;
  scan.range_max = 4.0;
  scan.ranges.resize(720);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = 0.5 * width / std::abs(std::sin(scan.bearingOf(i)));
    scan.ranges[i] = range < scan.range_max ? static_cast<float>(range) : std::numeric_limits<float>::infinity();
  }
  return scan;
}

/// Steps of a robot that drives on a bend of 0.2 rad/s at 2 m/s in a corridor, the widths in cm.
void controlStep(benchmark::State& state) {
  Controller controller(ControlOptions{}, {0.8, 0.4}, {2.0, kPi / 2.0, 2.0, 3.0});
  ObstacleScan scan = corridorScan(0.01 * static_cast<double>(state.range(0)));
  std::vector<TrajectoryPoint> points;
  for (int i = 0; i < 2000; ++i) points.push_back({0.05 * i, integrateTwist({}, 2.0, 0.2, 0.05 * i), {2.0, 0.2}});
  const SampledTrajectory trajectory(std::move(points));
  double now = 0.0;
  for (auto _ : state) {
    now = now < 90.0 ? now + 0.02 : 0.0;
    const Odometry odometry{now, integrateTwist({}, 2.0, 0.2, now), {2.0, 0.2}, 0.0, 0.0};
    scan.stamp = now;
    ControlRequest request;
    request.now = now;
    request.odometry = &odometry;
    request.trajectory = &trajectory;
    request.trajectory_stamp = now;
    request.scan = &scan;
    request.T_odom_scan = odometry.pose;
    benchmark::DoNotOptimize(controller.step(request));
  }
}
BENCHMARK(controlStep)->Arg(60)->Arg(120)->Arg(300)->Arg(1000)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
