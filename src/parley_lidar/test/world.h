// SPDX-License-Identifier: BSD-3-Clause
// A world of upright walls on a floor, cast ray by ray: shares no code with the lidar stage.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "parley_geometry/footprint.h"
#include "parley_geometry/odometry_buffer.h"
#include "parley_geometry/polygon.h"
#include "parley_geometry/scan.h"
#include "parley_lidar/lidar_options.h"

namespace parley::test {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr Footprint kRobot{0.8, 0.4};

struct Wall {
  Eigen::Vector2d a, b;
  double bottom = 0.0;  // [m]
  double top = 2.5;     // [m]
};

using PoseAt = std::function<Pose2(double)>;

/// A closed outline that may move.
struct Body {
  Polygon outline;
  PoseAt pose = [](double) { return Pose2{}; };
  double bottom = 0.0;
  double top = 2.5;
};

inline Polygon rectangle(double length, double width) { return Footprint{length, width}.polygon(); }

inline Polygon circle(double radius, int corners) {
  Polygon polygon;
  for (int i = 0; i < corners; ++i) {
    polygon.push_back(radius * Pose2{0.0, 0.0, 2.0 * kPi * i / corners}.direction());
  }
  return polygon;
}

inline PoseAt standing(double x, double y, double yaw = 0.0) {
  return [=](double) { return Pose2{x, y, yaw}; };
}

/// Constant twist from a pose at time 0.
inline PoseAt driving(const Pose2& start, double speed, double turn_rate) {
  return [=](double t) { return integrateTwist(start, speed, turn_rate, t); };
}

inline std::vector<Wall> wallsOf(const Polygon& outline, const Pose2& pose, double bottom = 0.0, double top = 2.5) {
  const Polygon corners = transformed(pose, outline);
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back({corners[i], corners[(i + 1) % corners.size()], bottom, top});
  }
  return walls;
}

struct World {
  std::vector<Wall> walls;
  std::vector<Body> bodies;

  std::vector<Wall> at(double time) const {
    std::vector<Wall> all = walls;
    for (const Body& body : bodies) {
      const std::vector<Wall> sides = wallsOf(body.outline, body.pose(time), body.bottom, body.top);
      all.insert(all.end(), sides.begin(), sides.end());
    }
    return all;
  }
  std::vector<Wall> near(const Eigen::Vector2d& place, double distance, double time) const {
    std::vector<Wall> all = at(time);
    const auto is_far = [&](const Wall& wall) { return pointSegmentDistance(place, wall.a, wall.b) > distance; };
    all.erase(std::remove_if(all.begin(), all.end(), is_far), all.end());
    return all;
  }
};

/// Distance along a ray of any direction to a wall or the floor, +inf if it meets none.
inline double cast(const std::vector<Wall>& walls, const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
  double nearest = direction.z() < 0.0 ? -from.z() / direction.z() : kInf;
  const double dx = direction.x(), dy = direction.y();
  for (const Wall& wall : walls) {
    const double along_x = wall.b.x() - wall.a.x(), along_y = wall.b.y() - wall.a.y();
    const double to_x = wall.a.x() - from.x(), to_y = wall.a.y() - from.y();
    const double denominator = dx * along_y - dy * along_x;
    if (denominator == 0.0) continue;
    const double range = (to_x * along_y - to_y * along_x) / denominator;
    const double where = (to_x * dy - to_y * dx) / denominator;
    const double z = from.z() + range * direction.z();
    if (range > 0.0 && where >= 0.0 && where <= 1.0 && z >= wall.bottom && z <= wall.top) {
      nearest = std::min(nearest, range);
    }
  }
  return nearest;
}

struct Lidar {
  int beams = 720;
  double angle_min = -kPi;
  double view = 2.0 * kPi;  // [rad] from first beam to one past the last
  double range_min = 0.05;  // [m]
  double range_max = 4.0;   // [m]
  double duration = 0.0;    // [s]
  double noise = 0.0;       // [m]
  LidarMount mount{};
};

inline Eigen::Isometry3d attitudeOf(const Odometry& o) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << o.pose.x, o.pose.y, 0.0;
  T.linear() = (Eigen::AngleAxisd(o.pose.yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(o.pitch, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(o.roll, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return T;
}

inline Eigen::Isometry3d mountOf(const LidarMount& mount) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << mount.x, mount.y, mount.z;
  T.linear() = Eigen::AngleAxisd(mount.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return T;
}

using OdometryAt = std::function<Odometry(double)>;

inline OdometryAt level(const PoseAt& pose) {
  return [=](double t) { return Odometry{t, pose(t), {}, 0.0, 0.0}; };
}

/// Readings every 10 ms, from half a second before `from` to `until`.
inline OdometryBuffer recorded(const OdometryAt& robot, double from, double until) {
  OdometryBuffer buffer(10.0);
  for (double t = from - 0.5; t < until + 0.02; t += 0.01) buffer.add(robot(t));
  return buffer;
}

inline RangeScan scanned(const World& world, const OdometryAt& robot, const Lidar& lidar, double stamp, std::mt19937& random) {
  RangeScan scan{stamp,
                 lidar.angle_min,
                 lidar.view / lidar.beams,
                 lidar.duration / std::max(1, lidar.beams - 1),
                 lidar.range_min,
                 lidar.range_max,
                 {}};
  std::normal_distribution<double> noise(0.0, 1.0);
  const auto walls_at = [&](double time) { return world.near(robot(time).pose.position(), lidar.range_max + 1.0, time); };
  std::vector<Wall> walls = walls_at(stamp);
  Eigen::Isometry3d T = attitudeOf(robot(stamp)) * mountOf(lidar.mount);
  for (int i = 0; i < lidar.beams; ++i) {
    const double time = stamp + i * scan.time_increment, angle = scan.angle_min + i * scan.angle_increment;
    if (lidar.duration > 0.0) {
      if (!world.bodies.empty()) walls = walls_at(time);
      T = attitudeOf(robot(time)) * mountOf(lidar.mount);
    }
    const double range = cast(walls, T.translation(), T.linear() * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0));
    const double measured = range + lidar.noise * noise(random);
    scan.ranges.push_back(static_cast<float>(range > lidar.range_max ? kInf : std::max(measured, lidar.range_min)));
  }
  return scan;
}

/// A non-repeating pattern like that of a Livox Mid-360: bearings by the golden ratio, elevations -7 to 52 degrees.
inline LidarCloud swept(const World& world, const OdometryAt& robot, const Lidar& lidar, double stamp, int points,
                        std::mt19937& random, double lowest = -7.0, double highest = 52.0) {
  LidarCloud cloud{stamp, {}};
  std::normal_distribution<double> noise(0.0, 1.0);
  std::uniform_real_distribution<double> start(0.0, 1.0);
  const std::vector<Wall> walls = world.at(stamp);
  const double first = start(random), second = start(random);
  for (int i = 0; i < points; ++i) {
    const double time = lidar.duration * i / points;
    const double angle = 2.0 * kPi * std::fmod(first + i * 0.6180339887, 1.0);
    const double elevation = radians(lowest + (highest - lowest) * std::fmod(second + i * 0.7548776662, 1.0));
    const Eigen::Vector3d ray(std::cos(elevation) * std::cos(angle), std::cos(elevation) * std::sin(angle), std::sin(elevation));
    const Eigen::Isometry3d T = attitudeOf(robot(stamp + time)) * mountOf(lidar.mount);
    const double range = cast(walls, T.translation(), T.linear() * ray) + lidar.noise * noise(random);
    if (range > 40.0) continue;
    const Eigen::Vector3f p = (range * ray).cast<float>();
    cloud.points.push_back({p.x(), p.y(), p.z(), static_cast<float>(time)});
  }
  return cloud;
}

inline std::vector<Wall> box(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  const Eigen::Vector2d right_low(high.x(), low.y()), left_high(low.x(), high.y());
  return {{low, right_low}, {right_low, high}, {high, left_high}, {left_high, low}};
}

}  // namespace parley::test
