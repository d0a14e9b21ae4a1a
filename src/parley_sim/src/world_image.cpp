// SPDX-License-Identifier: BSD-3-Clause
#include "world_image.h"

#include <opencv2/imgcodecs.hpp>

namespace parley::sim {

std::optional<WorldImage> readWorldImage(const std::string& file) {
  cv::Mat image = cv::imread(file, cv::IMREAD_UNCHANGED);
  if (image.empty()) return std::nullopt;
  if (image.depth() != CV_8U && image.depth() != CV_16U) return std::nullopt;
  const double white = image.depth() == CV_16U ? 65535.0 : 255.0;
  cv::Mat values;
  image.convertTo(values, CV_64F, 1.0 / white);
  const int channels = values.channels();

  WorldImage world{values.cols, values.rows, {}};
  world.lightness.reserve(values.total());
  for (int row = values.rows - 1; row >= 0; --row) {
    const double* pixels = values.ptr<double>(row);
    for (int column = 0; column < values.cols; ++column) {
      double sum = 0.0;
      for (int c = 0; c < channels; ++c) sum += pixels[column * channels + c];
      world.lightness.push_back(sum / channels);
    }
  }
  return world;
}

}  // namespace parley::sim
