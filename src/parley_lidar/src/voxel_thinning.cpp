// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_thinning.h"

#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>

namespace parley {

std::vector<Eigen::Vector2f> thinned(const std::vector<ObstaclePoint>& points, double cell) {
  if (points.empty()) return {};
  pcl::PointCloud<pcl::PointXYZ>::Ptr flat(new pcl::PointCloud<pcl::PointXYZ>);
  flat->reserve(points.size());
  for (const ObstaclePoint& point : points) flat->push_back({point.position.x(), point.position.y(), 0.0F});
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  const auto side = static_cast<float>(cell);
  grid.setLeafSize(side, side, side);
  grid.setInputCloud(flat);
  pcl::PointCloud<pcl::PointXYZ> cells;
  grid.filter(cells);
  std::vector<Eigen::Vector2f> thin;
  thin.reserve(cells.size());
  for (const pcl::PointXYZ& point : cells) thin.emplace_back(point.x, point.y);
  return thin;
}

}  // namespace parley
