// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cassert>

#include "quantity.h"
#include "section_codec.h"

namespace parley {
namespace {

constexpr LogQuantity kRecordAge{0.05, 6, 7};  // [s]
constexpr int kSequenceOrder = 6;              // [-] of the first of a group
constexpr int kStepOrder = 1;                  // [-] of the others
constexpr int kGapOrder = 0;                   // [-]
constexpr int kIdOrder = 4;                    // [-]
constexpr int kLengthOrder = 4;                // [-]
constexpr int kFixedBits = 4 + 1 + 3 + 7;      // [-] kind, removed, hops, age

void writeHeader(BitWriter& writer, const Record& record) {
  writer.bits(static_cast<std::uint64_t>(record.kind), 4);
  writer.flag(record.removed);
  writer.golomb(record.gap, kGapOrder);
  writer.golomb(record.id, kIdOrder);
  writer.bits(static_cast<std::uint64_t>(std::clamp(record.hops, 0, 7)), 3);
  write(writer, record.age, kRecordAge);
  if (!record.removed) writer.golomb(static_cast<std::uint32_t>(record.body.size()), kLengthOrder);
}

/// The record's header; the length of its body in `body`.
Record readHeader(BitReader& reader) {
  Record record;
  record.kind = static_cast<RecordKind>(reader.bits(4));
  record.removed = reader.flag();
  record.gap = reader.golomb(kGapOrder);
  record.id = reader.golomb(kIdOrder);
  record.hops = static_cast<int>(reader.bits(3));
  record.age = read(reader, kRecordAge);
  const std::size_t length = record.removed ? 0 : reader.golomb(kLengthOrder);
  if (length > kMaxBody || record.id > 0xffff) {
    reader.fail();
  } else {
    record.body.resize(length);
  }
  return record;
}

}  // namespace

std::size_t recordBytes(const Record& record) {
  const int bits = kFixedBits + golombLength(record.sequence, kSequenceOrder) + golombLength(record.gap, kGapOrder) +
                   golombLength(record.id, kIdOrder) + golombLength(static_cast<std::uint32_t>(record.body.size()), kLengthOrder);
  return static_cast<std::size_t>((bits + 7) / 8) + record.body.size();
}

void encode(BitWriter& writer, const RecordGroup& group) {
  assert(!group.records.empty() && group.records.size() <= kMaxGroupRecords);
  writer.bits(group.origin, 32);
  writer.bits(group.epoch, 32);
  writer.bits(static_cast<std::uint64_t>(group.stream), 2);
  writer.bits(group.records.size(), 7);
  std::uint32_t before = 0;
  for (const Record& record : group.records) {
    writer.golomb(record.sequence - before - 1, before == 0 ? kSequenceOrder : kStepOrder);
    writeHeader(writer, record);
    before = record.sequence;
  }
  for (const Record& record : group.records) writer.bytes(record.body);
}

std::optional<RecordGroup> decodeRecords(BitReader reader) {
  RecordGroup group;
  group.origin = static_cast<RobotId>(reader.bits(32));
  group.epoch = static_cast<std::uint32_t>(reader.bits(32));
  const std::uint64_t stream = reader.bits(2);
  const std::size_t count = reader.bits(7);
  if (!reader.ok() || stream > 1 || count == 0) return std::nullopt;
  group.stream = static_cast<RecordStream>(stream);
  std::uint64_t before = 0;
  while (group.records.size() < count) {
    const std::uint64_t sequence = before + 1 + reader.golomb(before == 0 ? kSequenceOrder : kStepOrder);
    group.records.push_back(readHeader(reader));
    if (!reader.ok() || sequence > 0x7ffffffe || group.records.back().gap >= sequence) return std::nullopt;
    group.records.back().sequence = static_cast<std::uint32_t>(sequence);
    before = sequence;
  }
  for (Record& record : group.records) record.body = reader.bytes(record.body.size());
  return reader.ok() ? std::make_optional(group) : std::nullopt;
}

}  // namespace parley
