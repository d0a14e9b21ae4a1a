// SPDX-License-Identifier: BSD-3-Clause
#include "distance_field.h"

#include <cassert>
#include <opencv2/imgproc.hpp>

namespace parley::sim {

std::vector<float> cellGaps(int width, int height, const std::vector<std::uint8_t>& solid) {
  assert(solid.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  cv::Mat free = cv::Mat::zeros(height + 2, width + 2, CV_8U);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t index = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      free.at<std::uint8_t>(y + 1, x + 1) = solid[index] != 0 ? 0 : 255;
    }
  }
  cv::Mat gaps;
  cv::distanceTransform(free, gaps, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return {gaps.begin<float>(), gaps.end<float>()};
}

}  // namespace parley::sim
