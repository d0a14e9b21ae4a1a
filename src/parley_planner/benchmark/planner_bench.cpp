// SPDX-License-Identifier: BSD-3-Clause
// Whole plans along a drive through a corridor with corners: mean by the benchmark, p99 and most as counters, CPU time.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "closed_loop.h"

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

BENCHMARK(planAlongADrive)->ArgName("sight_law")->Arg(0)->Arg(1)->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
