// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/topology_markers.h"

#include "parley_nodelets/sensor_conversions.h"

namespace parley {
namespace {

using visualization_msgs::Marker;

std_msgs::ColorRGBA colour(float r, float g, float b, float a) {
  std_msgs::ColorRGBA c;
  c.r = r;
  c.g = g;
  c.b = b;
  c.a = a;
  return c;
}

/// One marker that grows by points up to its bound.
class Drawing {
 public:
  Drawing(int type, const char* name, double width, const std_msgs::ColorRGBA& c, std::size_t most_points)
      : most_points_(most_points) {
    marker_.ns = name;
    marker_.type = type;
    marker_.action = Marker::ADD;
    marker_.pose.orientation.w = 1.0;
    marker_.scale.x = marker_.scale.y = width;
    marker_.color = c;
  }

  void point(const Eigen::Vector2d& p) {
    if (marker_.points.size() >= most_points_) return;
    geometry_msgs::Point point;
    point.x = p.x();
    point.y = p.y();
    marker_.points.push_back(point);
  }

  /// Both ends or none.
  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    if (marker_.points.size() + 2 > most_points_) return;
    point(a);
    point(b);
  }

  /// RViz warns about markers without points: one that is empty deletes what was drawn before.
  Marker finished(const std_msgs::Header& header) && {
    marker_.header = header;
    if (marker_.points.empty()) marker_.action = Marker::DELETE;
    return std::move(marker_);
  }

 private:
  Marker marker_;
  std::size_t most_points_;
};

Drawing drawContours(const std::vector<Contour>& contours, std::size_t most_points) {
  Drawing drawing(Marker::LINE_LIST, "contours", 0.05, colour(0.9F, 0.3F, 0.1F, 1.0F), most_points);
  for (const Contour& contour : contours) {
    const std::size_t n = contour.polygon.size();
    for (std::size_t i = 0; i + (contour.closed ? 0 : 1) < n; ++i) {
      drawing.line(contour.polygon[i], contour.polygon[(i + 1) % n]);
    }
  }
  return drawing;
}

Drawing drawEdges(const VisibilityGraph& graph, std::size_t most_points) {
  Drawing drawing(Marker::LINE_LIST, "edges", 0.02, colour(0.3F, 0.6F, 0.9F, 0.25F), most_points);
  for (const Edge& edge : graph.edges()) drawing.line(graph.vertex(edge.from).position, graph.vertex(edge.to).position);
  return drawing;
}

Drawing drawVertices(const VisibilityGraph& graph, std::size_t most_points) {
  Drawing drawing(Marker::POINTS, "vertices", 0.12, colour(0.1F, 0.4F, 0.9F, 1.0F), most_points);
  for (const Vertex& vertex : graph.vertices()) drawing.point(vertex.position);
  return drawing;
}

Drawing drawRoute(const Route& route, std::size_t most_points) {
  Drawing drawing(Marker::LINE_STRIP, "route", 0.08, colour(0.1F, 0.7F, 0.2F, 1.0F), most_points);
  for (const Eigen::Vector2d& p : route.points) drawing.point(p);
  return drawing;
}

}  // namespace

visualization_msgs::MarkerArray topologyMarkers(const std::vector<Contour>& contours, const VisibilityGraph& graph,
                                                const Route& route, double stamp, const std::string& odom_frame,
                                                std::size_t most_points) {
  std_msgs::Header header;
  header.stamp = toRosTime(stamp);
  header.frame_id = odom_frame;
  visualization_msgs::MarkerArray markers;
  markers.markers = {drawContours(contours, most_points).finished(header), drawEdges(graph, most_points).finished(header),
                     drawVertices(graph, most_points).finished(header), drawRoute(route, most_points).finished(header)};
  return markers;
}

}  // namespace parley
