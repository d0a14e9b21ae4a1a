// SPDX-License-Identifier: BSD-3-Clause
#include "random_content.h"

#include <cmath>

#include "body_codec.h"

namespace parley {

double RandomContent::real(double low, double high) {
  return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
}

int RandomContent::whole(int low, int high) {
  return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
}

Bytes RandomContent::bytes(std::size_t count) {
  Bytes result(count);
  for (std::uint8_t& byte : result) byte = static_cast<std::uint8_t>(engine_());
  return result;
}

Pose2 RandomContent::pose(double extent) { return {real(-extent, extent), real(-extent, extent), real(-kPi, kPi)}; }

Beacon RandomContent::beacon() {
  Beacon beacon;
  beacon.name = "robot_" + std::to_string(whole(1, 99));
  beacon.age = real(0.0, 1.2);
  beacon.pose = pose(1000.0);
  beacon.twist = {real(-2.0, 2.0), real(-2.0, 2.0)};
  beacon.footprint = {real(0.1, 2.0), real(0.1, 2.0)};
  beacon.limits = {real(0.1, 10.0), real(0.1, 10.0), real(0.1, 20.0), real(0.1, 50.0)};
  beacon.state = static_cast<DriveState>(whole(0, 10));
  beacon.neighbours = whole(0, 127);
  beacon.map_hash = word();
  return beacon;
}

TrajectoryMessage RandomContent::trajectory() {
  TrajectoryMessage trajectory;
  trajectory.state = static_cast<DriveState>(whole(0, 10));
  trajectory.start = real(-1.0, 5.0);
  trajectory.step = real(0.1, 0.5);
  Pose2 at = pose(500.0);
  double speed = 0.0, turn = 0.0;
  for (int i = whole(1, 48); i > 0; --i) {
    trajectory.poses.push_back(at);
    speed = std::fmax(-2.0, std::fmin(2.0, speed + real(-0.5, 0.5)));
    turn = std::fmax(-1.5, std::fmin(1.5, turn + real(-0.5, 0.5)));
    at = integrateTwist(at, speed, turn, trajectory.step);
  }
  return trajectory;
}

IntentMessage RandomContent::intent() {
  IntentMessage intent;
  intent.priority = real(0.0, 400.0);
  intent.holder = word();
  intent.depth = whole(0, 15);
  Eigen::Vector2d at(real(-500.0, 500.0), real(-500.0, 500.0));
  for (int i = whole(1, 15); i > 0; --i) {
    intent.way.push_back(at);
    at += Eigen::Vector2d(real(-20.0, 20.0), real(-20.0, 20.0));
  }
  return intent;
}

Conflict RandomContent::conflict() {
  Conflict conflict;
  conflict.peer = word();
  conflict.kind = static_cast<ConflictKind>(whole(0, 2));
  conflict.round = whole(0, 63);
  conflict.cost = real(0.0, 400.0);
  conflict.lease = real(0.0, 12.0);
  if (chance(0.5)) conflict.place = Eigen::Vector2d(real(-100.0, 100.0), real(-100.0, 100.0));
  return conflict;
}

std::vector<ObservationMessage> RandomContent::observations() {
  std::vector<ObservationMessage> scans(static_cast<std::size_t>(whole(1, 4)));
  const Pose2 newest = pose(500.0);
  for (ObservationMessage& scan : scans) {
    scan.age = real(0.0, 1.2);
    const Pose2 step = pose(10.0);
    scan.pose = &scan == &scans.front() ? newest : Pose2{newest.x + step.x, newest.y + step.y, step.yaw};
    for (int i = whole(0, 8); i > 0; --i) scan.blobs.push_back({real(0.1, 19.0), real(-kPi, kPi), real(0.0, 1.0)});
  }
  return scans;
}

DigestEntry RandomContent::digestEntry() {
  DigestEntry entry;
  entry.origin = word();
  entry.stream = static_cast<RecordStream>(whole(0, 1));
  entry.epoch = static_cast<std::uint16_t>(word() & 0xffff);
  std::uint32_t end = static_cast<std::uint32_t>(whole(0, 3));
  for (int i = whole(0, 5); i > 0; --i) {
    const std::uint32_t first = end + 1 + static_cast<std::uint32_t>(whole(0, 9));
    end = first + static_cast<std::uint32_t>(whole(0, 40));
    entry.intervals.push_back({first, end});
  }
  return entry;
}

ContourBody RandomContent::contour() {
  // A ring about a point, or the zigzag of a part of it: neither touches itself.
  ContourBody contour;
  contour.anchor = static_cast<std::uint32_t>(whole(0, 60));
  contour.closed = chance(0.5);
  contour.hole = contour.closed && chance(0.3);
  const int count = whole(4, 30);
  const Eigen::Vector2d middle(real(-200.0, 200.0), real(-200.0, 200.0));
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * kPi * i / count, radius = real(60.0, 120.0);
    contour.vertices.emplace_back((middle + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle))).cast<int>());
  }
  return contour;
}

EdgeBody RandomContent::edge() {
  EdgeBody edge;
  edge.anchor = static_cast<std::uint32_t>(whole(0, 60));
  edge.peer = word();
  edge.peer_epoch = static_cast<std::uint16_t>(word() & 0xffff);
  edge.peer_anchor = static_cast<std::uint32_t>(whole(0, 60));
  edge.T_anchor_peer.pose = pose(30.0);
  Eigen::Matrix3d root;
  for (int i = 0; i < 9; ++i) root(i / 3, i % 3) = real(-0.1, 0.1);
  edge.T_anchor_peer.covariance = root * root.transpose() + 1e-6 * Eigen::Matrix3d::Identity();
  edge.support = whole(1, 63);
  edge.state = static_cast<EdgeState>(whole(0, 2));
  return edge;
}

Record RandomContent::record(std::uint32_t sequence) {
  Record record;
  record.kind = static_cast<RecordKind>(whole(0, 6));
  record.id = static_cast<std::uint32_t>(whole(0, 300));
  record.sequence = sequence;
  record.hops = whole(0, 7);
  record.age = real(0.05, 500.0);
  record.removed = chance(0.15);
  if (record.removed) return record;
  switch (record.kind) {
    case RecordKind::kContour:
      record.body = encode(contour());
      break;
    case RecordKind::kAnchor:
      record.body = encode(AnchorBody{pose(500.0), real(0.001, 5.0), real(0.0001, 1.0)});
      break;
    case RecordKind::kEdge:
      record.body = encode(edge());
      break;
    case RecordKind::kContest:
    case RecordKind::kEndorsement:
      record.body =
          encode(ContourReference{word(), static_cast<std::uint16_t>(word() & 0xffff), static_cast<std::uint32_t>(whole(0, 300)),
                                  static_cast<std::uint32_t>(whole(1, 5000))});
      break;
    case RecordKind::kKeyframe:
      record.body = encode(KeyframeBody{word(), pose(500.0), bytes(static_cast<std::size_t>(whole(0, 120)))});
      break;
    default:
      record.body = bytes(static_cast<std::size_t>(whole(0, 20)));
      break;
  }
  return record;
}

RecordGroup RandomContent::group() {
  RecordGroup group;
  group.origin = word();
  group.epoch = word();
  group.stream = static_cast<RecordStream>(whole(0, 1));
  std::uint32_t sequence = static_cast<std::uint32_t>(whole(1, 2000));
  for (int i = whole(1, 4); i > 0; --i) {
    group.records.push_back(record(sequence));
    group.records.back().gap = static_cast<std::uint32_t>(whole(0, static_cast<int>(std::min(sequence - 1, 3U))));
    sequence += static_cast<std::uint32_t>(whole(1, 5));
  }
  return group;
}

PacketContent RandomContent::packet() {
  PacketContent content;
  content.stamp = word();
  if (chance(0.6)) content.beacon = beacon();
  for (int i = chance(0.5) ? whole(1, 4) : 0; i > 0; --i) {
    content.echoes.push_back({word(), static_cast<std::uint16_t>(word() & 0xffff), word(), real(0.0, 1.0)});
  }
  for (int i = chance(0.5) ? whole(1, 8) : 0; i > 0; --i) content.digest.push_back(digestEntry());
  if (chance(0.6)) content.trajectory = trajectory();
  if (chance(0.3)) content.conflicts.emplace();
  for (int i = content.conflicts ? whole(0, 3) : 0; i > 0; --i) content.conflicts->push_back(conflict());
  if (chance(0.3)) content.observations = observations();
  if (chance(0.5)) content.intent = intent();
  for (int i = whole(0, 2); i > 0; --i) content.records.push_back(group());
  return content;
}

}  // namespace parley
