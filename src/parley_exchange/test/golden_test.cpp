// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "body_codec.h"
#include "datagram_file.h"
#include "parley_exchange/packet_codec.h"
#include "parley_exchange/seal.h"
#include "random_content.h"

namespace parley {
namespace {

const char* const kKey = "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f";
const std::string kFile = std::string(PACKAGE_DIRECTORY) + "/test/golden_vectors.txt";
const std::string kDecoder = std::string(PACKAGE_DIRECTORY) + "/../../scripts/decode_packet";

std::string hexadecimal(const Bytes& bytes) {
  std::string text;
  char digits[3];
  for (const std::uint8_t byte : bytes) {
    std::snprintf(digits, sizeof(digits), "%02x", byte);
    text += digits;
  }
  return text;
}

/// A sealed packet in hexadecimal, and what it says in lines that begin with '| '.
std::string vectorOf(const Bytes& plain, std::uint32_t counter) {
  Sealer sealer(parseTeamKey(kKey));
  const FrameHeader header{robotIdOf("robot_1"), 12345, counter};
  const Bytes frame = sealer.seal(header, plain);
  char head[128];
  std::snprintf(head, sizeof(head), "%zu bytes: sender=%08x boot=%u counter=%u", frame.size(), header.sender, header.boot,
                counter);
  std::string text = hexadecimal(frame) + "\n| " + head + "\n";
  std::istringstream lines(describe(decodePacket(plain)));
  for (std::string line; std::getline(lines, line);) text += "| " + line + "\n";
  return text;
}

Record recordOf(RecordKind kind, std::uint32_t id, std::uint32_t sequence, const Bytes& body) {
  Record record;
  record.kind = kind;
  record.id = id;
  record.sequence = sequence;
  record.age = 2.0;
  record.body = body;
  return record;
}

PacketContent beaconPacket() {
  PacketContent content;
  content.stamp = 123456789;
  content.beacon = Beacon{
      "robot_1", 0.02, {1.5, -2.25, 0.5}, {1.2, -0.4}, {0.8, 0.4}, {2.0, 1.55, 2.0, 4.0}, DriveState::kDriving, 3, 0xdeadbeef};
  content.echoes = {{robotIdOf("robot_2"), 512, 4294967000U, 0.8}};
  content.digest = {{robotIdOf("robot_2"), RecordStream::kMap, 0x3039, {{1, 40}, {43, 44}}},
                    {robotIdOf("robot_3"), RecordStream::kKeyframes, 7, {}}};
  return content;
}

PacketContent motionPacket() {
  PacketContent content;
  content.stamp = 1;
  content.trajectory = TrajectoryMessage{DriveState::kYielding, -0.05, 0.25, {}};
  Pose2 pose{10.0, 5.0, 3.1};
  for (int i = 0; i < 9; ++i) {
    content.trajectory->poses.push_back(pose);
    pose = integrateTwist(pose, 2.0 - 0.25 * i, 0.3, 0.25);
  }
  content.conflicts = std::vector<Conflict>{
      {robotIdOf("robot_2"), ConflictKind::kClaim, 5, 12.3, 2.5, std::nullopt},
      {robotIdOf("robot_3"), ConflictKind::kYield, 63, 0.0, 0.5, Eigen::Vector2d(-3.5, 4.25)},
  };
  content.observations = {{0.04, {1.5, -2.25, 0.5}, {{2.345, -1.0, 0.42}, {3.9, 3.0, 0.8}}}};
  return content;
}

PacketContent sightingsPacket() {
  PacketContent content;
  content.stamp = 77;
  content.observations = {{0.04, {1.5, -2.25, 3.1}, {{2.345, -1.0, 0.42}, {3.9, 3.0, 0.8}}},
                          {0.14, {1.7, -2.26, 3.14}, {{2.54, -1.02, 0.42}}},
                          {0.94, {3.45, -1.995, -3.1}, {}}};
  return content;
}

PacketContent intentPacket() {
  PacketContent content;
  content.stamp = 2;
  content.trajectory = TrajectoryMessage{DriveState::kEscaping, 0.1, 0.25, {{1.0, 2.0, 0.0}, {1.25, 2.0, 0.0}, {1.5, 2.0, 0.0}}};
  content.intent =
      IntentMessage{27.4, robotIdOf("robot_2"), 3, {{1.0, 2.0}, {12.35, 2.0}, {12.3, -7.5}, {-300.0, 250.05}, {-300.0, 250.0}}};
  return content;
}

PacketContent recordsPacket() {
  PacketContent content;
  content.stamp = 0xffffffff;
  RecordGroup map{robotIdOf("robot_1"), 12345, RecordStream::kMap, {}};
  map.records.push_back(recordOf(RecordKind::kAnchor, 0, 1, encode(AnchorBody{{4.0, -1.0, 1.57}, 0.04, 0.008})));
  ContourBody contour{0, true, true, {{10, 10}, {50, 12}, {48, 40}, {9, 41}}};
  map.records.push_back(recordOf(RecordKind::kContour, 17, 2, encode(contour)));
  EdgeBody edge{0, robotIdOf("robot_2"), 0x3039, 3, {}, 4, EdgeState::kConfirmed};
  edge.T_anchor_peer.pose = {1.25, -0.5, 2.0};
  edge.T_anchor_peer.covariance << 4e-4, 1e-4, 0.0, 1e-4, 9e-4, 5e-6, 0.0, 5e-6, 1e-5;
  map.records.push_back(recordOf(RecordKind::kEdge, 0, 5, encode(edge)));
  map.records.back().gap = 2;
  map.records.push_back(recordOf(RecordKind::kContour, 4, 6, {}));
  map.records.back().removed = true;
  const ContourReference reference{robotIdOf("robot_2"), 0x3039, 12, 77};
  map.records.push_back(recordOf(RecordKind::kContest, 0, 7, encode(reference)));
  map.records.push_back(recordOf(RecordKind::kEndorsement, 0, 8, encode(reference)));
  RecordGroup keyframes{robotIdOf("robot_3"), 4097, RecordStream::kKeyframes, {}};
  keyframes.records.push_back(
      recordOf(RecordKind::kKeyframe, 2, 11, encode(KeyframeBody{987654, {0.5, 0.25, -1.0}, {1, 2, 3, 254}})));
  keyframes.records.back().hops = 1;
  content.records = {map, keyframes};
  return content;
}

std::string goldenText() {
  const Bytes unknown{0, 0, 0, 9, 200, 3, 1, 2, 3, 1, 1, 0};
  return "# Packets and what they say, for other implementations of docs/wire_format.md. Sealed by robot_1 in its boot 12345.\n"
         "# team key = " +
         std::string(kKey) + "\n\n[a beacon with echoes and coverage]\n" + vectorOf(encodePacket(beaconPacket()), 1) +
         "\n[a trajectory, conflicts, observations]\n" + vectorOf(encodePacket(motionPacket()), 2) +
         "\n[records of each kind]\n" + vectorOf(encodePacket(recordsPacket()), 3) + "\n[sightings of three scans]\n" +
         vectorOf(encodePacket(sightingsPacket()), 4) + "\n[an unknown section and one that is too short]\n" +
         vectorOf(unknown, 0xfffffffe) + "\n[a trajectory with an intent]\n" + vectorOf(encodePacket(intentPacket()), 5);
}

std::string contentOf(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

int runDecoder(const std::string& path) {
  return std::system(("/usr/bin/python3 " + kDecoder + " " + kKey + " " + path + " --check").c_str());
}

/// Random packets, every second one changed somewhere.
std::string randomVectors(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    RandomContent random(static_cast<std::uint64_t>(i));
    Bytes plain = encodePacket(random.packet());
    for (int k = i % 2 == 0 ? 0 : random.whole(1, 4); k > 0; --k) {
      plain[static_cast<std::size_t>(random.whole(0, static_cast<int>(plain.size()) - 1))] =
          static_cast<std::uint8_t>(random.word());
    }
    if (plain.size() + kFrameBytes <= kMaxDatagram) text += vectorOf(plain, static_cast<std::uint32_t>(i + 1));
  }
  return text;
}

}  // namespace

TEST(Golden, theFileHoldsTheVectors) {
  if (std::getenv("PARLEY_WRITE_GOLDEN") != nullptr) std::ofstream(kFile) << goldenText();
  EXPECT_EQ(contentOf(kFile), goldenText()) << "the wire format has changed: raise its version, or put it right";
}

TEST(Golden, theDumpToolReadsTheFile) {
  const std::vector<Bytes> frames = readDatagrams(kFile);
  ASSERT_EQ(frames.size(), 6U);
  Sealer sealer(parseTeamKey(kKey));
  for (const Bytes& frame : frames) EXPECT_TRUE(sealer.open(*readHeader(frame), frame));
}

TEST(Golden, datagramFilesInBinary) {
  const std::string path = (std::filesystem::temp_directory_path() / ("parley_binary_" + std::to_string(::getpid()))).string();
  std::ofstream(path, std::ios::binary) << std::string("\0\3abc\0\1\1", 8);
  EXPECT_EQ(readDatagrams(path), (std::vector<Bytes>{{'a', 'b', 'c'}, {1}}));
  std::ofstream(path, std::ios::binary) << std::string("\0\4abc", 5);
  EXPECT_THROW(readDatagrams(path), std::invalid_argument);
  std::filesystem::remove(path);
  EXPECT_THROW(readDatagrams(path), std::invalid_argument);
}

TEST(Golden, anIndependentDecoderReadsTheSame) {
  EXPECT_EQ(runDecoder(kFile), 0);
  const std::string path = (std::filesystem::temp_directory_path() / ("parley_vectors_" + std::to_string(::getpid()))).string();
  std::ofstream(path) << randomVectors(800);
  EXPECT_EQ(runDecoder(path), 0);
  std::filesystem::remove(path);
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
