// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "knowledge.h"
#include "own_log.h"
#include "record_store.h"

namespace parley {
namespace {

constexpr RobotId kSelf = 1, kOther = 2;
const LogName kLog{kOther, RecordStream::kMap};

/// What two stores must agree on.
std::string text(const RecordStore& store) {
  std::string result;
  for (const auto& log : store.logs()) {
    result += std::to_string(log.first.origin) + " epoch " + std::to_string(log.second.epoch) + ":";
    for (const auto& record : log.second.records) {
      result += " " + std::to_string(record.first) + (record.second.record.removed ? "x" : "") +
                std::to_string(record.second.record.body.size());
    }
    for (const Interval& interval : log.second.covered.intervals()) {
      result += " [" + std::to_string(interval.first) + "," + std::to_string(interval.last) + "]";
    }
    result += "\n";
  }
  return result;
}

/// Everything that an origin ever wrote, as it would have been sent at the time.
std::vector<std::pair<std::uint32_t, Record>> history(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<std::pair<std::uint32_t, Record>> sent;
  for (std::uint32_t epoch = 5; epoch < 7; ++epoch) {
    RecordStore store({}, kOther);
    OwnLog own(store, kLog, epoch);
    for (int i = 0; i < 60; ++i) {
      const auto id = static_cast<std::uint32_t>(engine() % 12);
      if (engine() % 4 == 0) {
        own.remove(RecordKind::kContour, id, 0.0);
      } else {
        own.write(RecordKind::kContour, id, Bytes(engine() % 30), 0.0);
      }
      if (own.log() == nullptr) continue;
      // Any record that is live may be sent at any time, with the gap known then.
      for (const auto& record : store.find(kLog)->records) {
        if (engine() % 6 != 0) continue;
        sent.emplace_back(epoch, record.second.record);
        sent.back().second.gap = store.find(kLog)->gapBefore(record.first);
      }
    }
    for (const auto& record : store.find(kLog)->records) {
      sent.emplace_back(epoch, record.second.record);
      sent.back().second.gap = store.find(kLog)->gapBefore(record.first);
    }
  }
  return sent;
}

}  // namespace

TEST(Coverage, isASetOfIntervals) {
  std::mt19937 engine(3);
  for (int run = 0; run < 200; ++run) {
    Coverage coverage;
    std::set<std::uint32_t> reference;
    for (int i = 0; i < 20; ++i) {
      const auto first = static_cast<std::uint32_t>(1 + engine() % 60), last = first + static_cast<std::uint32_t>(engine() % 6);
      coverage.add(first, last);
      for (std::uint32_t n = first; n <= last; ++n) reference.insert(n);
    }
    for (std::uint32_t n = 0; n < 70; ++n) {
      ASSERT_EQ(coverage.contains(n), reference.count(n) != 0) << n;
      ASSERT_EQ(coverage.above(30).contains(n), n > 30 && reference.count(n) != 0) << n;
    }
    for (std::size_t i = 1; i < coverage.intervals().size(); ++i) {
      ASSERT_GT(coverage.intervals()[i].first, coverage.intervals()[i - 1].last + 1);
    }
  }
}

TEST(Store, theOrderAndTheNumberOfCopiesDoNotMatter) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    auto records = history(seed);
    RecordStore reference({}, kSelf);
    for (const auto& record : records) reference.merge(kLog, record.first, record.second, 1.0);
    std::mt19937_64 engine(seed);
    for (int shuffle = 0; shuffle < 4; ++shuffle) {
      std::shuffle(records.begin(), records.end(), engine);
      RecordStore store({}, kSelf);
      for (const auto& record : records) store.merge(kLog, record.first, record.second, 1.0);
      for (std::size_t i = 0; i < records.size(); i += 3) store.merge(kLog, records[i].first, records[i].second, 1.0);
      ASSERT_EQ(text(store), text(reference)) << "seed " << seed;
      ASSERT_EQ(store.mapHash(), reference.mapHash());
    }
  }
}

TEST(Store, mergingInGroupsIsAssociative) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto records = history(seed);
    RecordStore left({}, kSelf), right({}, kSelf), middle({}, kSelf);
    // (a + b) + c against a + (b + c), a store being merged by its records with the gaps it knows.
    const std::size_t third = records.size() / 3;
    const auto addRange = [&](RecordStore& store, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) store.merge(kLog, records[i].first, records[i].second, 1.0);
    };
    addRange(left, 0, third);
    addRange(left, third, 2 * third);
    addRange(left, 2 * third, records.size());
    addRange(middle, third, records.size());
    addRange(right, 0, third);
    const Log& log = *middle.find(kLog);
    for (const auto& stored : log.records) {
      Record record = stored.second.record;
      record.gap = log.gapBefore(stored.first);
      right.merge(kLog, log.epoch, record, 1.0);
    }
    const Log &a = *left.find(kLog), &b = *right.find(kLog);
    ASSERT_EQ(a.epoch, b.epoch);
    ASSERT_EQ(a.names, b.names) << "seed " << seed;
  }
}

TEST(Store, coverageNeverClaimsALiveRecordThatIsMissing) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto records = history(seed);
    RecordStore all({}, kSelf), some({}, kSelf);
    std::mt19937_64 engine(seed);
    for (const auto& record : records) {
      all.merge(kLog, record.first, record.second, 1.0);
      if (engine() % 3 == 0) some.merge(kLog, record.first, record.second, 1.0);
    }
    const Log &truth = *all.find(kLog), *log = some.find(kLog);
    if (log == nullptr || log->epoch != truth.epoch) continue;
    for (const auto& record : truth.records) {
      if (!log->covered.contains(record.first)) continue;
      EXPECT_EQ(log->records.count(record.first), 1U) << "seed " << seed;
    }
  }
}

TEST(Store, aNewEpochReplacesTheOldOne) {
  RecordStore store({}, kSelf);
  Record record;
  record.body = Bytes(10);
  EXPECT_EQ(store.merge(kLog, 7, record, 0.0), MergeResult::kNew);
  EXPECT_EQ(store.merge(kLog, 7, record, 0.0), MergeResult::kKnown);
  record.id = 5;
  record.sequence = 2;
  EXPECT_EQ(store.merge(kLog, 8, record, 0.0), MergeResult::kNew);
  EXPECT_EQ(store.find(kLog)->records.size(), 1U);
  EXPECT_EQ(store.merge(kLog, 7, record, 0.0), MergeResult::kOldEpoch);
}

TEST(Store, limitsHoldAndWhatIsRefusedIsNotCovered) {
  StoreLimits limits;
  limits.max_origins = 2;
  limits.max_records = 3;
  limits.max_bytes = 100;
  RecordStore store(limits, kSelf);
  Record record;
  record.body = Bytes(30);
  for (std::uint32_t i = 0; i < 10; ++i) {
    record.id = i;
    record.sequence = i + 1;
    EXPECT_EQ(store.merge(kLog, 1, record, 0.0), i < 3 ? MergeResult::kNew : MergeResult::kRefused);
  }
  EXPECT_FALSE(store.find(kLog)->covered.contains(4));
  record.id = 0;
  record.sequence = 20;
  record.body = Bytes(60);
  EXPECT_EQ(store.merge(kLog, 1, record, 0.0), MergeResult::kRefused) << "too many bytes";
  record.body = Bytes(20);
  EXPECT_EQ(store.merge(kLog, 1, record, 0.0), MergeResult::kNew);
  record.id = 1;
  EXPECT_EQ(store.merge(kLog, 1, record, 0.0), MergeResult::kRefused) << "two entries with one number";
  EXPECT_EQ(store.merge({3, RecordStream::kMap}, 1, record, 0.0), MergeResult::kNew);
  EXPECT_EQ(store.merge({4, RecordStream::kMap}, 1, record, 0.0), MergeResult::kRefused) << "too many origins";
  EXPECT_EQ(store.merge({kSelf, RecordStream::kMap}, 1, record, 0.0), MergeResult::kNew) << "the own log always has room";
}

TEST(Store, tombstonedIdsAreUsedAgain) {
  RecordStore store({}, kSelf);
  OwnLog log(store, {kSelf, RecordStream::kMap}, 1);
  for (int i = 0; i < 100; ++i) {
    const std::uint32_t id = log.freeId(RecordKind::kContour);
    ASSERT_TRUE(log.write(RecordKind::kContour, id, Bytes(5), 0.0));
    if (i >= 10) log.remove(RecordKind::kContour, static_cast<std::uint32_t>(i % 10), 0.0);
  }
  EXPECT_LE(log.log()->records.size(), 11U);
}

TEST(Knowledge, aDigestIsCompleteUpToItsEnd) {
  Knowledge knowledge;
  knowledge.learn(kLog, 3, 1, 10);
  knowledge.learn(kLog, 3, 50, 60);
  knowledge.learn({kOther, RecordStream::kMap, 3, {{1, 4}, {8, 20}}});
  EXPECT_TRUE(knowledge.has(kLog, 3, 4));
  EXPECT_FALSE(knowledge.has(kLog, 3, 5)) << "it has lost it, or never had it";
  EXPECT_TRUE(knowledge.has(kLog, 3, 55)) << "the digest says nothing of what is beyond";
  EXPECT_FALSE(knowledge.has(kLog, 4, 4)) << "another epoch";
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
