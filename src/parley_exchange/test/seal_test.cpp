// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "parley_exchange/boot_counter.h"
#include "parley_exchange/seal.h"
#include "random_content.h"
#include "receiver.h"

namespace parley {
namespace {

const std::string kDigits(64, 'a');

/// A folder that goes with the test.
struct Folder {
  Folder() : path(std::filesystem::temp_directory_path() / ("parley_seal_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
    return (path / name).string();
  }
  std::filesystem::path path;
};

template <class Call>
std::string messageOf(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(TeamKey, isReadFromAFileOrRefusedWithAReason) {
  const Folder folder;
  const TeamKey key = loadTeamKey(folder.file("good", "  " + kDigits + "\n"));
  EXPECT_EQ(key[0], 0xaa);
  const std::string missing = messageOf([&] { loadTeamKey((folder.path / "missing").string()); });
  EXPECT_NE(missing.find("missing: cannot read the team key"), std::string::npos) << missing;
  EXPECT_NE(messageOf([&] { loadTeamKey(folder.file("short", "abc\n")); }).find("64 hexadecimal digits"), std::string::npos);
  EXPECT_NE(messageOf([&] { loadTeamKey(folder.file("empty", "")); }).find("here are 0 characters"), std::string::npos);
  std::string wrong = kDigits;
  wrong[9] = 'g';
  EXPECT_NE(messageOf([&] { loadTeamKey(folder.file("wrong", wrong)); }).find("character 10"), std::string::npos);
  EXPECT_EQ(parseTeamKey(std::string(64, 'F'))[31], 0xff);
}

TEST(BootCounter, risesWithEveryStart) {
  const Folder folder;
  const std::string path = (folder.path / "boot").string();
  const std::uint32_t first = nextBoot(path), second = nextBoot(path), third = nextBoot(path);
  EXPECT_EQ(first >> 12, 1U);
  EXPECT_EQ(second >> 12, 2U);
  EXPECT_EQ(third >> 12, 3U);
  std::ifstream file(path);
  int count = 0;
  file >> count;
  EXPECT_EQ(count, 3);
}

TEST(BootCounter, refusesWhatItCannotTrust) {
  const Folder folder;
  for (const char* text : {"", "x", "-1", "12 13", "99999999", "1048575"}) {
    EXPECT_NE(messageOf([&] { nextBoot(folder.file("boot", text)); }), "") << "'" << text << "'";
  }
  EXPECT_NE(messageOf([&] { nextBoot((folder.path / "no" / "such" / "boot").string()); }).find("boot.new"), std::string::npos);
  EXPECT_NE(messageOf([&] { nextBoot(folder.path.string()); }), "") << "a folder";
}

TEST(RobotId, isTheNamesHash) {
  EXPECT_EQ(robotIdOf("robot_1"), robotIdOf("robot_1"));
  EXPECT_NE(robotIdOf("robot_1"), robotIdOf("robot_2"));
  EXPECT_EQ(simulatedTeamKey(3), simulatedTeamKey(3));
  EXPECT_NE(simulatedTeamKey(3), simulatedTeamKey(4));
}

TEST(Seal, opensWithTheSameKeyOnly) {
  RandomContent random(1);
  Sealer ours(simulatedTeamKey(1)), theirs(simulatedTeamKey(2));
  const Bytes plain = random.bytes(300);
  const FrameHeader header{7, 4096, 12};
  const Bytes frame = ours.seal(header, plain);
  EXPECT_EQ(frame.size(), plain.size() + kFrameBytes);
  const auto read = readHeader(frame);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->sender, 7U);
  EXPECT_EQ(read->boot, 4096U);
  EXPECT_EQ(read->counter, 12U);
  EXPECT_EQ(ours.open(*read, frame), plain);
  EXPECT_FALSE(theirs.open(*read, frame));
}

TEST(Seal, everyBitCounts) {
  RandomContent random(2);
  Sealer sealer(simulatedTeamKey(1));
  const Bytes frame = sealer.seal({7, 1, 1}, random.bytes(40));
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    Bytes changed = frame;
    changed[bit / 8] = static_cast<std::uint8_t>(changed[bit / 8] ^ (1U << (bit % 8)));
    const auto header = readHeader(changed);
    EXPECT_FALSE(header && sealer.open(*header, changed)) << "bit " << bit;
  }
}

TEST(Seal, whatIsNoFrameHasNoHeader) {
  EXPECT_FALSE(readHeader({}));
  EXPECT_FALSE(readHeader(Bytes(kFrameBytes - 1, kWireVersion)));
  EXPECT_FALSE(readHeader(Bytes(kMaxDatagram + 1, kWireVersion)));
  EXPECT_FALSE(readHeader(Bytes(100, kWireVersion + 1)));
}

TEST(Seal, manySendersAreServedWithFewKeysKept) {
  Sealer sealer(simulatedTeamKey(1));
  for (std::uint32_t sender = 0; sender < 1000; ++sender) {
    const Bytes frame = sealer.seal({sender, 1, 1}, {1, 2, 3});
    ASSERT_TRUE(sealer.open({sender, 1, 1}, frame));
  }
}

TEST(ReplayWindow, takesEachCounterOnceInAnyOrder) {
  RandomContent random(3);
  ReplayWindow window;
  std::vector<std::uint32_t> counters;
  for (std::uint32_t i = 1; i <= 3000; ++i) counters.push_back(i);
  for (std::size_t i = 0; i + 20 < counters.size(); ++i) {
    std::swap(counters[i], counters[i + static_cast<std::size_t>(random.whole(0, 19))]);
  }
  for (const std::uint32_t counter : counters) {
    EXPECT_TRUE(window.accept(counter)) << counter;
    EXPECT_FALSE(window.accept(counter)) << counter;
  }
  EXPECT_FALSE(window.accept(0));
  EXPECT_TRUE(window.accept(10000));
  EXPECT_FALSE(window.accept(3500)) << "too old to tell";
  EXPECT_NEAR(window.receivedShare(), 1.0 / 64.0, 1e-9);
}

class ReceiverTest : public testing::Test {
 protected:
  bool take(const FrameHeader& header, double now = 0.0) {
    return receiver_.open(sealer_.seal(header, {1}), sealer_, now, counters_).has_value();
  }

  ExchangeOptions options_;
  Sealer sealer_{simulatedTeamKey(1)};
  Receiver receiver_{options_, 1, 100};
  ExchangeCounters counters_;
};

TEST_F(ReceiverTest, dropsReplaysAndLowerBoots) {
  EXPECT_TRUE(take({2, 5, 1}));
  EXPECT_FALSE(take({2, 5, 1}));
  EXPECT_EQ(counters_.dropped_replay, 1);
  EXPECT_TRUE(take({2, 6, 1}));
  EXPECT_FALSE(take({2, 5, 2}));
  EXPECT_EQ(counters_.dropped_boot, 1);
  EXPECT_FALSE(take({2, 6, 1}));
  EXPECT_TRUE(take({2, 6, 2}));
}

TEST_F(ReceiverTest, knowsAWrongKeyAForgedSenderAndNoise) {
  Sealer other(simulatedTeamKey(2));
  receiver_.open(other.seal({2, 5, 1}, {1}), sealer_, 0.0, counters_);
  EXPECT_EQ(counters_.dropped_authentication, 1);
  Bytes forged = sealer_.seal({2, 5, 1}, {1});
  forged[4] = static_cast<std::uint8_t>(forged[4] ^ 1U);
  receiver_.open(forged, sealer_, 0.0, counters_);
  EXPECT_EQ(counters_.dropped_authentication, 2);
  receiver_.open({1, 2, 3}, sealer_, 0.0, counters_);
  EXPECT_EQ(counters_.dropped_format, 1);
  EXPECT_EQ(receiver_.find(2), nullptr) << "nothing is kept of what is not authentic";
}

TEST_F(ReceiverTest, limitsTheRateAndTheNumberOfSenders) {
  int taken = 0;
  for (std::uint32_t i = 1; i <= 500; ++i) taken += take({2, 5, i}, 1.0) ? 1 : 0;
  EXPECT_EQ(taken, 50);
  EXPECT_EQ(counters_.dropped_rate, 450);
  for (std::uint32_t sender = 10; sender < 1000; ++sender) take({sender, 1, 1}, 2.0);
  EXPECT_EQ(counters_.dropped_table, 990 - 255);
}

TEST_F(ReceiverTest, tellsItsOwnEchoFromANamesake) {
  const Bytes own = sealer_.seal({1, 100, 1}, {1});
  receiver_.sent(1, own);
  receiver_.open(own, sealer_, 0.0, counters_);
  EXPECT_FALSE(receiver_.takeOwnNameHeard());
  take({1, 99, 7});
  EXPECT_FALSE(receiver_.takeOwnNameHeard()) << "a recording";
  receiver_.open(sealer_.seal({1, 100, 1}, {2}), sealer_, 0.0, counters_);
  EXPECT_TRUE(receiver_.takeOwnNameHeard()) << "the same counter, another packet";
  EXPECT_FALSE(receiver_.takeOwnNameHeard());
  take({1, 101, 1});
  EXPECT_TRUE(receiver_.takeOwnNameHeard());
  EXPECT_EQ(counters_.dropped_own, 4);
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
