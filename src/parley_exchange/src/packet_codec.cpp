// SPDX-License-Identifier: BSD-3-Clause
#include "parley_exchange/packet_codec.h"

#include <cassert>

#include "section_codec.h"

namespace parley {
namespace {

enum class SectionType { kBeacon = 1, kEchoes, kDigest, kTrajectory, kConflicts, kObservations, kRecords, kIntent };

constexpr int kMaxSections = 48;

struct Section {
  int type = 0;
  std::size_t begin = 0;   // [byte] of the body
  std::size_t length = 0;  // [byte] of the body
};

template <class Body>
void append(Bytes& packet, SectionType type, const Body& body) {
  BitWriter writer;
  encode(writer, body);
  const Bytes& bytes = writer.data();
  assert(bytes.size() < 0x8000);
  packet.push_back(static_cast<std::uint8_t>(type));
  if (bytes.size() >= 0x80) packet.push_back(static_cast<std::uint8_t>(0x80 | (bytes.size() >> 8)));
  packet.push_back(static_cast<std::uint8_t>(bytes.size() & 0xff));
  packet.insert(packet.end(), bytes.begin(), bytes.end());
}

/// The sections in order; `malformed` if one reaches beyond the end or there are too many.
struct SectionList {
  std::vector<Section> sections;
  bool malformed = false;
};

SectionList split(const Bytes& plain) {
  SectionList list;
  std::size_t at = 4;
  while (at < plain.size()) {
    Section section;
    section.type = plain[at++];
    if (at < plain.size()) section.length = plain[at++];
    if (section.length >= 0x80 && at < plain.size()) section.length = ((section.length & 0x7f) << 8) | plain[at++];
    section.begin = at;
    at += section.length;
    if (at > plain.size() || list.sections.size() == kMaxSections) {
      list.malformed = true;
      break;
    }
    list.sections.push_back(section);
  }
  return list;
}

/// Takes over what was decoded, once.
template <class Value>
bool take(std::optional<Value>& into, std::optional<Value> decoded) {
  if (!decoded || into) return false;
  into = std::move(decoded);
  return true;
}

template <class List>
bool take(List& into, std::optional<List> decoded) {
  if (!decoded || !into.empty()) return false;
  into = std::move(*decoded);
  return true;
}

bool takeRecords(std::vector<RecordGroup>& groups, std::optional<RecordGroup> group) {
  if (group) groups.push_back(std::move(*group));
  return group.has_value();
}

/// False if the section cannot be read.
bool decodeSection(PacketContent& content, int type, const BitReader& reader) {
  switch (static_cast<SectionType>(type)) {
    case SectionType::kBeacon:
      return take(content.beacon, decodeBeacon(reader));
    case SectionType::kEchoes:
      return take(content.echoes, decodeEchoes(reader));
    case SectionType::kDigest:
      return take(content.digest, decodeDigest(reader));
    case SectionType::kTrajectory:
      return take(content.trajectory, decodeTrajectory(reader));
    case SectionType::kIntent:
      return take(content.intent, decodeIntent(reader));
    case SectionType::kConflicts:
      return take(content.conflicts, decodeConflicts(reader));
    case SectionType::kObservations:
      return take(content.observations, decodeObservations(reader));
    case SectionType::kRecords:
      return takeRecords(content.records, decodeRecords(reader));
  }
  ++content.unknown_sections;
  return true;
}

}  // namespace

Bytes encodePacket(const PacketContent& content) {
  Bytes packet;
  for (int shift = 24; shift >= 0; shift -= 8) packet.push_back(static_cast<std::uint8_t>(content.stamp >> shift));
  if (content.trajectory) append(packet, SectionType::kTrajectory, *content.trajectory);
  if (content.intent) append(packet, SectionType::kIntent, *content.intent);
  if (content.conflicts) append(packet, SectionType::kConflicts, *content.conflicts);
  if (content.beacon) append(packet, SectionType::kBeacon, *content.beacon);
  if (!content.echoes.empty()) append(packet, SectionType::kEchoes, content.echoes);
  if (!content.digest.empty()) append(packet, SectionType::kDigest, content.digest);
  if (!content.observations.empty()) append(packet, SectionType::kObservations, content.observations);
  for (const RecordGroup& group : content.records) append(packet, SectionType::kRecords, group);
  return packet;
}

PacketContent decodePacket(const Bytes& plain) {
  PacketContent content;
  if (plain.size() < 4) {
    content.malformed_sections = 1;
    return content;
  }
  for (int i = 0; i < 4; ++i) content.stamp = (content.stamp << 8) | plain[static_cast<std::size_t>(i)];
  const SectionList list = split(plain);
  content.malformed_sections = list.malformed ? 1 : 0;
  for (const Section& section : list.sections) {
    if (!decodeSection(content, section.type, BitReader(plain.data() + section.begin, section.length))) {
      ++content.malformed_sections;
    }
  }
  return content;
}

SectionBytes& SectionBytes::operator+=(const SectionBytes& other) {
  beacon += other.beacon;
  trajectory += other.trajectory;
  conflict += other.conflict;
  observation += other.observation;
  map += other.map;
  keyframe += other.keyframe;
  return *this;
}

SectionBytes sectionBytes(const Bytes& plain) {
  SectionBytes sum;
  std::size_t begin = 4;
  for (const Section& section : split(plain).sections) {
    const std::size_t end = section.begin + section.length, size = end - begin;
    begin = end;
    switch (static_cast<SectionType>(section.type)) {
      case SectionType::kBeacon:
      case SectionType::kEchoes:
      case SectionType::kDigest:
        sum.beacon += size;
        break;
      case SectionType::kTrajectory:
        sum.trajectory += size;
        break;
      case SectionType::kIntent:
      case SectionType::kConflicts:
        sum.conflict += size;
        break;
      case SectionType::kObservations:
        sum.observation += size;
        break;
      case SectionType::kRecords: {
        BitReader reader(plain.data() + section.begin, section.length);
        reader.bits(64);
        (reader.bits(2) == 0 ? sum.map : sum.keyframe) += size;
        break;
      }
    }
  }
  return sum;
}

}  // namespace parley
