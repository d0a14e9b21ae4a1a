// SPDX-License-Identifier: BSD-3-Clause
// What a scan, an update and a route cost in worlds of 40 and 150 m, explored before the clock starts. A robot drives back
// and forth through them with 2 cm of range noise. Processor time of the one thread: other load must not count.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <utility>

#include "../test/test_world.h"

namespace parley {
namespace {

double now() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Explored {
  explicit Explored(double side) : size(side), world(TestWorld::rooms(side, 5.0, 7)), topology({}, testFootprint()) {
    for (int pass = 0; pass < 6; ++pass) {  // from shifting places, until noise has nothing new to say
      const double shift = 0.1 * pass;
      for (double y = 0.4 + shift; y < size; y += 0.8) {
        for (double x = 0.4 + shift; x < size; x += 0.8) scanFrom({x, y, 0.3 * pass});
      }
      topology.update();
    }
  }

  bool scanFrom(const Pose2& pose) {
    if (!world.isClear(pose.position(), 0.3)) return false;
    topology.integrate(world.noisyScan(pose, 0.02, random), pose);
    return true;
  }

  Pose2 nextPose() {
    do {
      const Pose2 next = integrateTwist(pose_, 2.0, turn_, 0.2);
      const bool inside = next.x < 40.0 && next.y < 40.0;  // as much to see in either world
      if (inside && world.isClear(next.position(), 0.3)) {
        pose_ = next;
        turn_ = 0.3 * (unit(random) - 0.5);
      } else {
        pose_.yaw += 0.7 + unit(random);
      }
    } while (!world.isClear(pose_.position(), 0.3));
    return pose_;
  }

  Eigen::Vector2d clearPlace() {
    Eigen::Vector2d p;
    do {
      p = {size * unit(random), size * unit(random)};
    } while (!world.isClear(p, 0.35));
    return p;
  }

  double size;
  std::mt19937 random{7};
  std::uniform_real_distribution<double> unit{0.0, 1.0};
  TestWorld world;
  Topology topology;

 private:
  Pose2 pose_{1.5, 1.5, 0.5};
  double turn_ = 0.0;
};

void report(benchmark::State& state, std::vector<double> seconds, const TopologyResult& result) {
  if (seconds.empty()) return;
  std::sort(seconds.begin(), seconds.end());
  state.counters["p50_ms"] = 1e3 * seconds[seconds.size() / 2];
  state.counters["p99_ms"] = 1e3 * seconds[seconds.size() * 99 / 100];
  state.counters["vertices"] = result.vertices;
  state.counters["edges"] = result.edges;
}

/// Two scans and an update: what 10 Hz and 5 Hz make together. The time is of one scan and one update.
void scanAndUpdate(benchmark::State& state, Explored& e) {
  std::vector<double> seconds;
  TopologyResult result = e.topology.update();
  for (auto _ : state) {
    const Pose2 first = e.nextPose();
    e.scanFrom(first);
    const Pose2 pose = e.nextPose();
    const ObstacleScan scan = e.world.noisyScan(pose, 0.02, e.random);
    const double start = now();
    e.topology.integrate(scan, pose);
    result = e.topology.update();
    seconds.push_back(now() - start);
    state.SetIterationTime(seconds.back());
  }
  report(state, seconds, result);
}

void scanOnly(benchmark::State& state, Explored& e) {
  std::vector<double> seconds;
  for (auto _ : state) {
    const Pose2 pose = e.nextPose();
    const ObstacleScan scan = e.world.noisyScan(pose, 0.02, e.random);
    const double start = now();
    e.topology.integrate(scan, pose);
    seconds.push_back(now() - start);
    state.SetIterationTime(seconds.back());
  }
  report(state, seconds, e.topology.update());
}

/// Routes as they are asked for: after each update, to a goal that changes now and then.
void route(benchmark::State& state, Explored& e) {
  std::vector<double> seconds;
  Eigen::Vector2d goal = e.clearPlace();
  TopologyResult result;
  for (auto _ : state) {
    const Pose2 pose = e.nextPose();
    e.scanFrom(pose);
    result = e.topology.update();
    if (seconds.size() % 50 == 49) goal = e.clearPlace();
    const double start = now();
    benchmark::DoNotOptimize(e.topology.route(pose, goal));
    seconds.push_back(now() - start);
    state.SetIterationTime(seconds.back());
  }
  report(state, seconds, result);
}

void localMap(benchmark::State& state, Explored& e) {
  for (auto _ : state) benchmark::DoNotOptimize(e.topology.localMap({20.0, 20.0}, 10.0, 0.0));
}

/// Registers every benchmark in a world of `size` m, which is explored before.
void registerIn(Explored& world, int size) {
  using Verb = void (*)(benchmark::State&, Explored&);
  const std::pair<const char*, Verb> verbs[] = {{"scanOnly", scanOnly}, {"scanAndUpdate", scanAndUpdate}, {"route", route}};
  for (const auto& [name, verb] : verbs) {
    const auto run = [verb = verb, &world](benchmark::State& state) { verb(state, world); };
    benchmark::RegisterBenchmark((std::string(name) + "/" + std::to_string(size)).c_str(), run)
        ->Iterations(1000)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  parley::Explored small(40), large(150);
  parley::registerIn(small, 40);
  parley::registerIn(large, 150);
  benchmark::RegisterBenchmark("localMap", [&small](benchmark::State& state) {
    parley::localMap(state, small);
  })->Unit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
}
