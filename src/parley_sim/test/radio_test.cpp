// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/radio.h"

#include <gtest/gtest.h>

#include "worlds.h"

namespace parley::sim {
namespace {

Scenario scenarioWith(const RadioSpec& radio, int robots) {
  Scenario scenario;
  for (int i = 0; i < robots; ++i) {
    scenario.robots.push_back(robotAt("robot_" + std::to_string(i), {}, {0, 0}));
    scenario.robots.back().radio = radio;
  }
  return scenario;
}

std::vector<RadioNode> inARow(int robots, double gap) {
  std::vector<RadioNode> nodes;
  for (int i = 0; i < robots; ++i) nodes.push_back({{1.0 + gap * i, 2.0}, true});
  return nodes;
}

TEST(RadioTest, broadcastReachesAllInRangeAfterTheLatency) {
  const World world = emptyWorld();
  RadioSpec spec;
  spec.range = 5.0;
  Radio radio(scenarioWith(spec, 4), world);
  const auto nodes = inARow(4, 2.4);  // the last is too far from the first
  radio.send(0, Payload(72, 7), 1.0, nodes);
  EXPECT_TRUE(radio.deliver(1.009, nodes)[1].empty());
  const auto arrived = radio.deliver(1.031, nodes);
  EXPECT_TRUE(arrived[0].empty());
  ASSERT_EQ(arrived[1].size(), 1u);
  EXPECT_EQ(arrived[1][0], Payload(72, 7));
  EXPECT_EQ(arrived[2].size(), 1u);
  EXPECT_TRUE(arrived[3].empty());
  const RadioCounters& counters = radio.counters();
  EXPECT_EQ(counters.tx_bytes[0], 100);
  EXPECT_EQ(counters.rx_bytes[1], 100);
  EXPECT_EQ(counters.rx_bytes[3], 0);
  EXPECT_EQ(counters.expected, 2);
  EXPECT_EQ(counters.received, 2);
}

TEST(RadioTest, lossesAndDelaysHaveTheAskedStatistics) {
  const World world = emptyWorld();
  RadioSpec spec;
  spec.success_rate = 0.3;
  spec.latency = 0.05;
  spec.jitter = 0.02;
  spec.bandwidth = 0.0;
  Radio radio(scenarioWith(spec, 2), world);
  const auto nodes = inARow(2, 1.0);
  const int packets = 5000;
  double mean_delay = 0.0, least = 1.0, most = 0.0;
  int received = 0;
  for (int i = 0; i < packets; ++i) {
    const double sent = 0.2 * i;
    radio.send(0, Payload(10), sent, nodes);
    for (double t = 0.0; t <= 0.1; t += 0.001) {
      if (radio.deliver(sent + t, nodes)[1].empty()) continue;
      ++received;
      mean_delay += t;
      least = std::min(least, t);
      most = std::max(most, t);
    }
  }
  EXPECT_NEAR(double(received) / packets, 0.3, 0.02);
  EXPECT_NEAR(mean_delay / received, 0.0505, 0.002);
  EXPECT_GE(least, 0.03 - 1e-9);
  EXPECT_LE(most, 0.0711);
  EXPECT_EQ(radio.counters().expected, packets);
  EXPECT_EQ(radio.counters().received, received);
}

TEST(RadioTest, bandwidthIsCapped) {
  const World world = emptyWorld();
  RadioSpec spec;
  spec.bandwidth = 10000.0;
  Radio radio(scenarioWith(spec, 2), world);
  const auto nodes = inARow(2, 1.0);
  for (int i = 0; i < 1000; ++i) radio.send(0, Payload(972), 0.01 * i, nodes);  // 100000 byte/s for 10 s
  const auto bytes = radio.counters().tx_bytes[0];
  EXPECT_LE(bytes, 10000 * 10 + 2500);
  EXPECT_GE(bytes, 10000 * 9);
  EXPECT_EQ(radio.counters().packets_sent + radio.counters().packets_over_bandwidth, 1000);
  EXPECT_EQ(radio.counters().expected, 1000);  // what never left its sender was missed all the same
}

TEST(RadioTest, wallsStopItOnlyWhereAskedTo) {
  const World world = drawnWorld(10, 4, 0.1, [](double x, double) { return std::abs(x - 2.0) < 0.1; });
  const auto nodes = inARow(2, 2.0);
  for (const bool line_of_sight : {false, true}) {
    RadioSpec spec;
    spec.line_of_sight = line_of_sight;
    Radio radio(scenarioWith(spec, 2), world);
    radio.send(0, Payload(1), 0.0, nodes);
    EXPECT_EQ(radio.deliver(1.0, nodes)[1].empty(), line_of_sight);
  }
}

TEST(RadioTest, nobodySendsOrHearsWhileOff) {
  const World world = emptyWorld();
  Radio radio(scenarioWith({}, 3), world);
  auto nodes = inARow(3, 1.0);
  nodes[1].on = false;
  radio.send(1, Payload(1), 0.0, nodes);
  EXPECT_EQ(radio.counters().packets_sent, 0);
  radio.send(0, Payload(1), 0.0, nodes);
  EXPECT_EQ(radio.counters().expected, 1);
  nodes[2].on = false;  // goes silent while the packet is under way
  const auto arrived = radio.deliver(1.0, nodes);
  EXPECT_TRUE(arrived[1].empty() && arrived[2].empty());
  EXPECT_EQ(radio.counters().received, 0);
}

TEST(RadioTest, anotherRobotChangesNobodysLuck) {
  const World world = emptyWorld();
  RadioSpec spec;
  spec.success_rate = 0.5;
  Radio two(scenarioWith(spec, 2), world), three(scenarioWith(spec, 3), world);
  const auto pair = inARow(2, 1.0), trio = inARow(3, 1.0);
  for (int i = 0; i < 200; ++i) {
    two.send(0, Payload(1), i, pair);
    three.send(0, Payload(1), i, trio);
    three.send(2, Payload(2), i, trio);
    const auto a = two.deliver(i + 0.5, pair)[1];
    const auto b = three.deliver(i + 0.5, trio)[1];
    EXPECT_EQ(a.size() == 1, std::find(b.begin(), b.end(), Payload(1)) != b.end()) << i;
  }
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
