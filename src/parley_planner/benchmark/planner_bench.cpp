// SPDX-License-Identifier: BSD-3-Clause
// Whole plans along a drive through a corridor with corners: mean by the benchmark, p99 and most as counters, CPU time.
// One optimisation of a drive round a corner, and one with all that makes a better drive of it.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "drive_refinement.h"
#include "scenes.h"

namespace {

using parley::World;

void planAlongADrive(benchmark::State& state) {
  World world(20, 14, true);
  world.fill(1, 1, 8, 2.6, false);
  world.fill(6.4, 1, 8, 9, false);
  world.fill(6.4, 7.4, 19, 9, false);
  parley::RunSettings settings;
  settings.start = {1.8, 1.8, 0.0};
  settings.goal = {18.2, 8.2};
  settings.options.sight_law = state.range(0) != 0;
  settings.options.trajectory_optimization = state.range(1) != 0;
  std::vector<double> times;  // [ms]
  for (auto _ : state) {
    const parley::RunResult result = parley::drive(world, settings);
    double sum = 0.0;
    for (const double t : result.plan_ms) sum += t;
    state.SetIterationTime(1e-3 * sum / static_cast<double>(result.plan_ms.size()));
    times.insert(times.end(), result.plan_ms.begin(), result.plan_ms.end());
  }
  std::sort(times.begin(), times.end());
  state.counters["p99_ms"] = times[times.size() * 99 / 100];
  state.counters["max_ms"] = times.back();
}

BENCHMARK(planAlongADrive)
    ->ArgNames({"sight_law", "optimization"})
    ->ArgsProduct({{0, 1}, {0, 1}})
    ->UseManualTime()
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

void optimizeADrive(benchmark::State& state) {
  using namespace parley;
  World world(10, 10, true);
  world.fill(1.0, 2.0, 6.0, 3.6, false);
  world.fill(4.4, 2.0, 6.0, 9.0, false);
  const LocalMap map = seenMap(world);
  const Surroundings surroundings(map, {}, {}, {});
  const std::vector<TrackedObject> tracks;
  const DriveScene scene{surroundings, tracks, 1.5, 0.1, {}, 0.08};
  const Margins margins{0.05, 0.04, 0.2};
  const TrajectoryPoint start{0.0, {2.4, 2.8, 0.0}, {1.5, 0.0}};
  const DriveGenerator generator(robotFootprint(), robotLimits(), 0.05);
  SmoothingOptions smoothing;
  smoothing.push_distance = 0.6;
  const Path corners = {{2.4, 2.8}, {5.2, 2.8}, {5.2, 5.0}};
  DrivenPath first{smoothed(corners, {start.pose, 1.5, 0.0}, surroundings.obstacles(), smoothing), {}, {}};
  first.drive = generator.along(first.path, start, false, scene, margins, {});
  const TrajectoryOptimizer optimizer(optimizerOptions({}), robotFootprint(), robotLimits());
  const DriveRefinement refinement(optimizerOptions({}), robotFootprint(), robotLimits());
  const SampledTrajectory none;
  const ManoeuvreTask task{corners, start, none, scene, margins, 0.6, nullptr, surroundings.obstacles()};
  for (auto _ : state) {
    if (state.range(0) != 0) {
      benchmark::DoNotOptimize(refinement.refined(task, first, generator));
    } else {
      benchmark::DoNotOptimize(
          optimizer.optimized({first.path, first.drive.drive.points, {}, {}, scene, margins, surroundings.obstacles(), 0.6}));
    }
  }
}

BENCHMARK(optimizeADrive)->ArgName("with_drive")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
