// SPDX-License-Identifier: BSD-3-Clause
#include "parley_topology/visibility_graph.h"

#include <algorithm>

#include "parley_geometry/polygon.h"

namespace parley {

bool isTangent(const Vertex& vertex, const Eigen::Vector2d& ray, double slack) {
  const double before = cross(ray, vertex.previous), after = cross(ray, vertex.next);
  return (before >= -slack && after >= -slack) || (before <= slack && after <= slack);
}

std::vector<Vertex> VisibilityGraph::vertices() const {
  std::vector<Vertex> result;
  for (int slot = 0; slot < slotCount(); ++slot) {
    if (has(slot)) result.push_back(vertex(slot));
  }
  return result;
}

std::vector<Edge> VisibilityGraph::edges() const {
  std::vector<Edge> result;
  for (const Edge& edge : edges_) {
    if (edge.from >= 0) result.push_back(edge);
  }
  return result;
}

int VisibilityGraph::addVertex(const Vertex& vertex) {
  ++vertex_count_;
  if (free_vertices_.empty()) {
    vertices_.push_back(vertex);
    alive_.push_back(true);
    links_.emplace_back();
    return slotCount() - 1;
  }
  const int slot = free_vertices_.back();
  free_vertices_.pop_back();
  this->vertex(slot) = vertex;
  alive_[static_cast<std::size_t>(slot)] = true;
  return slot;
}

void VisibilityGraph::removeVertex(int slot) {
  while (!links(slot).empty()) removeEdge(links(slot).back().edge);
  alive_[static_cast<std::size_t>(slot)] = false;
  free_vertices_.push_back(slot);
  --vertex_count_;
}

int VisibilityGraph::addEdge(const Edge& edge) {
  int slot = static_cast<int>(edges_.size());
  if (free_edges_.empty()) {
    edges_.push_back(edge);
  } else {
    slot = free_edges_.back();
    free_edges_.pop_back();
    edges_[static_cast<std::size_t>(slot)] = edge;
  }
  links_[static_cast<std::size_t>(edge.from)].push_back({edge.to, slot});
  links_[static_cast<std::size_t>(edge.to)].push_back({edge.from, slot});
  ++edge_count_;
  return slot;
}

void VisibilityGraph::removeEdge(int slot) {
  Edge& edge = edges_[static_cast<std::size_t>(slot)];
  unlink(edge.from, slot);
  unlink(edge.to, slot);
  edge = Edge{};
  free_edges_.push_back(slot);
  --edge_count_;
}

void VisibilityGraph::unlink(int vertex, int edge) {
  std::vector<Link>& links = links_[static_cast<std::size_t>(vertex)];
  const auto link = std::find_if(links.begin(), links.end(), [edge](const Link& l) { return l.edge == edge; });
  *link = links.back();
  links.pop_back();
}

void VisibilityGraph::clear() { *this = VisibilityGraph(); }

}  // namespace parley
