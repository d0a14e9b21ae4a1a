// SPDX-License-Identifier: BSD-3-Clause
#include "section_codec.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "quantity.h"

namespace parley {
namespace {

constexpr int kStateCount = static_cast<int>(DriveState::kDead) + 1;

constexpr Quantity kAge{0.005, 8, false};             // [s]
constexpr Quantity kSpeed{0.02, 10, true};            // [m/s]
constexpr Quantity kTurnRate{0.02, 10, true};         // [rad/s]
constexpr Quantity kSide{0.01, 9, false};             // [m]
constexpr Quantity kTopSpeed{0.05, 8, false};         // [m/s]
constexpr Quantity kTopTurnRate{0.05, 8, false};      // [rad/s]
constexpr Quantity kAcceleration{0.1, 8, false};      // [m/s^2]
constexpr Quantity kTurnAcceleration{0.2, 8, false};  // [rad/s^2]
constexpr Quantity kHeard{1.0 / 15.0, 4, false};      // [-]
constexpr Quantity kCost{0.1, 12, false};             // [-]
constexpr Quantity kCorner{0.05, 18, true};           // [m]
constexpr Quantity kLease{0.1, 7, false};             // [s]
constexpr Quantity kRange{0.005, 12, false};          // [m]
constexpr int kBearingBits = 12;                      // [-]
constexpr Quantity kChord{0.02, 6, false};            // [m]
constexpr Quantity kScanStep{0.005, 12, true};        // [m] from the newest scan to one before it
constexpr double kFarthestScan = 10.2;                // [m] of these, that the wire has room for
constexpr double kOldestScan = 1.277;                 // [s]

void writeState(BitWriter& writer, DriveState state) { writer.bits(static_cast<std::uint64_t>(state), 4); }

DriveState readState(BitReader& reader) {
  const int state = static_cast<int>(reader.bits(4));
  if (state >= kStateCount) reader.fail();
  return state < kStateCount ? static_cast<DriveState>(state) : DriveState::kStopped;
}

void writeBlobs(BitWriter& writer, const std::vector<Observation>& blobs) {
  const std::size_t count = std::min(blobs.size(), kMaxBlobs);
  writer.bits(count, 4);
  for (std::size_t i = 0; i < count; ++i) {
    write(writer, blobs[i].range, kRange);
    writeAngle(writer, blobs[i].bearing, kBearingBits);
    write(writer, blobs[i].chord, kChord);
  }
}

std::vector<Observation> readBlobs(BitReader& reader) {
  const std::size_t count = reader.bits(4);
  if (count > kMaxBlobs) reader.fail();
  std::vector<Observation> blobs(std::min(count, kMaxBlobs));
  for (Observation& blob : blobs) {
    blob.range = read(reader, kRange);
    blob.bearing = readAngle(reader, kBearingBits);
    blob.chord = read(reader, kChord);
  }
  return blobs;
}

/// As it will be read. [m]
double onGrid(double coordinate) { return static_cast<double>(codeOf(coordinate, kFinePosition)) * kFinePosition.step; }

/// What would be cut is not told at all.
bool fitsBehind(const ObservationMessage& newest, const ObservationMessage& scan) {
  const Eigen::Vector2d step = scan.pose.position() - newest.pose.position();
  return scan.age <= kOldestScan && step.cwiseAbs().maxCoeff() <= kFarthestScan;
}

/// A robot must not look smaller than it is.
double roundedUp(double side) { return std::ceil(side / kSide.step - 1e-6) * kSide.step; }

}  // namespace

bool isName(const std::string& name) {
  return !name.empty() && name.size() <= kMaxName &&
         std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c <= '~'; });
}

void encode(BitWriter& writer, const Beacon& beacon) {
  assert(isName(beacon.name));
  write(writer, beacon.age, kAge);
  writePose(writer, beacon.pose, kCoarsePosition, kCoarseYawBits);
  write(writer, beacon.twist.speed, kSpeed);
  write(writer, beacon.twist.turn_rate, kTurnRate);
  writeState(writer, beacon.state);
  write(writer, roundedUp(beacon.footprint.length), kSide);
  write(writer, roundedUp(beacon.footprint.width), kSide);
  write(writer, beacon.limits.speed, kTopSpeed);
  write(writer, beacon.limits.turn_rate, kTopTurnRate);
  write(writer, beacon.limits.acceleration, kAcceleration);
  write(writer, beacon.limits.turn_acceleration, kTurnAcceleration);
  writer.bits(static_cast<std::uint64_t>(std::clamp(beacon.neighbours, 0, 127)), 7);
  writer.bits(beacon.map_hash, 32);
  writer.bits(beacon.name.size(), 5);
  for (const char letter : beacon.name) writer.bits(static_cast<std::uint64_t>(letter), 7);
}

std::optional<Beacon> decodeBeacon(BitReader reader) {
  Beacon beacon;
  beacon.age = read(reader, kAge);
  beacon.pose = readPose(reader, kCoarsePosition, kCoarseYawBits);
  beacon.twist.speed = read(reader, kSpeed);
  beacon.twist.turn_rate = read(reader, kTurnRate);
  beacon.state = readState(reader);
  beacon.footprint.length = read(reader, kSide);
  beacon.footprint.width = read(reader, kSide);
  beacon.limits.speed = read(reader, kTopSpeed);
  beacon.limits.turn_rate = read(reader, kTopTurnRate);
  beacon.limits.acceleration = read(reader, kAcceleration);
  beacon.limits.turn_acceleration = read(reader, kTurnAcceleration);
  beacon.neighbours = static_cast<int>(reader.bits(7));
  beacon.map_hash = static_cast<std::uint32_t>(reader.bits(32));
  const std::size_t length = reader.bits(5);
  for (std::size_t i = 0; i < length && reader.ok(); ++i) beacon.name.push_back(static_cast<char>(reader.bits(7)));
  return reader.ok() && isName(beacon.name) ? std::make_optional(beacon) : std::nullopt;
}

void encode(BitWriter& writer, const std::vector<Echo>& echoes) {
  const std::size_t count = std::min(echoes.size(), kMaxEchoes);
  writer.bits(count, 4);
  for (std::size_t i = 0; i < count; ++i) {
    writer.bits(echoes[i].robot, 32);
    writer.bits(echoes[i].counter, 16);
    writer.bits(echoes[i].difference, 32);
    write(writer, echoes[i].heard, kHeard);
  }
}

std::optional<std::vector<Echo>> decodeEchoes(BitReader reader) {
  std::vector<Echo> echoes(reader.bits(4));
  for (Echo& echo : echoes) {
    echo.robot = static_cast<RobotId>(reader.bits(32));
    echo.counter = static_cast<std::uint16_t>(reader.bits(16));
    echo.difference = static_cast<std::uint32_t>(reader.bits(32));
    echo.heard = read(reader, kHeard);
  }
  return reader.ok() ? std::make_optional(echoes) : std::nullopt;
}

void encode(BitWriter& writer, const std::vector<DigestEntry>& digest) {
  const std::size_t count = std::min(digest.size(), kMaxDigest);
  writer.bits(count, 5);
  for (std::size_t i = 0; i < count; ++i) {
    const DigestEntry& entry = digest[i];
    const std::size_t intervals = std::min(entry.intervals.size(), kMaxIntervals);
    writer.bits(entry.origin, 32);
    writer.bits(static_cast<std::uint64_t>(entry.stream), 2);
    writer.bits(entry.epoch, 16);
    writer.bits(intervals, 3);
    std::uint32_t end = 0;
    for (std::size_t j = 0; j < intervals; ++j) {
      writer.golomb(entry.intervals[j].first - end - 1, j == 0 ? 0 : 2);
      writer.golomb(entry.intervals[j].last - entry.intervals[j].first, j == 0 ? 5 : 2);
      end = entry.intervals[j].last;
    }
  }
}

std::optional<std::vector<DigestEntry>> decodeDigest(BitReader reader) {
  std::vector<DigestEntry> digest(reader.bits(5));
  for (DigestEntry& entry : digest) {
    entry.origin = static_cast<RobotId>(reader.bits(32));
    const std::uint64_t stream = reader.bits(2);
    entry.epoch = static_cast<std::uint16_t>(reader.bits(16));
    const std::size_t intervals = reader.bits(3);
    if (!reader.ok() || stream > 1 || intervals > kMaxIntervals) return std::nullopt;
    entry.stream = static_cast<RecordStream>(stream);
    std::uint64_t end = 0;
    for (std::size_t j = 0; j < intervals; ++j) {
      const std::uint64_t first = end + 1 + reader.golomb(j == 0 ? 0 : 2);
      end = first + reader.golomb(j == 0 ? 5 : 2);
      if (!reader.ok() || end > 0x7fffffff) return std::nullopt;
      entry.intervals.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end)});
    }
  }
  return reader.ok() ? std::make_optional(digest) : std::nullopt;
}

void encode(BitWriter& writer, const IntentMessage& intent) {
  assert(!intent.way.empty() && intent.way.size() <= kMaxWay);
  std::vector<std::int32_t> steps;
  for (std::size_t i = 1; i < intent.way.size(); ++i) {
    for (const int axis : {0, 1}) {
      const std::int64_t step = codeOf(intent.way[i][axis], kCorner) - codeOf(intent.way[i - 1][axis], kCorner);
      steps.push_back(static_cast<std::int32_t>(step));
    }
  }
  const int order = bestOrder(steps);
  write(writer, intent.priority, kCost);
  writer.bits(intent.holder, 32);
  writer.bits(static_cast<std::uint64_t>(std::clamp(intent.depth, 0, kMaxDepth)), 4);
  writer.bits(intent.way.size(), 4);
  writer.bits(static_cast<std::uint64_t>(order), 3);
  write(writer, intent.way.front().x(), kCorner);
  write(writer, intent.way.front().y(), kCorner);
  for (const std::int32_t step : steps) writer.signedGolomb(step, order);
}

std::optional<IntentMessage> decodeIntent(BitReader reader) {
  constexpr std::int64_t kFarthest = std::int64_t{1} << (kCorner.bits - 1);
  IntentMessage intent;
  intent.priority = read(reader, kCost);
  intent.holder = static_cast<RobotId>(reader.bits(32));
  intent.depth = static_cast<int>(reader.bits(4));
  const std::size_t count = reader.bits(4);
  const int order = static_cast<int>(reader.bits(3));
  std::int64_t x = readSigned(reader, kCorner.bits);
  std::int64_t y = readSigned(reader, kCorner.bits);
  for (std::size_t i = 0; i < count && reader.ok(); ++i) {
    if (i > 0) {
      x += reader.signedGolomb(order);
      y += reader.signedGolomb(order);
    }
    if (std::max(std::abs(x), std::abs(y)) >= kFarthest) return std::nullopt;
    intent.way.emplace_back(static_cast<double>(x) * kCorner.step, static_cast<double>(y) * kCorner.step);
  }
  return reader.ok() && count > 0 ? std::make_optional(intent) : std::nullopt;
}

void encode(BitWriter& writer, const std::vector<Conflict>& conflicts) {
  const std::size_t count = std::min(conflicts.size(), kMaxConflicts);
  writer.bits(count, 3);
  for (std::size_t i = 0; i < count; ++i) {
    const Conflict& conflict = conflicts[i];
    writer.bits(conflict.peer, 32);
    writer.bits(static_cast<std::uint64_t>(conflict.kind), 2);
    writer.bits(static_cast<std::uint64_t>(conflict.round) & 63U, 6);
    write(writer, conflict.cost, kCost);
    write(writer, conflict.lease, kLease);
    writer.flag(conflict.place.has_value());
    if (!conflict.place) continue;
    write(writer, conflict.place->x(), kCoarsePosition);
    write(writer, conflict.place->y(), kCoarsePosition);
  }
}

std::optional<std::vector<Conflict>> decodeConflicts(BitReader reader) {
  std::vector<Conflict> conflicts(reader.bits(3));
  for (Conflict& conflict : conflicts) {
    conflict.peer = static_cast<RobotId>(reader.bits(32));
    const std::uint64_t kind = reader.bits(2);
    if (kind > static_cast<std::uint64_t>(ConflictKind::kRelease)) return std::nullopt;
    conflict.kind = static_cast<ConflictKind>(kind);
    conflict.round = static_cast<int>(reader.bits(6));
    conflict.cost = read(reader, kCost);
    conflict.lease = read(reader, kLease);
    if (!reader.flag()) continue;
    const double x = read(reader, kCoarsePosition);
    conflict.place = Eigen::Vector2d(x, read(reader, kCoarsePosition));
  }
  return reader.ok() ? std::make_optional(conflicts) : std::nullopt;
}

void encode(BitWriter& writer, const std::vector<ObservationMessage>& scans) {
  assert(!scans.empty());
  const ObservationMessage& newest = scans.front();
  write(writer, newest.age, kAge);
  writePose(writer, newest.pose, kFinePosition, kFineYawBits);
  writeBlobs(writer, newest.blobs);
  std::vector<const ObservationMessage*> earlier;
  for (std::size_t i = 1; i < scans.size() && i < kMaxObservedScans; ++i) {
    if (fitsBehind(newest, scans[i])) earlier.push_back(&scans[i]);
  }
  if (earlier.empty()) return;
  writer.bits(earlier.size(), 3);
  for (const ObservationMessage* scan : earlier) {
    write(writer, scan->age, kAge);
    write(writer, onGrid(scan->pose.x) - onGrid(newest.pose.x), kScanStep);
    write(writer, onGrid(scan->pose.y) - onGrid(newest.pose.y), kScanStep);
    writeAngle(writer, scan->pose.yaw, kFineYawBits);
    writeBlobs(writer, scan->blobs);
  }
}

std::optional<std::vector<ObservationMessage>> decodeObservations(BitReader reader) {
  std::vector<ObservationMessage> scans(1);
  scans[0].age = read(reader, kAge);
  scans[0].pose = readPose(reader, kFinePosition, kFineYawBits);
  scans[0].blobs = readBlobs(reader);
  // What is less than a byte only fills the last one.
  if (reader.ok() && reader.remainingBits() >= 8) scans.resize(1 + reader.bits(3));
  for (std::size_t i = 1; i < scans.size(); ++i) {
    scans[i].age = read(reader, kAge);
    scans[i].pose.x = scans[0].pose.x + read(reader, kScanStep);
    scans[i].pose.y = scans[0].pose.y + read(reader, kScanStep);
    scans[i].pose.yaw = readAngle(reader, kFineYawBits);
    scans[i].blobs = readBlobs(reader);
  }
  return reader.ok() ? std::make_optional(scans) : std::nullopt;
}

}  // namespace parley
