// SPDX-License-Identifier: BSD-3-Clause
#include "scan_raster.h"

#include <opencv2/imgproc.hpp>

namespace parley {
namespace {

constexpr int kShift = 6;                // fractional bits of drawing coordinates
constexpr double kSurfaceGap = 0.5;      // [m] neighbouring hits further apart are not taken for one surface
constexpr double kLongestRange = 100.0;  // [m] longer rays are cut: bounds the image

struct Ray {
  bool looked = false;
  bool hit = false;
  bool passing = false;
  Eigen::Vector2d end = Eigen::Vector2d::Zero();    // [m] odom
  Eigen::Vector2d clear = Eigen::Vector2d::Zero();  // [m] odom, as far as it clears
};

std::vector<Ray> castRays(const ObstacleScan& scan, const Pose2& T_odom_base, double clear_margin) {
  const double reach = std::min(scan.range_max, kLongestRange);
  const Eigen::Vector2d eye = T_odom_base * scan.origin;
  std::vector<Ray> rays(scan.binCount());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Ray& ray = rays[i];
    ray.end = ray.clear = eye;
    const double range = scan.ranges[i];
    ray.looked = range > 0.0;  // false for NaN
    if (!ray.looked) continue;
    ray.hit = range <= reach;
    const double bearing = T_odom_base.yaw + scan.bearingOf(i);
    const Eigen::Vector2d along(std::cos(bearing), std::sin(bearing));
    ray.end = eye + std::min(range, reach) * along;
    ray.clear = eye + std::max(0.0, std::min(range, reach) - clear_margin) * along;
    const bool transient = i < scan.transient.size() && scan.transient[i];
    ray.passing = ray.hit && i < scan.moving.size() && scan.moving[i];
    ray.hit = ray.hit && !transient;
  }
  return rays;
}

/// Odom coordinates to pixels with kShift fractional bits, (0, 0) being the middle of the first pixel as OpenCV has it.
class Canvas {
 public:
  Canvas(const CellRect& rect, double resolution) : rect_(rect), inverse_(1.0 / resolution) {}
  cv::Point at(const Eigen::Vector2d& p) const {
    return {toFixed(p.x() * inverse_ - rect_.x0 - 0.5), toFixed(p.y() * inverse_ - rect_.y0 - 0.5)};
  }
  cv::Point pixel(const Eigen::Vector2d& p) const {
    return {static_cast<int>(std::floor(p.x() * inverse_)) - rect_.x0, static_cast<int>(std::floor(p.y() * inverse_)) - rect_.y0};
  }

 private:
  static int toFixed(double pixels) { return static_cast<int>(std::lround(pixels * (1 << kShift))); }
  CellRect rect_;
  double inverse_;
};

void fill(cv::Mat1b& marks, const std::vector<cv::Point>& polygon, ScanMark mark) {
  cv::fillPoly(marks, std::vector<std::vector<cv::Point>>{polygon}, cv::Scalar(mark), cv::LINE_8, kShift);
}

void drawHits(cv::Mat1b& marks, const std::vector<Ray>& rays, const Canvas& canvas) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    const Ray& after = rays[(i + 1) % rays.size()];
    if (!ray.hit || !after.hit || (ray.end - after.end).squaredNorm() > kSurfaceGap * kSurfaceGap) continue;
    cv::line(marks, canvas.at(ray.end), canvas.at(after.end), cv::Scalar(kKeep), 1, cv::LINE_8, kShift);
  }
  for (const Ray& ray : rays) {
    std::uint8_t& mark = marks(canvas.pixel(ray.end));
    if (ray.passing && mark < kPassing) mark = kPassing;
  }
  for (const Ray& ray : rays) {
    if (ray.hit) marks(canvas.pixel(ray.end)) = kHit;
  }
}

CellRect boundsOf(const std::vector<Ray>& rays, const Polygon& body, double resolution) {
  Eigen::Vector2d low = body.front(), high = body.front();
  for (const Ray& ray : rays) {
    low = low.cwiseMin(ray.end);
    high = high.cwiseMax(ray.end);
  }
  for (const Eigen::Vector2d& corner : body) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const auto cell = [resolution](double v) { return static_cast<int>(std::floor(v / resolution)); };
  return CellRect{cell(low.x()), cell(low.y()), cell(high.x()) + 1, cell(high.y()) + 1}.grown(1);
}

}  // namespace

bool isUsable(const ObstacleScan& scan, const Pose2& T_odom_base) {
  return T_odom_base.isFinite() && scan.binCount() >= 3 && std::isfinite(scan.range_max) && scan.range_max > 0.0 &&
         scan.origin.allFinite();
}

ScanImage drawScan(const ObstacleScan& scan, const Pose2& T_odom_base, const Footprint& footprint, double clear_margin,
                   double resolution) {
  const std::vector<Ray> rays = castRays(scan, T_odom_base, clear_margin);
  const double slack = std::min(resolution, 0.25 * std::min(footprint.length, footprint.width));
  const Polygon body = footprint.polygonAt(T_odom_base, -slack);  // a wall that it stands against must stay
  ScanImage image;
  image.rect = boundsOf(rays, body, resolution);
  image.marks = cv::Mat1b(image.rect.height(), image.rect.width(), static_cast<std::uint8_t>(kNothing));
  const Canvas canvas(image.rect, resolution);

  std::vector<cv::Point> outline;
  outline.reserve(rays.size());
  for (const Ray& ray : rays) outline.push_back(canvas.at(ray.clear));
  fill(image.marks, outline, kClear);
  outline.clear();
  for (const Eigen::Vector2d& corner : body) outline.push_back(canvas.at(corner));
  fill(image.marks, outline, kUnderRobot);
  drawHits(image.marks, rays, canvas);
  return image;
}

}  // namespace parley
