// SPDX-License-Identifier: BSD-3-Clause
// Worlds drawn in code, and places to put files.
#pragma once

#include <stdlib.h>

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "parley_sim/scenario.h"
#include "parley_sim/world.h"

namespace parley::sim {

/// A world of the given size, solid where `solid` says so for the centre of a cell. [m]
inline World drawnWorld(double width, double height, double resolution, const std::function<bool(double, double)>& solid) {
  GridFrame frame;
  frame.resolution = resolution;
  frame.width = static_cast<int>(std::lround(width / resolution));
  frame.height = static_cast<int>(std::lround(height / resolution));
  std::vector<std::uint8_t> cells;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const Eigen::Vector2d center = frame.centerOf({x, y});
      cells.push_back(solid(center.x(), center.y()) ? 1 : 0);
    }
  }
  return {frame, cells};
}

inline World emptyWorld(double width = 20.0, double height = 20.0, double resolution = 0.05) {
  return drawnWorld(width, height, resolution, [](double, double) { return false; });
}

class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string pattern = (std::filesystem::temp_directory_path() / "parley_sim_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TemporaryDirectory() { std::filesystem::remove_all(path_); }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
    return file(name);
  }
  /// A map_server world: white is free.
  std::string writeWorld(const std::string& name, const World& world) const {
    const GridFrame& frame = world.frame();
    cv::Mat image(frame.height, frame.width, CV_8U);
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        image.at<std::uint8_t>(frame.height - 1 - y, x) = world.isSolid(Eigen::Vector2i(x, y)) ? 0 : 254;
      }
    }
    cv::imwrite(file(name + ".png"), image);
    return write(name + ".yaml", "image: " + name + ".png\nresolution: " + std::to_string(frame.resolution) +
                                     "\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  }

 private:
  std::filesystem::path path_;
};

inline std::string contentsOf(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline RobotSpec robotAt(const std::string& name, const Pose2& start, const Eigen::Vector2d& goal) {
  RobotSpec robot;
  robot.name = name;
  robot.start = start;
  robot.goal = goal;
  return robot;
}

}  // namespace parley::sim
