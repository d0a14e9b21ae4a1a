// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cassert>

#include "quantity.h"
#include "section_codec.h"

namespace parley {
namespace {

constexpr Quantity kStart{0.005, 14, true};  // [s]
constexpr Quantity kStep{0.01, 8, false};    // [s]
constexpr std::int64_t kTurn = std::int64_t{1} << kCoarseYawBits;
constexpr std::int64_t kFarthest = std::int64_t{1} << (kCoarsePosition.bits - 1);

/// A pose on the grid of the wire.
struct Cell {
  std::int64_t x = 0, y = 0, yaw = 0;  // [-]
};

Cell cellOf(const Pose2& pose) {
  return {codeOf(pose.x, kCoarsePosition), codeOf(pose.y, kCoarsePosition), angleCode(pose.yaw, kCoarseYawBits)};
}

Pose2 poseOf(const Cell& cell) {
  return {static_cast<double>(cell.x) * kCoarsePosition.step, static_cast<double>(cell.y) * kCoarsePosition.step,
          angleOf(cell.yaw, kCoarseYawBits)};
}

/// The angle in [-half, half) turns.
std::int64_t wrapped(std::int64_t yaw) {
  const std::int64_t rest = ((yaw % kTurn) + kTurn) % kTurn;
  return rest >= kTurn / 2 ? rest - kTurn : rest;
}

/// Where motion as from the pose before the last to the last leads; from the first pose on, nowhere.
Cell predicted(const std::vector<Cell>& cells) {
  const Cell& last = cells.back();
  if (cells.size() < 2) return last;
  const Cell& before = cells[cells.size() - 2];
  return {2 * last.x - before.x, 2 * last.y - before.y, last.yaw + wrapped(last.yaw - before.yaw)};
}

}  // namespace

void encode(BitWriter& writer, const TrajectoryMessage& trajectory) {
  assert(!trajectory.poses.empty() && trajectory.poses.size() <= kMaxPoses);
  std::vector<Cell> cells{cellOf(trajectory.poses.front())};
  std::vector<std::int32_t> position, yaw;
  for (std::size_t i = 1; i < trajectory.poses.size(); ++i) {
    const Cell cell = cellOf(trajectory.poses[i]), expected = predicted(cells);
    position.push_back(static_cast<std::int32_t>(cell.x - expected.x));
    position.push_back(static_cast<std::int32_t>(cell.y - expected.y));
    yaw.push_back(static_cast<std::int32_t>(wrapped(cell.yaw - expected.yaw)));
    cells.push_back(cell);
  }
  const int position_order = bestOrder(position), yaw_order = bestOrder(yaw);
  writer.bits(static_cast<std::uint64_t>(trajectory.state), 4);
  write(writer, trajectory.start, kStart);
  write(writer, trajectory.step, kStep);
  writer.bits(cells.size(), 6);
  writer.bits(static_cast<std::uint64_t>(position_order), 3);
  writer.bits(static_cast<std::uint64_t>(yaw_order), 3);
  writePose(writer, trajectory.poses.front(), kCoarsePosition, kCoarseYawBits);
  for (std::size_t i = 0; i < yaw.size(); ++i) {
    writer.signedGolomb(position[2 * i], position_order);
    writer.signedGolomb(position[2 * i + 1], position_order);
    writer.signedGolomb(yaw[i], yaw_order);
  }
}

std::optional<TrajectoryMessage> decodeTrajectory(BitReader reader) {
  TrajectoryMessage trajectory;
  const std::uint64_t state = reader.bits(4);
  if (state > static_cast<std::uint64_t>(DriveState::kDead)) return std::nullopt;
  trajectory.state = static_cast<DriveState>(state);
  trajectory.start = read(reader, kStart);
  trajectory.step = read(reader, kStep);
  const std::size_t count = reader.bits(6);
  const int position_order = static_cast<int>(reader.bits(3)), yaw_order = static_cast<int>(reader.bits(3));
  if (count == 0 || count > kMaxPoses || trajectory.step <= 0.0) return std::nullopt;
  Cell first;
  first.x = readSigned(reader, kCoarsePosition.bits);
  first.y = readSigned(reader, kCoarsePosition.bits);
  first.yaw = static_cast<std::int64_t>(reader.bits(kCoarseYawBits));
  std::vector<Cell> cells{first};
  while (cells.size() < count && reader.ok()) {
    Cell cell = predicted(cells);
    cell.x += reader.signedGolomb(position_order);
    cell.y += reader.signedGolomb(position_order);
    cell.yaw = (wrapped(cell.yaw + reader.signedGolomb(yaw_order)) + kTurn) % kTurn;
    if (std::max(std::abs(cell.x), std::abs(cell.y)) >= kFarthest) return std::nullopt;
    cells.push_back(cell);
  }
  for (const Cell& cell : cells) trajectory.poses.push_back(poseOf(cell));
  return reader.ok() ? std::make_optional(trajectory) : std::nullopt;
}

}  // namespace parley
