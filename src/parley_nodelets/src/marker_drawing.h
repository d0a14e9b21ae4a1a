// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/Marker.h>

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace parley {

inline std_msgs::ColorRGBA colour(float r, float g, float b, float a) {
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
    marker_.action = visualization_msgs::Marker::ADD;
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

  /// From each point to the next, and round to the first if it is closed.
  void chain(const std::vector<Eigen::Vector2d>& points, bool closed) {
    const std::size_t n = points.size();
    for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) line(points[i], points[(i + 1) % n]);
  }

  /// RViz warns about markers without points: one that is empty deletes what was drawn before.
  visualization_msgs::Marker finished(const std_msgs::Header& header) && {
    marker_.header = header;
    if (marker_.points.empty()) marker_.action = visualization_msgs::Marker::DELETE;
    return std::move(marker_);
  }

 private:
  visualization_msgs::Marker marker_;
  std::size_t most_points_;
};

}  // namespace parley
