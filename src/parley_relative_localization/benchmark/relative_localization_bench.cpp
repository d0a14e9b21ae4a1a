// SPDX-License-Identifier: BSD-3-Clause
// What a match costs: surfaces of robots that see each other, a search without a guess, a whole step of an encounter, the
// codec. Median and 99th percentile of processor time of the one thread: other load must not count.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>

#include "global_search.h"
#include "rooms.h"

namespace parley {
namespace {

double now() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Runs `work` for each iteration and reports quantiles.
template <class Work>
void measure(benchmark::State& state, const Work& work) {
  std::vector<double> times;
  for (auto _ : state) {
    const double start = now();
    work();
    times.push_back(1e3 * (now() - start));
  }
  std::sort(times.begin(), times.end());
  state.counters["p50_ms"] = times[times.size() / 2];
  state.counters["p99_ms"] = times[static_cast<std::size_t>(0.99 * static_cast<double>(times.size() - 1))];
}

SurfaceMap roomFrom(const std::vector<Pose2>& places, unsigned seed) {
  std::mt19937 random(seed);
  return SurfaceMap(test::scansFrom(test::segmentWorld(test::distinctiveRoom()), places, {}, {}, random));
}

const std::vector<Pose2> kHere{{2.0, 3.0, 0.3}, {2.8, 3.2, 0.5}, {3.6, 3.4, 0.2}, {4.2, 3.6, 0.4}};
const std::vector<Pose2> kThere{{6.0, 3.0, 2.5}, {5.4, 3.3, 2.8}, {5.0, 3.6, 3.0}, {4.5, 3.0, 3.1}};

void mutualMatch(benchmark::State& state) {
  const SurfaceMap own = roomFrom(kHere, 1), peer = roomFrom(kThere, 2);
  measure(state, [&] {
    benchmark::DoNotOptimize(checkSurfaces(own, peer, {{0.05, 0.05, 0.03}, {4.0, 3.0}, 1e3 * Eigen::Matrix3d::Identity()}, {}));
  });
}

void globalSearch(benchmark::State& state) {
  const SurfaceMap own = roomFrom(kHere, 1), peer = roomFrom(kThere, 2);
  measure(state, [&] { benchmark::DoNotOptimize(searchGlobally(own, peer, {})); });
}

void submap(benchmark::State& state) {
  std::mt19937 random(1);
  const auto scans = test::scansFrom(test::segmentWorld(test::distinctiveRoom()), kHere, {}, {}, random);
  measure(state, [&] { benchmark::DoNotOptimize(SurfaceMap(scans)); });
}

void codec(benchmark::State& state) {
  std::mt19937 random(1);
  const ObstacleScan scan = test::simulatedScan(test::segmentWorld(test::distinctiveRoom()), {}, kHere[0], 0.0, {}, random);
  const PolarScan polar = polarScanOf(scan, false);
  measure(state, [&] { benchmark::DoNotOptimize(decodeScan(encodeScan(polar))); });
  state.counters["bytes"] = static_cast<double>(encodeScan(polar).size());
}

BENCHMARK(mutualMatch)->Unit(benchmark::kMillisecond);
BENCHMARK(globalSearch)->Unit(benchmark::kMillisecond);
BENCHMARK(submap)->Unit(benchmark::kMillisecond);
BENCHMARK(codec)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace parley

BENCHMARK_MAIN();
