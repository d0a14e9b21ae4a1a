// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "parley_exchange/packet_codec.h"
#include "parley_exchange/seal.h"
#include "random_content.h"
#include "team.h"

namespace {

using namespace parley;

std::vector<Bytes> packets() {
  std::vector<Bytes> result;
  for (std::uint64_t seed = 0; seed < 64; ++seed) result.push_back(encodePacket(RandomContent(seed).packet()));
  return result;
}

void decode(benchmark::State& state) {
  const std::vector<Bytes> input = packets();
  std::size_t i = 0, bytes = 0;
  for (auto _ : state) {
    bytes += input[i % input.size()].size();
    benchmark::DoNotOptimize(decodePacket(input[i++ % input.size()]));
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
}
BENCHMARK(decode)->Unit(benchmark::kMicrosecond);

void encode(benchmark::State& state) {
  std::vector<PacketContent> input;
  for (const Bytes& bytes : packets()) input.push_back(decodePacket(bytes));
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(encodePacket(input[i++ % input.size()]));
}
BENCHMARK(encode)->Unit(benchmark::kMicrosecond);

void sealAndOpen(benchmark::State& state) {
  Sealer sealer(simulatedTeamKey(1));
  const Bytes plain(1000, 7);
  std::uint32_t counter = 0;
  for (auto _ : state) {
    const FrameHeader header{1, 1, ++counter};
    benchmark::DoNotOptimize(sealer.open(header, sealer.seal(header, plain)));
  }
}
BENCHMARK(sealAndOpen)->Unit(benchmark::kMicrosecond);

/// One robot's step of 50 ms, with what it receives, in a team where all hear all and each has fifty walls.
void step(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  Team team;
  for (std::size_t i = 0; i < count; ++i) team.add();
  team.connectAll();
  std::vector<OwnContour> walls;
  for (int k = 0; k < 50; ++k) walls.push_back(wall(k, 1.0 + 0.01 * k, 0.2 * k - 5.0, 3.0));
  const auto drive = [&](std::size_t i) {
    team[i].setOdometry(standing({}, team.timeOf(i)), DriveState::kStopped);
    team[i].publishContours(walls, team.timeOf(i));
  };
  team.run(10.0, drive);
  for (auto _ : state) team.run(0.05, drive);
  state.SetItemsProcessed(static_cast<std::int64_t>(count) * state.iterations());
}
BENCHMARK(step)->Arg(2)->Arg(8)->Arg(64)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
