// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "parley_exchange/channel.h"
#include "parley_exchange/exchange.h"
#include "parley_exchange/loopback.h"
#include "parley_exchange/udp_transport.h"

namespace parley {
namespace {

/// Receives until something came or two seconds are over.
std::vector<Bytes> await(Transport& transport) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  while (std::chrono::steady_clock::now() < deadline) {
    std::vector<Bytes> datagrams = transport.receive(0.0);
    if (!datagrams.empty()) return datagrams;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return {};
}

/// What arrives of numbered datagrams that go through a channel, one every 10 ms.
std::vector<Bytes> through(const ChannelSettings& settings, int count, const std::function<bool(double)>& reaches = {}) {
  LoopbackBus bus;
  const std::unique_ptr<Transport> receiver = bus.connect();
  Channel channel(bus.connect(), settings, reaches);
  std::vector<Bytes> arrived;
  for (int i = 0; i < count + 200; ++i) {
    if (i < count) channel.send({static_cast<std::uint8_t>(i >> 8), static_cast<std::uint8_t>(i & 0xff)}, 0.01 * i);
    channel.receive(0.01 * i);
    const std::vector<Bytes> now = receiver->receive(0.01 * i);
    arrived.insert(arrived.end(), now.begin(), now.end());
  }
  return arrived;
}

UdpSettings localUdp() {
  UdpSettings settings;
  settings.local = "127.0.0.1";
  settings.broadcast = "127.255.255.255";
  return settings;
}

}  // namespace

TEST(Loopback, reachesAllButTheSender) {
  LoopbackBus bus;
  auto a = bus.connect(), b = bus.connect(), c = bus.connect();
  EXPECT_TRUE(a->send({1}, 0.0));
  b->send({2}, 0.0);
  EXPECT_EQ(c->receive(0.0), (std::vector<Bytes>{{1}, {2}}));
  EXPECT_EQ(a->receive(0.0), (std::vector<Bytes>{{2}}));
  EXPECT_TRUE(a->receive(0.0).empty());
  c.reset();
  a->send({3}, 0.0);
  EXPECT_EQ(b->receive(0.0), (std::vector<Bytes>{{1}, {3}}));
  for (int i = 0; i < 2000; ++i) a->send({4}, 0.0);
  EXPECT_EQ(b->receive(0.0).size(), 1000U) << "what nobody takes is bounded";
  EXPECT_EQ(a->problem(), "");
}

TEST(Channel, isTransparentByDefault) { EXPECT_EQ(through({}, 300).size(), 300U); }

TEST(Channel, losesItsShareAndTheSameOneForTheSameSeed) {
  ChannelSettings settings;
  settings.loss = 0.8;
  const auto first = through(settings, 5000);
  EXPECT_NEAR(static_cast<double>(first.size()), 1000.0, 90.0);
  EXPECT_EQ(through(settings, 5000), first);
  settings.seed = 2;
  EXPECT_NE(through(settings, 5000), first);
}

TEST(Channel, losesInBursts) {
  ChannelSettings settings;
  settings.burst_begin = 0.02;
  settings.burst_end = 0.1;
  const auto arrived = through(settings, 6000);
  EXPECT_NEAR(static_cast<double>(arrived.size()) / 6000.0, 0.1 / 0.12, 0.06);
  int gaps = 0;
  for (std::size_t i = 1; i < arrived.size(); ++i) {
    gaps += (arrived[i][0] * 256 + arrived[i][1]) - (arrived[i - 1][0] * 256 + arrived[i - 1][1]) > 1 ? 1 : 0;
  }
  EXPECT_NEAR((6000.0 - static_cast<double>(arrived.size())) / gaps, 10.0, 4.0) << "mean length of a burst";
}

TEST(Channel, delaysReordersDuplicatesAndCorrupts) {
  ChannelSettings settings;
  settings.delay = 0.1;
  settings.jitter = 0.2;
  settings.duplication = 0.5;
  settings.corruption = 0.1;
  const auto arrived = through(settings, 2000);
  EXPECT_NEAR(static_cast<double>(arrived.size()), 3000.0, 120.0);
  EXPECT_FALSE(std::is_sorted(arrived.begin(), arrived.end()));
  ChannelSettings slow;
  slow.delay = 10.0;
  EXPECT_TRUE(through(slow, 100).empty());
}

TEST(Channel, limitsTheRateAndTheRange) {
  ChannelSettings settings;
  settings.rate = 100.0;  // half of what is sent
  EXPECT_NEAR(static_cast<double>(through(settings, 1000).size()), 550.0, 20.0);
  EXPECT_EQ(through({}, 1000, [](double now) { return now < 2.0; }).size(), 200U);
}

TEST(Channel, refusesWhatCannotBe) {
  LoopbackBus bus;
  ChannelSettings settings;
  settings.loss = 1.5;
  EXPECT_THROW(Channel(bus.connect(), settings), std::invalid_argument);
  settings.loss = 0.0;
  settings.delay = -1.0;
  EXPECT_THROW(Channel(bus.connect(), settings), std::invalid_argument);
}

TEST(Udp, unicastReachesTheList) {
  const auto a = openUdp(localUdp());
  UdpSettings settings = localUdp();
  settings.peers = {"127.0.0.1:" + std::to_string(boundPort(*a))};
  const auto b = openUdp(settings);
  EXPECT_TRUE(a->receive(0.0).empty()) << "and does not wait";
  ASSERT_TRUE(b->send({1, 2, 3}, 0.0)) << b->problem();
  EXPECT_EQ(await(*a), (std::vector<Bytes>{{1, 2, 3}}));
}

TEST(Udp, broadcastReachesAllOnThePort) {
  UdpSettings settings = localUdp();
  settings.local = "0.0.0.0";
  settings.share_port = true;
  settings.port = boundPort(*openUdp(localUdp()));
  const auto a = openUdp(settings), b = openUdp(settings);
  ASSERT_TRUE(a->send({7}, 0.0)) << a->problem();
  EXPECT_EQ(await(*b), (std::vector<Bytes>{{7}}));
}

TEST(Udp, refusesBadSettingsWithAReason) {
  const auto messageOf = [](const UdpSettings& settings) -> std::string {
    try {
      openUdp(settings);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  UdpSettings settings = localUdp();
  settings.peers = {"robot"};
  EXPECT_NE(messageOf(settings).find("'robot' is no IPv4 address"), std::string::npos);
  settings.peers = {"127.0.0.1:0"};
  EXPECT_NE(messageOf(settings).find("no port"), std::string::npos);
  settings.peers = {"127.0.0.1:70000"};
  EXPECT_NE(messageOf(settings), "");
  settings = localUdp();
  const auto other = openUdp(settings);
  settings.port = boundPort(*other);
  EXPECT_NE(messageOf(settings).find("in use"), std::string::npos) << messageOf(settings);
  settings.local = "192.0.2.1";
  EXPECT_NE(messageOf(settings), "");
}

TEST(Udp, twoExchangesMeet) {
  const auto first = openUdp(localUdp());
  UdpSettings settings = localUdp();
  settings.peers = {"127.0.0.1:" + std::to_string(boundPort(*first))};
  const auto second = openUdp(settings);
  ExchangeIdentity identity;
  identity.key = simulatedTeamKey(1);
  identity.footprint = {0.8, 0.4};
  identity.limits = {2.0, 1.5, 2.0, 4.0};
  identity.name = "one";
  Exchange one(ExchangeOptions(), identity);
  identity.name = "two";
  Exchange two(ExchangeOptions(), identity);
  two.setOdometry({}, DriveState::kStopped);
  for (const Bytes& packet : two.step(1.0).packets) second->send(packet, 1.0);
  for (const Bytes& packet : await(*first)) one.addPacket(packet, 1.0);
  ASSERT_EQ(one.peers(1.0).size(), 1U);
  EXPECT_EQ(one.peers(1.0)[0].name, "two");
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
