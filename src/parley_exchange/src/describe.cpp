// SPDX-License-Identifier: BSD-3-Clause
#include <cstdarg>
#include <cstdio>

#include "body_codec.h"
#include "parley_exchange/packet_codec.h"

namespace parley {
namespace {

/// printf into a string. Text longer than 255 characters is cut.
__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof(text), pattern, arguments);
  va_end(arguments);
  return text;
}

/// Without the sign of a rounded zero.
std::string number(double value, int digits) {
  const std::string text = format("%.*f", digits, value);
  return text.find_first_of("123456789") == std::string::npos && text[0] == '-' ? text.substr(1) : text;
}

std::string poseText(const Pose2& pose) { return number(pose.x, 3) + "," + number(pose.y, 3) + "," + number(pose.yaw, 4); }

std::string hexadecimal(const Bytes& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += format("%02x", byte);
  return text.empty() ? "-" : text;
}

const char* nameOf(RecordStream stream) { return stream == RecordStream::kMap ? "map" : "keyframes"; }

const char* nameOf(ConflictKind kind) {
  return kind == ConflictKind::kClaim ? "claim" : kind == ConflictKind::kYield ? "yield" : "release";
}

std::string nameOf(RecordKind kind) {
  constexpr const char* kNames[] = {"contour", "anchor", "edge", "contest", "endorsement", "keyframe"};
  const auto index = static_cast<std::size_t>(kind);
  return index < 6 ? kNames[index] : format("kind_%d", static_cast<int>(index));
}

std::string text(const ContourBody& body) {
  std::string line = format("anchor=%u closed=%d hole=%d vertices=", body.anchor, body.closed, body.hole);
  for (const Eigen::Vector2i& vertex : body.vertices) line += format("%d,%d;", vertex.x(), vertex.y());
  return line;
}

std::string text(const AnchorBody& body) {
  return "pose=" + poseText(body.pose) + " sigma=" + number(body.position_sigma, 4) + "," + number(body.yaw_sigma, 5);
}

std::string text(const EdgeBody& body) {
  std::string line = format("anchor=%u peer=%08x peer_epoch=%04x peer_anchor=%u pose=", body.anchor, body.peer, body.peer_epoch,
                            body.peer_anchor);
  line += poseText(body.T_anchor_peer.pose) + " covariance=";
  const Covariance3& c = body.T_anchor_peer.covariance;
  for (const double entry : {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)}) line += number(entry, 6) + ";";
  return line + format(" support=%d state=%d", body.support, static_cast<int>(body.state));
}

std::string text(const ContourReference& body) {
  return format("origin=%08x epoch=%04x id=%u sequence=%u", body.origin, body.epoch, body.id, body.sequence);
}

std::string text(const KeyframeBody& body) {
  return format("stamp=%u pose=", body.stamp) + poseText(body.pose) + " descriptor=" + hexadecimal(body.descriptor);
}

template <class Body>
std::string orMalformed(const std::optional<Body>& body) {
  return body ? text(*body) : "malformed";
}

std::string bodyText(const Record& record) {
  if (record.removed) return "removed";
  switch (record.kind) {
    case RecordKind::kContour:
      return orMalformed(decodeContour(record.body));
    case RecordKind::kAnchor:
      return orMalformed(decodeAnchor(record.body));
    case RecordKind::kEdge:
      return orMalformed(decodeEdge(record.body));
    case RecordKind::kContest:
    case RecordKind::kEndorsement:
      return orMalformed(decodeReference(record.body));
    case RecordKind::kKeyframe:
      return orMalformed(decodeKeyframe(record.body));
  }
  return "body=" + hexadecimal(record.body);
}

std::string text(const Beacon& beacon) {
  const MotionLimits& limits = beacon.limits;
  return "beacon name=" + beacon.name + " age=" + number(beacon.age, 3) + " pose=" + poseText(beacon.pose) +
         " twist=" + number(beacon.twist.speed, 2) + "," + number(beacon.twist.turn_rate, 2) +
         " state=" + toString(beacon.state) + " footprint=" + number(beacon.footprint.length, 2) + "," +
         number(beacon.footprint.width, 2) + " limits=" + number(limits.speed, 2) + "," + number(limits.turn_rate, 2) + "," +
         number(limits.acceleration, 1) + "," + number(limits.turn_acceleration, 1) +
         format(" neighbours=%d map_hash=%08x", beacon.neighbours, beacon.map_hash);
}

std::string text(const Echo& echo) {
  return format("echo robot=%08x counter=%d difference=%u heard=", echo.robot, echo.counter, echo.difference) +
         number(echo.heard, 3);
}

std::string text(const DigestEntry& entry) {
  std::string line = format("digest origin=%08x stream=%s epoch=%04x has=", entry.origin, nameOf(entry.stream), entry.epoch);
  for (const Interval& interval : entry.intervals) line += format("%u-%u;", interval.first, interval.last);
  return line;
}

std::string text(const TrajectoryMessage& trajectory) {
  std::string line = std::string("trajectory state=") + toString(trajectory.state) + " start=" + number(trajectory.start, 3) +
                     " step=" + number(trajectory.step, 2) + " poses=";
  for (const Pose2& pose : trajectory.poses) line += poseText(pose) + ";";
  return line;
}

std::string text(const IntentMessage& intent) {
  std::string line =
      "intent priority=" + number(intent.priority, 1) + format(" holder=%08x depth=%d way=", intent.holder, intent.depth);
  for (const Eigen::Vector2d& corner : intent.way) line += number(corner.x(), 2) + "," + number(corner.y(), 2) + ";";
  return line;
}

std::string text(const Conflict& conflict) {
  std::string line = format("conflict peer=%08x kind=%s round=%d cost=", conflict.peer, nameOf(conflict.kind), conflict.round) +
                     number(conflict.cost, 1) + " lease=" + number(conflict.lease, 1);
  if (conflict.place) line += " place=" + number(conflict.place->x(), 2) + "," + number(conflict.place->y(), 2);
  return line;
}

std::string text(const ObservationMessage& observations) {
  std::string line = "observations age=" + number(observations.age, 3) + " pose=" + poseText(observations.pose) + " blobs=";
  for (const Observation& blob : observations.blobs) {
    line += number(blob.range, 3) + "," + number(blob.bearing, 4) + "," + number(blob.chord, 2) + ";";
  }
  return line;
}

std::string text(const RecordGroup& group) {
  std::string lines = format("records origin=%08x epoch=%u stream=%s", group.origin, group.epoch, nameOf(group.stream));
  for (const Record& record : group.records) {
    lines += "\n  " + nameOf(record.kind) +
             format(" id=%u sequence=%u gap=%u hops=%d age=", record.id, record.sequence, record.gap, record.hops) +
             number(record.age, 2) + " " + bodyText(record);
  }
  return lines;
}

}  // namespace

std::string describe(const PacketContent& content) {
  std::string lines =
      format("stamp=%u unknown=%d malformed=%d\n", content.stamp, content.unknown_sections, content.malformed_sections);
  if (content.trajectory) lines += text(*content.trajectory) + "\n";
  if (content.intent) lines += text(*content.intent) + "\n";
  if (content.conflicts && content.conflicts->empty()) lines += "conflict none\n";
  if (content.conflicts) {
    for (const Conflict& conflict : *content.conflicts) lines += text(conflict) + "\n";
  }
  if (content.beacon) lines += text(*content.beacon) + "\n";
  for (const Echo& echo : content.echoes) lines += text(echo) + "\n";
  for (const DigestEntry& entry : content.digest) lines += text(entry) + "\n";
  for (const ObservationMessage& scan : content.observations) lines += text(scan) + "\n";
  for (const RecordGroup& group : content.records) lines += text(group) + "\n";
  return lines;
}

}  // namespace parley
