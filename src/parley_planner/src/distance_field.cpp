// SPDX-License-Identifier: BSD-3-Clause
#include "distance_field.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace parley {

namespace {

constexpr float kFarPixels = 1000.0F;  // where nothing is marked at all

struct Corner {
  int x, y;       // [cells] lower left of the four that surround a point
  double fx, fy;  // [-] in [0, 1]
};

Corner cornerAt(const GridFrame& frame, const Eigen::Vector2d& p) {
  const double u = std::clamp((p.x() - frame.origin.x()) / frame.resolution - 0.5, 0.0, frame.width - 1.001);
  const double v = std::clamp((p.y() - frame.origin.y()) / frame.resolution - 0.5, 0.0, frame.height - 1.001);
  const int x = static_cast<int>(u), y = static_cast<int>(v);
  return {x, y, u - x, v - y};
}

}  // namespace

DistanceField::DistanceField(const GridFrame& frame, const std::vector<unsigned char>& marked) : frame_(frame) {
  cv::Mat seeds(frame.height, frame.width, CV_8UC1);
  std::transform(marked.begin(), marked.end(), seeds.data, [](unsigned char m) { return m ? 0 : 255; });
  cv::Mat pixels;
  cv::distanceTransform(seeds, pixels, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  const auto resolution = static_cast<float>(frame.resolution);
  distances_.resize(marked.size());
  std::transform(pixels.ptr<float>(), pixels.ptr<float>() + marked.size(), distances_.begin(),
                 [resolution](float d) { return std::min(d, kFarPixels) * resolution; });
}

double DistanceField::at(const Eigen::Vector2d& p) const {
  const Corner c = cornerAt(frame_, p);
  const float* row = &distances_[static_cast<std::size_t>(c.y * frame_.width + c.x)];
  const float* above = row + frame_.width;
  return (1.0 - c.fy) * ((1.0 - c.fx) * row[0] + c.fx * row[1]) + c.fy * ((1.0 - c.fx) * above[0] + c.fx * above[1]);
}

DistanceField::Sample DistanceField::sample(const Eigen::Vector2d& p) const {
  const Corner c = cornerAt(frame_, p);
  const float* row = &distances_[static_cast<std::size_t>(c.y * frame_.width + c.x)];
  const float* above = row + frame_.width;
  const double low = (1.0 - c.fx) * row[0] + c.fx * row[1];
  const double high = (1.0 - c.fx) * above[0] + c.fx * above[1];
  const double dx = (1.0 - c.fy) * (row[1] - row[0]) + c.fy * (above[1] - above[0]);
  return {(1.0 - c.fy) * low + c.fy * high, Eigen::Vector2d(dx, high - low) / frame_.resolution};
}

}  // namespace parley
