// SPDX-License-Identifier: BSD-3-Clause
#include "corners.h"

#include <optional>

#include "parley_geometry/polygon.h"

namespace parley {
namespace {

constexpr double kLeastTurn = 0.1;        // [rad] straighter corners are none
constexpr double kDirectionStep = 0.05;   // [rad] outline directions are rounded, so that a wall that grows keeps its far corner
constexpr double kSeamTolerance = 0.4;    // [-] of the simplification's, for points that are there only because a tile ends
constexpr double kPillarPerimeter = 3.0;  // [m]

/// The last but one point of the chain that leads into an open chain's first point.
std::optional<Eigen::Vector2d> pointBefore(const TiledMap& map, const Chain& chain) {
  const Tile* tile = map.find(tileOf(chain.before.x()), tileOf(chain.before.y()));
  if (!tile) return std::nullopt;
  for (const Chain& other : tile->chains) {
    if (!other.closed && other.last == chain.before && other.end == chain.first) return other.points[other.points.size() - 2];
  }
  return std::nullopt;
}

Eigen::Vector2d roundedDirection(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d d = to - from;
  const double angle = std::round(std::atan2(d.y(), d.x()) / kDirectionStep) * kDirectionStep;
  return {std::cos(angle), std::sin(angle)};
}

std::optional<Vertex> cornerAt(const Eigen::Vector2d& before, const Eigen::Vector2d& at, const Eigen::Vector2d& after, int turn) {
  if (cross(at - before, after - at) * turn <= 0.0) return std::nullopt;
  const Eigen::Vector2d to_before = (before - at).normalized(), to_after = (after - at).normalized();
  const Eigen::Vector2d bisector = -(to_before + to_after);
  if (!(bisector.norm() > kLeastTurn)) return std::nullopt;  // its length is twice the sine of half the turn
  Vertex vertex;
  vertex.position = at;
  vertex.direction = bisector.normalized();
  vertex.previous = roundedDirection(at, before);
  vertex.next = roundedDirection(at, after);
  return vertex;
}

bool isAtUnknown(const TiledMap& map, const Vertex& vertex) {
  for (const double ahead : {0.15, 0.3, 0.45}) {
    const Eigen::Vector2d p = vertex.position + ahead * vertex.direction;
    if (!(map.flags(map.cellOf(p.x()), map.cellOf(p.y())) & kSeen)) return true;
  }
  return false;
}

Provenance provenanceOf(const TiledMap& map, const Vertex& vertex, const FieldShape& shape, const LayerStore& layers) {
  const int spread = 2;
  const Eigen::Vector2d core = vertex.position - shape.grown_radius * vertex.direction;
  const int cx = map.cellOf(core.x()), cy = map.cellOf(core.y());
  const Provenance* owner = nullptr;
  for (int y = cy - spread; y <= cy + spread; ++y) {
    for (int x = cx - spread; x <= cx + spread; ++x) {
      const std::uint8_t flags = map.flags(x, y);
      if (flags & kOwn) return {};
      if (!owner && (flags & kFused)) owner = layers.ownerOf(x, y);
    }
  }
  return owner ? *owner : Provenance{};
}

void appendCorners(const TiledMap& map, const Chain& chain, double simplify, std::vector<Vertex>& corners) {
  const std::size_t n = chain.points.size();
  if (n < 2) return;
  const bool pillar = chain.closed && perimeter(chain.points) < kPillarPerimeter;
  for (std::size_t i = 0; i + (chain.closed ? 0 : 1) < n; ++i) {
    std::optional<Eigen::Vector2d> before = chain.points[(i + n - 1) % n];
    const Eigen::Vector2d& after = chain.points[(i + 1) % n];
    const bool seam = !chain.closed && i == 0;
    if (seam) before = pointBefore(map, chain);
    if (!before || (seam && pointSegmentDistance(chain.points[i], *before, after) < kSeamTolerance * simplify)) continue;
    std::optional<Vertex> corner = cornerAt(*before, chain.points[i], after, chain.turn);
    if (!corner) continue;
    if (pillar) corner->kind = VertexClass::kPillar;
    corners.push_back(*corner);
  }
}

}  // namespace

std::vector<Vertex> cornersOf(const TiledMap& map, const Tile& tile, const FieldShape& shape, double simplify,
                              const LayerStore& layers) {
  std::vector<Vertex> corners;
  for (const Chain& chain : tile.chains) appendCorners(map, chain, simplify, corners);
  for (Vertex& corner : corners) {
    corner.at_unknown = isAtUnknown(map, corner);
    if (layers.count() > 0) corner.provenance = provenanceOf(map, corner, shape, layers);
  }
  return corners;
}

}  // namespace parley
