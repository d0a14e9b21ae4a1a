// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "parley_topology/contour.h"

namespace parley {

enum class VertexClass {
  kCorner,  // of an outline that goes on
  kPillar   // of a small obstacle, seen as a whole
};

/// A convex corner of a grown obstacle: where a shortest way can bend.
struct Vertex {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();   // [m] odom
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();  // unit, from the obstacle outwards
  Eigen::Vector2d previous = Eigen::Vector2d::Zero();   // unit, along the outline to the corner before
  Eigen::Vector2d next = Eigen::Vector2d::Zero();       // unit, along the outline to the corner after
  VertexClass kind = VertexClass::kCorner;
  bool at_unknown = false;  // space that was never seen begins here: edges to others of this kind have no limit of length
  int id = 0;               // [-] kept while the corner is found again near where it was
  int votes = 1;            // [-] times its surroundings changed and it was found again
  Provenance provenance;
};

/// A straight way between two corners, or from one to start or goal.
struct Edge {
  int from = -1;                  // [-] slot of the vertex
  int to = -1;                    // [-] slot of the vertex
  double length = 0.0;            // [m]
  double clearance = 0.0;         // [m] width of the narrowest passage it leads through, capped
  double unknown_length = 0.0;    // [m] through space own sensing has not seen
  double narrow_length = 0.0;     // [m] through narrow passages, weighted by how narrow (0 to 1)
  double tentative_length = 0.0;  // [m] within reach of outlines whose pose is not confirmed
  double cost = 0.0;              // [m] length with what is unknown, narrow or tentative made dearer
  bool measured = false;          // all but the length is worked out when first needed
  Provenance provenance;          // of the less direct of its ends
};

/// Whether a straight way leaving `vertex` in the unit direction `ray` only touches its obstacle, so that it can be part
/// of a shortest way. `slack` is the sine of the angle by which it may miss.
bool isTangent(const Vertex& vertex, const Eigen::Vector2d& ray, double slack);

/// Reduced visibility graph. Vertices and edges live in slots that are used again; a slot stays valid until removed.
class VisibilityGraph {
 public:
  struct Link {
    int to = -1;    // slot of the vertex at the other end
    int edge = -1;  // slot of the edge
  };

  int vertexCount() const { return vertex_count_; }
  int edgeCount() const { return edge_count_; }

  /// Slots are numbered 0 to slotCount() - 1; some are empty.
  int slotCount() const { return static_cast<int>(vertices_.size()); }
  bool has(int slot) const { return alive_[static_cast<std::size_t>(slot)]; }
  const Vertex& vertex(int slot) const { return vertices_[static_cast<std::size_t>(slot)]; }
  Vertex& vertex(int slot) { return vertices_[static_cast<std::size_t>(slot)]; }
  const std::vector<Link>& links(int slot) const { return links_[static_cast<std::size_t>(slot)]; }
  int edgeSlotCount() const { return static_cast<int>(edges_.size()); }
  const Edge& edge(int slot) const { return edges_[static_cast<std::size_t>(slot)]; }
  Edge& edge(int slot) { return edges_[static_cast<std::size_t>(slot)]; }

  /// Copies without the empty slots. Edges still name their ends by slot.
  std::vector<Vertex> vertices() const;
  std::vector<Edge> edges() const;

  int addVertex(const Vertex& vertex);
  /// With all its edges.
  void removeVertex(int slot);
  int addEdge(const Edge& edge);
  void removeEdge(int slot);
  void clear();

 private:
  void unlink(int vertex, int edge);

  std::vector<Vertex> vertices_;
  std::vector<bool> alive_;
  std::vector<std::vector<Link>> links_;
  std::vector<int> free_vertices_;
  std::vector<Edge> edges_;  // an empty slot has from == -1
  std::vector<int> free_edges_;
  int vertex_count_ = 0;
  int edge_count_ = 0;
};

}  // namespace parley
