// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/topology_markers.h"

#include "marker_drawing.h"
#include "parley_nodelets/sensor_conversions.h"

namespace parley {
namespace {

using visualization_msgs::Marker;

Drawing drawContours(const std::vector<Contour>& contours, std::size_t most_points) {
  Drawing drawing(Marker::LINE_LIST, "contours", 0.05, colour(0.9F, 0.3F, 0.1F, 1.0F), most_points);
  for (const Contour& contour : contours) drawing.chain(contour.polygon, contour.closed);
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
