// SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "explanation.h"

namespace parley::sim {
namespace {

constexpr double kWindow = 10.0;  // [m]
constexpr double kScale = 100.0;  // [px/m]
constexpr int kShift = 4;         // bits of a pixel's fraction in OpenCV's coordinates
// Blue, green, red.
const cv::Scalar kUnknown(205, 205, 205), kFree(255, 255, 255), kSolid(70, 64, 60), kGraph(235, 210, 190), kRoute(214, 112, 20),
    kPath(60, 150, 30), kCommitted(50, 30, 200), kReturn(40, 30, 215), kTransient(0, 140, 255), kTrack(190, 90, 235),
    kInk(50, 45, 40);

/// A window of the odom frame.
class Canvas {
 public:
  explicit Canvas(const Eigen::Vector2d& center)
      : corner_(center - Eigen::Vector2d(0.5 * kWindow, -0.5 * kWindow)),
        image_(static_cast<int>(kWindow * kScale), static_cast<int>(kWindow * kScale), CV_8UC3, kUnknown) {}

  void cells(const LocalMap& map) {
    for (int y = 0; y < map.frame.height; ++y) {
      for (int x = 0; x < map.frame.width; ++x) {
        const CellState state = map.at(Eigen::Vector2i(x, y));
        if (state == CellState::kUnknown) continue;
        const Eigen::Vector2d half(0.5 * map.frame.resolution, 0.5 * map.frame.resolution), middle = map.frame.centerOf({x, y});
        cv::rectangle(image_, pixel(middle - half), pixel(middle + half), state == CellState::kOccupied ? kSolid : kFree,
                      cv::FILLED, cv::LINE_8, kShift);
      }
    }
  }
  void polyline(const std::vector<Eigen::Vector2d>& points, const cv::Scalar& color, int thickness, bool closed = false) {
    std::vector<cv::Point> pixels;
    pixels.reserve(points.size());
    for (const Eigen::Vector2d& p : points) pixels.push_back(pixel(p));
    cv::polylines(image_, pixels, closed, color, thickness, cv::LINE_AA, kShift);
  }
  void disc(const Eigen::Vector2d& p, double radius, const cv::Scalar& color, int thickness) {
    cv::circle(image_, pixel(p), static_cast<int>(radius * kScale * (1 << kShift)), color, thickness, cv::LINE_AA, kShift);
  }
  void text(const Eigen::Vector2d& p, const std::string& words) {
    const cv::Point at = pixel(p);
    cv::putText(image_, words, {at.x >> kShift, at.y >> kShift}, cv::FONT_HERSHEY_SIMPLEX, 0.5, kInk, 1, cv::LINE_AA);
  }
  bool save(const std::string& file) const { return cv::imwrite(file, image_); }

 private:
  cv::Point pixel(const Eigen::Vector2d& p) const {
    const double to_pixel = kScale * (1 << kShift);
    return {static_cast<int>(std::lround((p.x() - corner_.x()) * to_pixel)),
            static_cast<int>(std::lround((corner_.y() - p.y()) * to_pixel))};
  }

  Eigen::Vector2d corner_;  // [m] upper left
  cv::Mat image_;
};

void drawGraph(Canvas& canvas, const VisibilityGraph& graph) {
  for (int slot = 0; slot < graph.slotCount(); ++slot) {
    if (!graph.has(slot)) continue;
    for (const VisibilityGraph::Link& link : graph.links(slot)) {
      if (link.to > slot) canvas.polyline({graph.vertex(slot).position, graph.vertex(link.to).position}, kGraph, 1);
    }
    canvas.disc(graph.vertex(slot).position, 0.04, kRoute, 1);
  }
}

void drawScan(Canvas& canvas, const RobotStack& stack) {
  const ObstacleScan& scan = stack.lidar().scan;
  const std::optional<Odometry> at_scan = stack.odometry().at(scan.stamp);
  if (!at_scan) return;
  for (std::size_t bin = 0; bin < scan.binCount(); ++bin) {
    const double range = static_cast<double>(scan.ranges[bin]);
    if (!std::isfinite(range)) continue;
    const bool transient = !scan.transient.empty() && scan.transient[bin];
    canvas.disc(at_scan->pose * scan.pointAt(bin, range), 0.015, transient ? kTransient : kReturn, cv::FILLED);
  }
}

void drawMotion(Canvas& canvas, const RobotStack& stack, const Footprint& footprint) {
  canvas.polyline(stack.route().points, kRoute, 2);
  canvas.polyline(stack.lastPlan().path, kPath, 2);
  canvas.disc(stack.lastPlan().local_goal, 0.08, kPath, 2);
  std::vector<Eigen::Vector2d> driven;
  for (const TrajectoryPoint& point : stack.plan().trajectory().points()) driven.push_back(point.pose.position());
  canvas.polyline(driven, kCommitted, 2);
  if (!driven.empty()) {
    canvas.polyline(footprint.polygonAt(stack.plan().trajectory().points().back().pose), kCommitted, 1, true);
  }
  canvas.polyline(footprint.polygonAt(stack.odometry().latest().pose), kInk, 2, true);
}

}  // namespace

bool drawExplanation(const RobotStack& stack, const Footprint& footprint, const std::string& file) {
  if (stack.odometry().empty()) return true;
  const Pose2& pose = stack.odometry().latest().pose;
  Canvas canvas(pose.position());
  canvas.cells(stack.topology().localMap(pose.position(), kWindow, 0.0));
  drawGraph(canvas, stack.topology().graph());
  drawScan(canvas, stack);
  drawMotion(canvas, stack, footprint);
  for (const TrackedObject& track : stack.lidar().tracks) {
    canvas.disc(track.position, track.radius, kTrack, 2);
    canvas.polyline({track.position, track.position + track.velocity}, kTrack, 2);
    canvas.text(track.position, std::to_string(track.id));
  }
  return canvas.save(file);
}

}  // namespace parley::sim
