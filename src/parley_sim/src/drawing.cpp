// SPDX-License-Identifier: BSD-3-Clause
#include "drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace parley::sim {
namespace {

constexpr int kMapSize = 1100;     // [px] longer side of the map
constexpr int kLegendWidth = 330;  // [px]
constexpr int kTitleHeight = 44;   // [px]
constexpr int kMargin = 16;        // [px]
constexpr int kShift = 4;          // bits of a pixel's fraction in OpenCV's coordinates
const cv::Scalar kPaper(255, 255, 255), kWall(70, 64, 60), kInk(50, 45, 40), kFaint(150, 145, 140), kRed(40, 30, 215);

/// Ten colours that are easy to tell apart, then hues a golden angle apart.
cv::Scalar colorOf(std::size_t robot) {
  static const std::array<cv::Scalar, 10> kColors{{{214, 112, 20},
                                                   {24, 120, 240},
                                                   {60, 150, 30},
                                                   {50, 30, 200},
                                                   {180, 60, 120},
                                                   {40, 70, 120},
                                                   {190, 90, 235},
                                                   {30, 165, 165},
                                                   {200, 180, 20},
                                                   {90, 90, 90}}};  // blue, green, red
  if (robot < kColors.size()) return kColors[robot];
  const double hue = std::fmod(137.508 * static_cast<double>(robot), 360.0);
  cv::Mat3f pixel(1, 1, cv::Vec3f(static_cast<float>(hue), 0.85F, 0.75F));
  cv::Mat3f bgr;
  cv::cvtColor(pixel, bgr, cv::COLOR_HSV2BGR);
  const cv::Vec3f c = 255.0F * bgr(0, 0);
  return {c[0], c[1], c[2]};
}

cv::Mat mapImage(const World& world, double scale) {
  const GridFrame& frame = world.frame();
  cv::Mat cells(frame.height, frame.width, CV_8UC3);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const cv::Scalar& color = world.isSolid(Eigen::Vector2i(x, y)) ? kWall : kPaper;
      cells.at<cv::Vec3b>(frame.height - 1 - y, x) =
          cv::Vec3b(static_cast<uchar>(color[0]), static_cast<uchar>(color[1]), static_cast<uchar>(color[2]));
    }
  }
  cv::Mat map;
  const cv::Size size(std::max(1, static_cast<int>(std::lround(frame.size().x() * scale))),
                      std::max(1, static_cast<int>(std::lround(frame.size().y() * scale))));
  cv::resize(cells, map, size, 0, 0, size.width < frame.width ? cv::INTER_AREA : cv::INTER_NEAREST);
  return map;
}

/// A round length of about a sixth of the map. [m]
double scaleBarLength(double width) {
  const double power = std::pow(10.0, std::floor(std::log10(width / 6.0)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= width / 6.0) return step * power;
  }
  return power;
}

void write(cv::Mat& image, const std::string& text, cv::Point at, double size, const cv::Scalar& color, int weight = 1) {
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, size, color, weight, cv::LINE_AA);
}

}  // namespace

std::string oneDecimal(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

struct Drawing::Canvas {
  cv::Mat image;
  Eigen::Vector2d origin;
  double scale = 1.0;   // [px/m]
  double bottom = 0.0;  // [px] row of the world's lower edge
  int legend_left = 0;
  double world_width = 0.0;  // [m]
  std::vector<cv::Scalar> colors;

  Eigen::Vector2d pixel(const Eigen::Vector2d& p) const {
    return {kMargin + (p.x() - origin.x()) * scale, bottom - (p.y() - origin.y()) * scale};
  }
  cv::Point fine(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d at = pixel(p) * (1 << kShift);
    return {static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y()))};
  }
  cv::Point whole(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d at = pixel(p);
    return {static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y()))};
  }
  void line(const std::vector<Eigen::Vector2d>& points, bool closed, const cv::Scalar& color, int width) {
    std::vector<cv::Point> pixels;
    pixels.reserve(points.size());
    for (const Eigen::Vector2d& point : points) pixels.push_back(fine(point));
    if (!pixels.empty()) cv::polylines(image, pixels, closed, color, width, cv::LINE_AA, kShift);
  }
  void circle(const Eigen::Vector2d& center, double pixels, const cv::Scalar& color, int width) {
    cv::circle(image, fine(center), static_cast<int>(pixels * (1 << kShift)), color, width, cv::LINE_AA, kShift);
  }
  void fill(const Box& box, const cv::Scalar& color) {
    std::vector<cv::Point> pixels;
    for (const Eigen::Vector2d& corner : box.corners()) pixels.push_back(fine(corner));
    cv::fillConvexPoly(image, pixels, color, cv::LINE_AA, kShift);
  }
};

Drawing::Drawing(const World& world, std::size_t robots) : canvas_(std::make_unique<Canvas>()) {
  const Eigen::Vector2d size = world.frame().size();
  canvas_->scale = kMapSize / size.maxCoeff();
  canvas_->origin = world.frame().origin;
  canvas_->world_width = size.x();
  const cv::Mat map = mapImage(world, canvas_->scale);
  const int least = kTitleHeight + 30 * static_cast<int>(robots) + 220;
  const int height = std::max(map.rows + kTitleHeight + kMargin, least);
  canvas_->legend_left = map.cols + 2 * kMargin;
  canvas_->image = cv::Mat(height, canvas_->legend_left + kLegendWidth, CV_8UC3, kPaper);
  map.copyTo(canvas_->image(cv::Rect(kMargin, kTitleHeight, map.cols, map.rows)));
  canvas_->bottom = kTitleHeight + map.rows;
  for (std::size_t i = 0; i < robots; ++i) canvas_->colors.push_back(colorOf(i));
}

Drawing::~Drawing() = default;

void Drawing::track(const std::vector<Eigen::Vector2d>& points, std::size_t robot) {
  canvas_->line(points, false, canvas_->colors[robot], 2);
}

void Drawing::start(const Eigen::Vector2d& point, std::size_t robot) {
  canvas_->circle(point, 7.0, kPaper, cv::FILLED);
  canvas_->circle(point, 5.0, canvas_->colors[robot], cv::FILLED);
}

void Drawing::goal(const Eigen::Vector2d& point, double tolerance, std::size_t robot) {
  const double radius = std::max(7.0, tolerance * canvas_->scale);
  canvas_->circle(point, radius, kPaper, 4);
  canvas_->circle(point, radius, canvas_->colors[robot], 2);
  canvas_->circle(point, 2.0, canvas_->colors[robot], cv::FILLED);
}

void Drawing::body(const Box& box, std::size_t robot) {
  canvas_->fill(box, canvas_->colors[robot]);
  const auto corners = box.corners();
  canvas_->line({corners.begin(), corners.end()}, true, kInk, 1);
}

void Drawing::label(const Eigen::Vector2d& point, const std::string& text, std::size_t robot) {
  const cv::Point at = canvas_->whole(point) + cv::Point(9, -8);
  write(canvas_->image, text, at, 0.42, kPaper, 4);
  write(canvas_->image, text, at, 0.42, 0.75 * canvas_->colors[robot], 1);
}

void Drawing::door(const Box& box) { canvas_->fill(box, cv::Scalar(60, 120, 200)); }

void Drawing::obstaclePath(const std::vector<Eigen::Vector2d>& path, double radius) {
  canvas_->line(path, false, kFaint, 1);
  canvas_->circle(path.front(), radius * canvas_->scale, kFaint, 1);
  canvas_->circle(path.back(), radius * canvas_->scale, kFaint, 1);
}

void Drawing::encounter(const Eigen::Vector2d& point) {
  cv::drawMarker(canvas_->image, canvas_->whole(point), kInk, cv::MARKER_DIAMOND, 11, 1, cv::LINE_AA);
}

void Drawing::escape(const Eigen::Vector2d& point, std::size_t robot) {
  cv::drawMarker(canvas_->image, canvas_->whole(point), colorOf(robot), cv::MARKER_SQUARE, 10, 2, cv::LINE_AA);
}

void Drawing::incident(const Eigen::Vector2d& point, bool touched) {
  const cv::Scalar color = touched ? cv::Scalar(0, 140, 255) : kRed;
  canvas_->circle(point, 13.0, color, 2);
  cv::drawMarker(canvas_->image, canvas_->whole(point), color, cv::MARKER_TILTED_CROSS, 16, 3, cv::LINE_AA);
}

void Drawing::legend(const std::string& title, const std::vector<std::string>& lines) {
  Canvas& canvas = *canvas_;
  write(canvas.image, title, {kMargin, 28}, 0.62, kInk);
  int y = kTitleHeight + 14;
  for (std::size_t i = 0; i < lines.size(); ++i, y += 26) {
    cv::line(canvas.image, {canvas.legend_left, y - 5}, {canvas.legend_left + 30, y - 5}, canvas.colors[i], 3, cv::LINE_AA);
    write(canvas.image, lines[i], {canvas.legend_left + 40, y}, 0.45, kInk);
  }
  y += 14;
  const auto entry = [&](const std::string& text) {
    write(canvas.image, text, {canvas.legend_left + 40, y}, 0.45, kInk);
    y += 26;
  };
  const auto mark = [&]() { return cv::Point(canvas.legend_left + 15, y - 5); };
  cv::circle(canvas.image, mark(), 5, kFaint, cv::FILLED, cv::LINE_AA);
  entry("start");
  cv::circle(canvas.image, mark(), 7, kFaint, 2, cv::LINE_AA);
  entry("goal and its tolerance");
  cv::drawMarker(canvas.image, mark(), kInk, cv::MARKER_DIAMOND, 11, 1, cv::LINE_AA);
  entry("encounter");
  cv::drawMarker(canvas.image, mark(), kInk, cv::MARKER_SQUARE, 10, 2, cv::LINE_AA);
  entry("escape point");
  cv::drawMarker(canvas.image, mark(), kRed, cv::MARKER_TILTED_CROSS, 14, 3, cv::LINE_AA);
  entry("collision");
  const double bar = scaleBarLength(std::max(canvas.world_width, kLegendWidth / canvas.scale));
  const int right = canvas.legend_left + static_cast<int>(std::lround(bar * canvas.scale));
  y += 14;
  cv::line(canvas.image, {canvas.legend_left, y}, {right, y}, kInk, 3, cv::LINE_AA);
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g m", bar);
  write(canvas.image, text.data(), {canvas.legend_left, y + 22}, 0.45, kInk);
}

bool Drawing::save(const std::string& file) const { return cv::imwrite(file, canvas_->image); }

}  // namespace parley::sim
