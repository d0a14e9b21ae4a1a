// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>

#include "body_codec.h"
#include "checks.h"
#include "parley_exchange/packet_codec.h"
#include "parley_exchange/seal.h"
#include "random_content.h"
#include "section_codec.h"
#include "team.h"

namespace parley {
namespace {

/// How many mutated packets to try; the build server's long run sets more.
int mutationCount() {
  const char* text = std::getenv("PARLEY_MUTATIONS");
  return text != nullptr ? std::atoi(text) : 50000;
}

ExchangeIdentity identity(const std::string& name, std::uint64_t key = 7) {
  ExchangeIdentity result;
  result.name = name;
  result.key = simulatedTeamKey(key);
  result.footprint = {0.8, 0.4};
  result.limits = {2.0, 1.5, 2.0, 4.0};
  return result;
}

Bytes mutated(Bytes bytes, RandomContent& random) {
  for (int i = random.whole(1, 6); i > 0 && !bytes.empty(); --i) {
    const auto at = static_cast<std::size_t>(random.whole(0, static_cast<int>(bytes.size()) - 1));
    switch (random.whole(0, 4)) {
      case 0:
        bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1U << random.whole(0, 7)));
        break;
      case 1:
        bytes[at] = static_cast<std::uint8_t>(random.word());
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), static_cast<std::uint8_t>(random.word()));
        break;
      default:
        bytes[at] = random.chance(0.5) ? 0xff : 0;
        break;
    }
  }
  return bytes;
}

/// A member of the team that sends whatever it likes.
class Insider {
 public:
  explicit Insider(RobotId id, std::uint32_t boot = 1) : id_(id), boot_(boot) {}
  Bytes seal(const Bytes& plain) { return sealer_.seal({id_, boot_, ++counter_}, plain); }
  Bytes seal(const PacketContent& content) { return seal(encodePacket(content)); }

 private:
  Sealer sealer_{simulatedTeamKey(7)};
  RobotId id_;
  std::uint32_t boot_;
  std::uint32_t counter_ = 0;
};

}  // namespace

TEST(Hostile, mutatedPacketsOfAMemberDoNoHarm) {
  ExchangeOptions options;
  options.max_packet_rate = 1000.0;
  Exchange exchange(options, identity("victim"));
  exchange.setOdometry({}, DriveState::kStopped);
  Insider insider(robotIdOf("insider"));
  RandomContent random(1);
  Bytes plain = encodePacket(random.packet());
  double now = 1.0;
  for (int i = 0; i < mutationCount(); ++i) {
    if (i % 8 == 0) plain = encodePacket(random.packet());
    Bytes bytes = mutated(plain, random);
    if (bytes.size() + kFrameBytes > kMaxDatagram) bytes.resize(kMaxDatagram - kFrameBytes);
    now += 0.002;
    exchange.addPacket(insider.seal(bytes), now);
    if (i % 100 == 0) exchange.step(now);
    if (i % 1000 != 0) continue;
    for (const RobotId origin : exchange.origins()) {
      exchange.contoursOf(origin);
      exchange.keyframesOf(origin, now);
    }
    for (const PeerState& peer : exchange.peers(now)) {
      const auto trajectory = exchange.trajectoryOf(peer.id, now);
      EXPECT_TRUE(!trajectory || trajectory->trajectory.length() < 1e5);
      const auto intent = exchange.intentOf(peer.id);
      EXPECT_TRUE(!intent || (!intent->intent.way.empty() && intent->intent.way.size() <= kMaxWay));
    }
    exchange.edges();
  }
  EXPECT_GT(exchange.counters().sections_malformed, 0);
  EXPECT_GT(exchange.counters().implausible, 0);
  EXPECT_LE(exchange.storedBytes(), static_cast<std::size_t>(options.max_total_bytes));
  EXPECT_LE(exchange.origins().size(), static_cast<std::size_t>(options.max_origins + 1));
}

TEST(Hostile, noiseAndPacketsWithoutTheKeyLeaveNothing) {
  Exchange exchange(ExchangeOptions(), identity("victim"));
  RandomContent random(2);
  Sealer outsider(simulatedTeamKey(8));
  for (int i = 0; i < 5000; ++i) {
    Bytes noise = random.bytes(static_cast<std::size_t>(random.whole(0, 1200)));
    if (!noise.empty() && random.chance(0.5)) noise[0] = kWireVersion;
    exchange.addPacket(noise, 1.0);
    exchange.addPacket(outsider.seal({random.word(), 1, 1}, encodePacket(random.packet())), 1.0);
  }
  EXPECT_EQ(exchange.counters().packets_accepted, 0);
  EXPECT_EQ(exchange.counters().dropped_format + exchange.counters().dropped_authentication, 10000);
  EXPECT_TRUE(exchange.peers(1.0).empty());
  EXPECT_EQ(exchange.storedBytes(), 0U);
}

TEST(Hostile, aFloodingMemberFillsItsShareAndNoMore) {
  ExchangeOptions options;
  options.max_packet_rate = 1000.0;
  options.max_total_bytes = 300000;
  Exchange exchange(options, identity("victim"));
  Insider insider(robotIdOf("insider"));
  RandomContent random(3);
  double now = 1.0;
  for (int i = 0; i < 6000; ++i) {
    PacketContent content;
    content.digest.push_back(random.digestEntry());
    RecordGroup group;
    group.origin = i % 2 == 0 ? random.word() : robotIdOf("insider");
    group.epoch = 1;
    for (std::uint32_t k = 0; k < 4; ++k) {
      Record record;
      record.kind = static_cast<RecordKind>(9);
      record.id = random.word() & 0xffffU;
      record.sequence = static_cast<std::uint32_t>(4 * i) + k + 1;
      record.body = random.bytes(200);
      group.records.push_back(record);
    }
    content.records = {group};
    exchange.addPacket(insider.seal(content), now);
    now += 0.01;
    if (i % 50 == 0) exchange.step(now);
  }
  EXPECT_GT(exchange.counters().records_refused, 0);
  EXPECT_LE(exchange.storedBytes(), 300000U);
  EXPECT_LE(exchange.origins().size(), static_cast<std::size_t>(options.max_origins));
  // There is still an ear for others.
  Insider other(robotIdOf("robot_5"));
  PacketContent hello;
  hello.beacon = random.beacon();
  hello.beacon->name = "robot_5";
  exchange.addPacket(other.seal(hello), now);
  EXPECT_EQ(exchange.peers(now).size(), 2U);
}

TEST(Hostile, anOriginsShareIsBounded) {
  ExchangeOptions options;
  options.max_packet_rate = 1000.0;
  Exchange exchange(options, identity("victim"));
  Insider insider(robotIdOf("insider"));
  double now = 1.0;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    PacketContent content;
    RecordGroup group{robotIdOf("insider"), 1, RecordStream::kMap, {}};
    Record record;
    record.kind = static_cast<RecordKind>(9);
    record.id = i;
    record.sequence = 3 * i + 1;  // holes on purpose
    record.body = Bytes(250, 1);
    group.records = {record};
    content.records = {group};
    exchange.addPacket(insider.seal(content), now += 0.01);
  }
  EXPECT_LE(exchange.storedBytes(), static_cast<std::size_t>(options.max_log_bytes));
}

TEST(Hostile, whatCannotBeTrueIsDroppedAndCounted) {
  Exchange exchange(ExchangeOptions(), identity("victim"));
  Insider insider(robotIdOf("insider"));
  RandomContent random(4);
  const auto implausibleAfter = [&](const PacketContent& content) {
    const std::int64_t before = exchange.counters().implausible;
    exchange.addPacket(insider.seal(content), 1.0);
    return exchange.counters().implausible - before;
  };
  PacketContent content;
  content.beacon = random.beacon();
  content.beacon->name = "somebody";
  EXPECT_EQ(implausibleAfter(content), 1) << "the name is not the sender's";
  content.beacon->name = "insider";
  content.beacon->limits.speed = 0.0;
  EXPECT_EQ(implausibleAfter(content), 1) << "cannot move";
  content.beacon->limits.speed = 1.0;
  EXPECT_EQ(implausibleAfter(content), 0);
  content = PacketContent();
  content.trajectory = TrajectoryMessage{DriveState::kDriving, 0.0, 0.25, {{0.0, 0.0, 0.0}, {50.0, 0.0, 0.0}}};
  EXPECT_EQ(implausibleAfter(content), 1) << "200 m/s";
  content.trajectory = TrajectoryMessage{DriveState::kDriving, 0.0, 0.1, {{0.0, 0.0, 0.0}, {0.0, 0.0, 3.0}}};
  EXPECT_EQ(implausibleAfter(content), 1) << "30 rad/s";
  content = PacketContent();
  content.intent = IntentMessage{1.0, 5, 0, {{0.0, 0.0}, {4500.0, 0.0}}};
  EXPECT_EQ(implausibleAfter(content), 1) << "out of the world";
  EXPECT_FALSE(exchange.intentOf(robotIdOf("insider")));
  content = PacketContent();
  ContourBody knot;
  knot.closed = true;
  knot.vertices = {{0, 0}, {10, 10}, {10, 0}, {0, 10}};
  RecordGroup group{robotIdOf("insider"), 1, RecordStream::kMap, {Record()}};
  group.records[0].body = encode(knot);
  content.records = {group};
  EXPECT_EQ(implausibleAfter(content), 1) << "crosses itself";
  content.records[0].records[0].kind = RecordKind::kEdge;
  content.records[0].records[0].body = Bytes(3);
  EXPECT_EQ(implausibleAfter(content), 1) << "too short";
  // Correlations of -1 between all three cannot be.
  BitWriter writer;
  writer.golomb(0, 4);
  writer.bits(5, 32);
  writer.bits(1, 16);
  writer.golomb(0, 4);
  writer.bits(0, 60);
  writer.bits(0x505050, 24);
  writer.bits(0x818181, 24);
  writer.bits(0, 8);
  content.records[0].records[0].body = writer.data();
  EXPECT_EQ(implausibleAfter(content), 1) << "indefinite";
  EXPECT_TRUE(exchange.contoursOf(robotIdOf("insider")).empty());
  EXPECT_TRUE(exchange.edges().empty());
}

TEST(Hostile, nobodyElseWritesThisRobotsLog) {
  ExchangeOptions options;
  options.contour_settle = 0.0;
  Exchange exchange(options, identity("victim"));
  Insider insider(robotIdOf("insider"));
  PacketContent content;
  Record record;
  record.removed = true;
  record.sequence = 500;
  content.records = {{exchange.id(), 9, RecordStream::kMap, {record}}};
  exchange.addPacket(insider.seal(content), 1.0);
  EXPECT_TRUE(exchange.origins().empty());
  exchange.setOdometry({}, DriveState::kStopped);
  exchange.publishContours({wall(1, 0.0, 1.0, 2.0)}, 1.0);
  EXPECT_EQ(exchange.contoursOf(exchange.id()).size(), 1U);
}

TEST(Outline, crossesItselfOrNot) {
  using V = std::vector<Eigen::Vector2i>;
  EXPECT_TRUE(isOutline(V{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, true));
  EXPECT_FALSE(isOutline(V{{0, 0}, {4, 4}, {4, 0}, {0, 4}}, true));
  EXPECT_FALSE(isOutline(V{{0, 0}, {4, 0}, {2, 0}}, false)) << "folds back";
  EXPECT_FALSE(isOutline(V{{0, 0}, {4, 0}, {2, 0}}, true)) << "no area";
  EXPECT_FALSE(isOutline(V{{0, 0}, {0, 0}}, false)) << "repeats";
  EXPECT_FALSE(isOutline(V{{0, 0}}, false));
  EXPECT_FALSE(isOutline(V{}, false));
  EXPECT_FALSE(isOutline(V{{0, 0}, {4, 0}, {4, 4}, {2, 0}}, false)) << "touches";
  EXPECT_TRUE(isOutline(V{{0, 0}, {4, 0}, {4, 4}, {2, 1}}, false));
  EXPECT_TRUE(isOutline(V{{0, 0}, {4, 0}, {8, 0}}, false)) << "straight on";
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
