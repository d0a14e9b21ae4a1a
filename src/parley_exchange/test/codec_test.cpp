// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "body_codec.h"
#include "checks.h"
#include "parley_exchange/packet_codec.h"
#include "quantity.h"
#include "random_content.h"
#include "section_codec.h"

namespace parley {

TEST(BitStream, roundTripOfRandomFields) {
  RandomContent random(1);
  for (int run = 0; run < 500; ++run) {
    std::vector<std::pair<int, std::uint32_t>> fields;
    BitWriter writer;
    for (int i = 0; i < 30; ++i) {
      const int kind = random.whole(0, 25);
      const std::uint32_t value = random.word() >> random.whole(1, 31);
      fields.emplace_back(kind, value);
      if (kind < 8) writer.golomb(value, kind);
      if (kind >= 8 && kind < 16) writer.signedGolomb(static_cast<std::int32_t>(value / 2) * (value % 2 == 0 ? 1 : -1), kind - 8);
      if (kind >= 16) writer.bits(value, 32);
    }
    BitReader reader(writer.data());
    for (const auto& field : fields) {
      if (field.first < 8) {
        EXPECT_EQ(reader.golomb(field.first), field.second);
      }
      if (field.first >= 8 && field.first < 16) {
        EXPECT_EQ(reader.signedGolomb(field.first - 8),
                  static_cast<std::int32_t>(field.second / 2) * (field.second % 2 == 0 ? 1 : -1));
      }
      if (field.first >= 16) {
        EXPECT_EQ(reader.bits(32), field.second);
      }
    }
    EXPECT_TRUE(reader.ok());
    EXPECT_LT(reader.remainingBits(), 8U);
  }
}

TEST(BitStream, pastTheEndItFailsForGood) {
  const Bytes bytes{0xff};
  BitReader reader(bytes);
  EXPECT_EQ(reader.bits(9), 0U);
  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(reader.bits(1), 0U);
  EXPECT_EQ(reader.golomb(3), 0U);
  EXPECT_TRUE(reader.bytes(1).empty());
  const Bytes zeros(40, 0);
  BitReader endless(zeros);
  EXPECT_EQ(endless.golomb(0), 0U);
  EXPECT_FALSE(endless.ok());
}

TEST(BitStream, lengthsAreThoseOfTheCodes) {
  for (const std::uint32_t value : {0U, 1U, 2U, 7U, 8U, 100U, 65535U}) {
    for (int order = 0; order < 8; ++order) {
      BitWriter writer;
      writer.golomb(value, order);
      EXPECT_EQ(static_cast<int>(writer.bitCount()), golombLength(value, order));
    }
  }
}

TEST(Quantity, roundingIsWithinHalfAStepAndStaysPut) {
  RandomContent random(2);
  for (int run = 0; run < 2000; ++run) {
    const double value = random.real(-4000.0, 4000.0), angle = random.real(-20.0, 20.0);
    BitWriter writer;
    write(writer, value, kCoarsePosition);
    writeAngle(writer, angle, 12);
    write(writer, std::abs(value), LogQuantity{0.05, 6, 7});
    BitReader reader(writer.data());
    const double back = read(reader, kCoarsePosition), angle_back = readAngle(reader, 12),
                 log_back = read(reader, LogQuantity{0.05, 6, 7});
    EXPECT_NEAR(back, value, 0.5 * kCoarsePosition.step + 1e-9);
    EXPECT_NEAR(wrapAngle(angle_back - angle), 0.0, kPi / 4096.0 + 1e-9);
    EXPECT_GE(log_back, std::abs(value) * (1.0 - 1e-6));
    EXPECT_LE(log_back, std::max(0.05, std::abs(value) * std::exp2(1.0 / 6.0)) * (1.0 + 1e-6));
    EXPECT_EQ(codeOf(back, kCoarsePosition), codeOf(value, kCoarsePosition));
    EXPECT_EQ(angleCode(angle_back, 12), angleCode(angle, 12));
    EXPECT_EQ(codeOf(log_back, LogQuantity{0.05, 6, 7}), codeOf(std::abs(value), LogQuantity{0.05, 6, 7}));
  }
  EXPECT_EQ(codeOf(std::nan(""), kCoarsePosition), 0);
  EXPECT_EQ(codeOf(1e300, kCoarsePosition), (1 << 19) - 1);
  EXPECT_EQ(angleCode(std::nan(""), 12), 0);
}

TEST(Packet, whatIsDecodedEncodesToTheSameBytes) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    RandomContent random(seed);
    const PacketContent content = random.packet();
    const Bytes bytes = encodePacket(content);
    const PacketContent decoded = decodePacket(bytes);
    ASSERT_EQ(decoded.malformed_sections, 0) << "seed " << seed;
    ASSERT_EQ(encodePacket(decoded), bytes) << "seed " << seed << "\n" << describe(decoded);
    const SectionBytes sum = sectionBytes(bytes);
    EXPECT_EQ(4 + sum.beacon + sum.trajectory + sum.conflict + sum.observation + sum.map + sum.keyframe, bytes.size());
  }
}

TEST(Packet, whatIsSentPassesTheChecks) {
  const Plausibility plausible;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    RandomContent random(seed);
    const PacketContent content = decodePacket(encodePacket(random.packet()));
    if (content.beacon) {
      EXPECT_TRUE(plausible.holds(*content.beacon)) << seed;
    }
    if (content.trajectory) {
      EXPECT_TRUE(plausible.holds(*content.trajectory)) << seed;
    }
    if (content.intent) {
      EXPECT_TRUE(plausible.holds(*content.intent)) << seed;
    }
    for (const ObservationMessage& scan : content.observations) EXPECT_TRUE(plausible.holds(scan)) << seed;
    for (const RecordGroup& group : content.records) {
      for (const Record& record : group.records) EXPECT_TRUE(plausible.holds(record)) << seed << "\n" << describe(content);
    }
  }
}

TEST(Packet, scansAreToldBehindTheNewestAsFarAsTheyCanBe) {
  const std::vector<Observation> blobs{{2.0, 0.5, 0.4}};
  PacketContent content;
  content.observations = {{0.1, {3999.0, -20.0, 3.14}, blobs}};
  const Bytes alone = encodePacket(content);
  content.observations.push_back({0.2, {3998.5, -20.3, -3.14}, {}});
  content.observations.push_back({1.3, {3998.0, -20.0, 3.14}, blobs});   // longer ago than can be said
  content.observations.push_back({0.4, {3988.0, -20.0, 3.14}, blobs});   // farther away
  content.observations.push_back({1.275, {3989.0, -10.0, 0.0}, blobs});  // just so
  const Bytes all = encodePacket(content);
  EXPECT_EQ(alone.size(), 4U + 2U + 13U) << "as it was before there was more than one";
  // Who knows of one scan alone reads the same of it.
  EXPECT_TRUE(std::equal(alone.begin() + 6, alone.end() - 1, all.begin() + 6));
  const PacketContent decoded = decodePacket(all);
  ASSERT_EQ(decoded.observations.size(), 3U);
  EXPECT_NEAR(decoded.observations[1].pose.x, 3998.5, 1e-6);
  EXPECT_NEAR(decoded.observations[1].pose.y, -20.3, 1e-6);
  EXPECT_TRUE(decoded.observations[1].blobs.empty());
  EXPECT_NEAR(decoded.observations[2].age, 1.275, 1e-9);
  EXPECT_NEAR(decoded.observations[2].pose.x, 3989.0, 1e-6);
  EXPECT_NEAR(decoded.observations[2].blobs.at(0).range, 2.0, 1e-9);
  // One byte less, and nothing of it counts.
  Bytes cut = all;
  cut.pop_back();
  cut[5] = static_cast<std::uint8_t>(cut[5] - 1);
  EXPECT_TRUE(decodePacket(cut).observations.empty());
  EXPECT_EQ(decodePacket(cut).malformed_sections, 1);
}

TEST(Packet, unknownSectionsAreSkipped) {
  RandomContent random(3);
  PacketContent content;
  content.beacon = random.beacon();
  Bytes bytes = encodePacket(content);
  const Bytes unknown{200, 3, 1, 2, 3};
  bytes.insert(bytes.begin() + 4, unknown.begin(), unknown.end());
  const PacketContent decoded = decodePacket(bytes);
  EXPECT_EQ(decoded.unknown_sections, 1);
  EXPECT_EQ(decoded.malformed_sections, 0);
  ASSERT_TRUE(decoded.beacon);
  EXPECT_EQ(decoded.beacon->name, content.beacon->name);
}

TEST(Packet, aSectionThatRepeatsOrReachesOutIsLeftOut) {
  RandomContent random(4);
  PacketContent content;
  content.beacon = random.beacon();
  Bytes bytes = encodePacket(content);
  const Bytes once(bytes.begin() + 4, bytes.end());
  bytes.insert(bytes.end(), once.begin(), once.end());
  EXPECT_EQ(decodePacket(bytes).malformed_sections, 1);
  bytes.resize(bytes.size() - 1);
  EXPECT_EQ(decodePacket(bytes).malformed_sections, 1);
  EXPECT_TRUE(decodePacket(bytes).beacon);
  EXPECT_EQ(decodePacket({1, 2}).malformed_sections, 1);
  Bytes many{0, 0, 0, 0};
  for (int i = 0; i < 100; ++i) many.insert(many.end(), {99, 0});
  EXPECT_EQ(decodePacket(many).malformed_sections, 1);
}

TEST(Packet, tomorrowsFieldsAfterTodaysAreIgnored) {
  RandomContent random(5);
  BitWriter writer;
  encode(writer, random.beacon());
  Bytes longer = writer.data();
  longer.insert(longer.end(), {1, 2, 3});
  EXPECT_TRUE(decodeBeacon(BitReader(longer)));
}

TEST(Trajectory, comesBackWithinACentimetre) {
  RandomContent random(6);
  for (int run = 0; run < 200; ++run) {
    const TrajectoryMessage message = random.trajectory();
    BitWriter writer;
    encode(writer, message);
    const auto decoded = decodeTrajectory(BitReader(writer.data()));
    ASSERT_TRUE(decoded);
    ASSERT_EQ(decoded->poses.size(), message.poses.size());
    for (std::size_t i = 0; i < message.poses.size(); ++i) {
      EXPECT_LT((decoded->poses[i].position() - message.poses[i].position()).norm(), 0.0075);
      EXPECT_LT(std::abs(angleBetween(decoded->poses[i].yaw, message.poses[i].yaw)), 0.001);
    }
  }
}

TEST(Intent, comesBackWithinHalfAStep) {
  RandomContent random(9);
  for (int run = 0; run < 200; ++run) {
    const IntentMessage message = random.intent();
    BitWriter writer;
    encode(writer, message);
    const auto decoded = decodeIntent(BitReader(writer.data()));
    ASSERT_TRUE(decoded);
    EXPECT_NEAR(decoded->priority, message.priority, 0.051);
    EXPECT_EQ(decoded->holder, message.holder);
    EXPECT_EQ(decoded->depth, message.depth);
    ASSERT_EQ(decoded->way.size(), message.way.size());
    for (std::size_t i = 0; i < message.way.size(); ++i) {
      EXPECT_LT((decoded->way[i] - message.way[i]).cwiseAbs().maxCoeff(), 0.0251) << "corners do not add up their rounding";
    }
  }
}

TEST(Intent, withoutAWayOrOutOfTheWorldItIsMalformed) {
  const auto encoded = [](int corners, std::int32_t step) {
    BitWriter writer;
    writer.bits(0, 12 + 32 + 4);
    writer.bits(static_cast<std::uint64_t>(corners), 4);
    writer.bits(7, 3);
    writer.bits(0, 36);
    for (int i = 1; i < corners; ++i) {
      writer.signedGolomb(step, 7);
      writer.signedGolomb(0, 7);
    }
    return writer.data();
  };
  EXPECT_FALSE(decodeIntent(BitReader(encoded(0, 0))));
  EXPECT_TRUE(decodeIntent(BitReader(encoded(15, 9362))));
  EXPECT_TRUE(decodeIntent(BitReader(encoded(2, -131071))));
  EXPECT_FALSE(decodeIntent(BitReader(encoded(2, 131072))));
  EXPECT_FALSE(decodeIntent(BitReader(encoded(15, -9363))));
  EXPECT_FALSE(decodeIntent(BitReader(encoded(15, 1 << 29)))) << "sums beyond 32 bits";
  Bytes cut = encoded(3, 40);
  cut.resize(cut.size() - 2);
  EXPECT_FALSE(decodeIntent(BitReader(cut)));
}

TEST(Edge, covarianceStaysPositiveDefiniteAndNeverShrinks) {
  RandomContent random(7);
  for (int run = 0; run < 500; ++run) {
    EdgeBody edge = random.edge();
    // As good as degenerate in one direction.
    const Eigen::Vector3d along(random.real(-1.0, 1.0), random.real(-1.0, 1.0), random.real(-1.0, 1.0));
    if (run % 2 == 0) edge.T_anchor_peer.covariance = along * along.transpose() + 1e-9 * Eigen::Matrix3d::Identity();
    const auto decoded = decodeEdge(encode(edge));
    ASSERT_TRUE(decoded);
    EXPECT_TRUE(isCovariance(decoded->T_anchor_peer.covariance)) << run;
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(decoded->T_anchor_peer.covariance(i, i), edge.T_anchor_peer.covariance(i, i) * (1.0 - 1e-5));
    }
  }
}

TEST(Contour, takesOneAndAHalfToTwoBytesAVertex) {
  // A wall with niches, as rooms have: corners 0.2 to 1.2 m apart.
  RandomContent random(8);
  std::size_t bits = 0, vertices = 0;
  for (int run = 0; run < 100; ++run) {
    ContourBody contour;
    Eigen::Vector2i at(random.whole(-60, 60), random.whole(-60, 60));
    for (int i = 0; i < 12; ++i) {
      contour.vertices.push_back(at);
      const int step = random.whole(4, 24);
      at += i % 2 == 0 ? Eigen::Vector2i(step, random.whole(-1, 1))
                       : Eigen::Vector2i(random.whole(-1, 1), (i % 4 == 1 ? 1 : -1) * step);
    }
    bits += 8 * encode(contour).size() - 37;
    vertices += contour.vertices.size();
  }
  const double each = static_cast<double>(bits) / 8.0 / static_cast<double>(vertices);
  RecordProperty("bytes_per_vertex_in_hundredths", static_cast<int>(100.0 * each));
  EXPECT_LT(each, 2.0);
}

TEST(Records, theEstimateOfTheirSizeIsNeverLess) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    RandomContent random(seed);
    const RecordGroup group = random.group();
    std::size_t estimate = kGroupBytes;
    for (const Record& record : group.records) estimate += recordBytes(record);
    PacketContent content;
    content.records = {group};
    EXPECT_LE(encodePacket(content).size() - 4, estimate) << seed;
  }
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
