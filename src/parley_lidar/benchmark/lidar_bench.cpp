// SPDX-License-Identifier: BSD-3-Clause
// Time of one LidarStage::process. The counters are over single calls, in processor time, so that what else runs on the
// machine does not count.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>

#include "parley_lidar/lidar_stage.h"
#include "world.h"

namespace parley::test {
namespace {

constexpr int kScans = 50;

World office() {
  World world{box({-4.0, -3.0}, {5.0, 3.5}), {}};
  for (int i = 0; i < 8; ++i) {
    const Pose2 start{3.5 * std::cos(0.8 * i), 2.5 * std::sin(0.8 * i), 0.7 * i};
    world.bodies.push_back({rectangle(0.8, 0.4), driving(start, i % 2 == 0 ? 0.0 : 0.3, 0.5)});
  }
  return world;
}

/// Processor time of this thread. [us]
double processorTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// Goes through the readings again and again, from a fresh start each time.
template <class Reading>
void run(benchmark::State& state, const std::vector<Reading>& readings, const OdometryAt& robot, const LidarMount& mount) {
  LidarStage stage({}, kRobot, mount);
  std::vector<OdometryBuffer> odometry;
  for (const Reading& reading : readings) odometry.push_back(recorded(robot, reading.stamp, reading.stamp + 0.12));
  const std::vector<KnownTeammate> teammates{{{1.0, 1.0, 0.3}, kRobot, 0.1}, {{-1.0, 2.0, 0.3}, kRobot, 0.1}};
  std::vector<double> times;
  std::size_t i = 0;
  for (auto _ : state) {
    if (i % readings.size() == 0) stage.reset();
    const double start = processorTime();
    benchmark::DoNotOptimize(stage.process(readings[i % readings.size()], odometry[i % readings.size()], teammates));
    times.push_back(processorTime() - start);
    ++i;
  }
  std::sort(times.begin(), times.end());
  state.counters["p50_us"] = times[times.size() / 2];
  state.counters["p99_us"] = times[times.size() * 99 / 100];
}

OdometryAt rocking() {
  return [](double t) {
    return Odometry{t, integrateTwist({-1.0, -1.0, 0.3}, 1.0, 0.4, t), {}, 0.02 * std::sin(5.0 * t), 0.02 * std::cos(6.0 * t)};
  };
}

/// duration 0: beams at one time, level, as the simulator gives them; else each beam at its time on a rocking robot.
void planar(benchmark::State& state) {
  std::mt19937 random(1);
  Lidar lidar;
  lidar.beams = static_cast<int>(state.range(0));
  lidar.duration = 1e-3 * static_cast<double>(state.range(1));
  lidar.noise = 0.02;
  const OdometryAt robot = state.range(1) == 0 ? level(driving({-1.0, -1.0, 0.3}, 1.0, 0.4)) : rocking();
  std::vector<RangeScan> scans;
  for (int i = 0; i < kScans; ++i) scans.push_back(scanned(office(), robot, lidar, 0.1 * i, random));
  run(state, scans, robot, lidar.mount);
}
BENCHMARK(planar)->ArgNames({"beams", "ms"})->Args({360, 0})->Args({720, 0})->Args({720, 95})->Unit(benchmark::kMicrosecond);

void spatial(benchmark::State& state) {
  std::mt19937 random(1);
  Lidar lidar;
  lidar.duration = 0.1;
  lidar.noise = 0.02;
  std::vector<LidarCloud> clouds;
  for (int i = 0; i < kScans; ++i) {
    clouds.push_back(swept(office(), rocking(), lidar, 0.1 * i, static_cast<int>(state.range(0)), random));
  }
  run(state, clouds, rocking(), lidar.mount);
}
BENCHMARK(spatial)->ArgName("points")->Arg(20000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace parley::test

BENCHMARK_MAIN();
