// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "parley_nodelets/map_conversions.h"
#include "parley_nodelets/sensor_conversions.h"

namespace parley {
namespace {

constexpr std::int8_t kUnknown = -1, kFree = 0, kOccupied = 100;  // [%] as nav_msgs has it
constexpr std::int8_t kHalf = 50;                                 // [%]
constexpr std::uint64_t kMostCells = 100'000'000;                 // a larger map is a mistake

/// nav_msgs holds the resolution as a float: back to what was meant, to the micrometre.
double exactResolution(float resolution) { return std::round(static_cast<double>(resolution) * 1e6) / 1e6; }

std::int8_t occupancyOf(CellState state) {
  switch (state) {
    case CellState::kSeenFree:
      return kFree;
    case CellState::kOccupied:
      return kOccupied;
    case CellState::kUnknown:
      break;
  }
  return kUnknown;
}

CellState stateOf(std::int8_t occupancy) {
  if (occupancy < 0) return CellState::kUnknown;
  return occupancy < kHalf ? CellState::kSeenFree : CellState::kOccupied;
}

}  // namespace

nav_msgs::OccupancyGrid toMessage(const LocalMap& map, const std::string& odom_frame) {
  nav_msgs::OccupancyGrid message;
  message.header.stamp = message.info.map_load_time = toRosTime(map.stamp);
  message.header.frame_id = odom_frame;
  message.info.resolution = static_cast<float>(map.frame.resolution);
  message.info.width = static_cast<std::uint32_t>(map.frame.width);
  message.info.height = static_cast<std::uint32_t>(map.frame.height);
  message.info.origin = toPose({map.frame.origin.x(), map.frame.origin.y(), 0.0});
  message.data.reserve(map.cells.size());
  for (const CellState state : map.cells) message.data.push_back(occupancyOf(state));
  return message;
}

std::optional<LocalMap> fromMessage(const nav_msgs::OccupancyGrid& message) {
  const nav_msgs::MapMetaData& info = message.info;
  const std::uint64_t cells = static_cast<std::uint64_t>(info.width) * info.height;
  const std::optional<Attitude> attitude = attitudeOf(info.origin.orientation);
  if (cells == 0 || cells > kMostCells || cells != message.data.size() || !attitude || std::abs(attitude->yaw) > 1e-6) {
    return std::nullopt;
  }
  LocalMap map;
  map.stamp = message.header.stamp.toSec();
  map.frame.origin = {info.origin.position.x, info.origin.position.y};
  map.frame.resolution = exactResolution(info.resolution);
  map.frame.width = static_cast<int>(info.width);
  map.frame.height = static_cast<int>(info.height);
  map.cells.reserve(message.data.size());
  for (const std::int8_t occupancy : message.data) map.cells.push_back(stateOf(occupancy));
  if (!isConsistent(map)) return std::nullopt;
  return map;
}

parley_msgs::Graph toMessage(const VisibilityGraph& graph, double stamp, const std::string& odom_frame) {
  parley_msgs::Graph message;
  message.header.stamp = toRosTime(stamp);
  message.header.frame_id = odom_frame;
  for (const Vertex& vertex : graph.vertices()) {
    parley_msgs::GraphVertex& part = message.vertices.emplace_back();
    part.id = vertex.id;
    part.kind = vertex.kind == VertexClass::kPillar ? parley_msgs::GraphVertex::PILLAR : parley_msgs::GraphVertex::CORNER;
    part.position.x = vertex.position.x();
    part.position.y = vertex.position.y();
    part.origin = vertex.provenance.origin;
    part.hops = vertex.provenance.hops;
    part.stamp = toRosTime(vertex.provenance.stamp);
  }
  for (const Edge& edge : graph.edges()) {
    parley_msgs::GraphEdge& part = message.edges.emplace_back();
    part.from = graph.vertex(edge.from).id;
    part.to = graph.vertex(edge.to).id;
    part.length = edge.length;
    part.clearance = edge.clearance;
    part.unknown_length = edge.unknown_length;
    part.cost = edge.cost;
    part.origin = edge.provenance.origin;
    part.hops = edge.provenance.hops;
    part.stamp = toRosTime(edge.provenance.stamp);
  }
  return message;
}

}  // namespace parley
