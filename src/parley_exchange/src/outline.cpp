// SPDX-License-Identifier: BSD-3-Clause
#include "outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "checks.h"

namespace parley {
namespace {

constexpr std::size_t kMaxSamples = 1000;  // [-]

using Vertices = std::vector<Eigen::Vector2i>;

/// On the grid, without repetitions. Empty if out of reach.
Vertices gridded(const Polygon& polygon, bool closed) {
  Vertices vertices;
  for (const Eigen::Vector2d& point : polygon) {
    const Eigen::Vector2d cell = (point / kVertexStep).array().round();
    if (!(cell.cwiseAbs().maxCoeff() <= kVertexLimit)) return {};
    const Eigen::Vector2i vertex = cell.cast<int>();
    if (vertices.empty() || vertices.back() != vertex) vertices.push_back(vertex);
  }
  while (closed && vertices.size() > 1 && vertices.front() == vertices.back()) vertices.pop_back();
  return vertices;
}

/// An open chain in pieces that do not touch themselves; neighbours share a vertex.
void cutChain(const Vertices& chain, ContourBody piece, std::vector<ContourBody>& pieces) {
  if (chain.size() < 2) return;
  if (chain.size() <= kMaxVertices && isOutline(chain, false)) {
    piece.vertices = chain;
    pieces.push_back(std::move(piece));
    return;
  }
  const auto middle = chain.begin() + static_cast<std::ptrdiff_t>(chain.size() / 2);
  cutChain(Vertices(chain.begin(), middle + 1), piece, pieces);
  cutChain(Vertices(middle, chain.end()), piece, pieces);
}

std::size_t segmentCount(const Polygon& polygon, bool closed) { return closed ? polygon.size() : polygon.size() - 1; }

bool within(const Polygon& points, const Polygon& outline, bool closed, double tolerance) {
  return std::all_of(points.begin(), points.end(),
                     [&](const Eigen::Vector2d& point) { return distanceTo(outline, closed, point) <= tolerance; });
}

}  // namespace

std::vector<ContourBody> cutOutline(const Polygon& polygon, bool closed, bool hole, std::uint32_t anchor) {
  Vertices vertices = gridded(polygon, closed);
  std::vector<ContourBody> pieces;
  ContourBody piece;
  piece.anchor = anchor;
  if (closed && vertices.size() <= kMaxVertices && isOutline(vertices, true)) {
    piece.closed = true;
    piece.hole = hole;
    piece.vertices = vertices;
    return {piece};
  }
  if (closed && vertices.size() > 2) vertices.push_back(vertices.front());
  cutChain(vertices, piece, pieces);
  return pieces;
}

Polygon polygonOf(const ContourBody& contour) {
  Polygon polygon;
  for (const Eigen::Vector2i& vertex : contour.vertices) polygon.push_back(kVertexStep * vertex.cast<double>());
  return polygon;
}

double distanceTo(const Polygon& polygon, bool closed, const Eigen::Vector2d& point) {
  double least = polygon.size() == 1 ? (polygon.front() - point).norm() : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < segmentCount(polygon, closed); ++i) {
    least = std::min(least, pointSegmentDistance(point, polygon[i], polygon[(i + 1) % polygon.size()]));
  }
  return least;
}

bool agree(const Polygon& a, const Polygon& b, bool closed, double tolerance) {
  return within(a, b, closed, tolerance) && within(b, a, closed, tolerance);
}

std::vector<Eigen::Vector2d> samplesOf(const Polygon& polygon, bool closed, double spacing) {
  std::vector<Eigen::Vector2d> samples;
  for (std::size_t i = 0; i < segmentCount(polygon, closed); ++i) {
    const Eigen::Vector2d &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double count = std::max(1.0, std::ceil((to - from).norm() / spacing));
    for (double k = 0.0; k < count && samples.size() < kMaxSamples; k += 1.0) samples.push_back(from + (to - from) * (k / count));
  }
  if (!closed) samples.push_back(polygon.back());
  return samples;
}

}  // namespace parley
