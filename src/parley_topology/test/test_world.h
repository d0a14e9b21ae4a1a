// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "parley_geometry/pose2.h"
#include "parley_geometry/scan.h"
#include "parley_topology/topology.h"

namespace parley {

/// A drawn world for tests, with a lidar. Shares no code with what is tested.
class TestWorld {
 public:
  /// Free, `width` by `height` [m] with its lower left corner at (0, 0). All outside is solid.
  TestWorld(double width, double height, double resolution = 0.05);
  /// Rows from the top, a character `cell` [m] wide; '#' is solid.
  static TestWorld fromText(const std::vector<std::string>& rows, double cell);
  /// Rooms with doors along a grid, and boxes in them.
  static TestWorld rooms(double size, double room, unsigned seed);
  /// Scattered boxes inside a walled square.
  static TestWorld boxes(double size, int count, unsigned seed);

  void setBox(double x0, double y0, double x1, double y1, bool solid = true);
  bool isSolid(const Eigen::Vector2d& p) const;
  /// No solid cell's middle closer than `radius`.
  bool isClear(const Eigen::Vector2d& p, double radius) const;
  double width() const { return columns_ * resolution_; }
  double height() const { return rows_ * resolution_; }

  double cast(const Eigen::Vector2d& from, double angle, double range) const;
  ObstacleScan scan(const Pose2& pose, double range = 4.0, int bins = 720) const;
  ObstacleScan noisyScan(const Pose2& pose, double sigma, std::mt19937& random, double range = 4.0, int bins = 720) const;

  /// Length of the shortest way for a disc on a grid of moves in 32 directions; infinite if there is none.
  double shortestWay(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius) const;
  /// Outlines of all solid parts, a rectangle for each cell run: what a teammate that knows everything would tell.
  std::vector<LayerContour> outlines() const;

 private:
  bool solidCell(int x, int y) const {
    return x < 0 || y < 0 || x >= columns_ || y >= rows_ || solid_[static_cast<std::size_t>(y * columns_ + x)];
  }
  double resolution_;
  int columns_, rows_;
  std::vector<char> solid_;
};

Footprint testFootprint();

/// What came of driving a point along its routes.
struct Drive {
  bool arrived = false;
  bool hit = false;  // drove into something
  double length = 0.0;
  int switches = 0;
  Route last;
};

struct DriveOptions {
  double step = 0.2;  // [m] per scan
  int max_scans = 3000;
  double noise = 0.0;
  unsigned seed = 1;
  std::function<void(int, Topology&)> each;  // called before each scan with its number
  std::function<void(int, const TopologyResult&, const Route&)> after;
};

Drive drive(Topology& topology, const TestWorld& world, Eigen::Vector2d position, const Eigen::Vector2d& goal,
            const DriveOptions& options = {});

}  // namespace parley
