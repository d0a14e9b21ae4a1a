// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "encounter.h"

namespace parley::study {
namespace {

constexpr double kTurnRate = 1.5708;   // [rad/s]
constexpr double kAcceleration = 2.0;  // [m/s^2]
constexpr double kAhead = 1.0;         // [m]

Eigen::Vector2d startingHeading(const GoalField& field, const Eigen::Vector2d& start) {
  return field.target(start, kAhead) - start;
}

}  // namespace

Mover::Mover(const GridWorld& world, const Eigen::Vector2d& start, const Eigen::Vector2d& goal, const Footprint& footprint,
             double speed, double drift, unsigned seed)
    : world_(&world), field_(world, goal, 0.3), footprint_(footprint), top_speed_(speed), drift_(drift), random_(seed) {
  const Eigen::Vector2d heading = startingHeading(field_, start);
  truth_ = {start.x(), start.y(), std::atan2(heading.y(), heading.x())};
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  odometry_ = {20.0 * unit(random_), 20.0 * unit(random_), kPi * unit(random_)};
}

void Mover::step(double dt, const std::vector<const Mover*>& others) {
  Eigen::Vector2d target = field_.target(truth_.position(), kAhead);
  double limit = top_speed_;
  const Eigen::Vector2d right(std::sin(truth_.yaw), -std::cos(truth_.yaw));
  for (const Mover* other : others) {
    const Eigen::Vector2d p = truth_.inverse() * other->truth_.position();
    if (p.x() < -0.2 || p.norm() > 2.5) continue;
    if (world_->clearance(target + 0.5 * right) > 0.35) target += 0.5 * right;
    if (p.norm() < 1.3 && p.x() > 0.3 && std::abs(p.y()) < 0.55) limit = 0.0;
  }
  const Eigen::Vector2d toward = truth_.inverse() * target;
  const bool arrived = field_.distance(truth_.position()) < 0.3;
  const double error = std::atan2(toward.y(), toward.x());
  const double turn = arrived ? 0.0 : std::clamp(3.0 * error, -kTurnRate, kTurnRate);
  const double wanted = arrived ? 0.0 : limit * std::max(0.0, std::cos(error)) * (std::abs(error) > 1.2 ? 0.0 : 1.0);
  twist_.turn_rate += std::clamp(turn - twist_.turn_rate, -6.0 * dt, 6.0 * dt);
  twist_.speed += std::clamp(wanted - twist_.speed, -kAcceleration * dt, kAcceleration * dt);
  const Pose2 next = integrateTwist(truth_, twist_.speed, twist_.turn_rate, dt);
  const bool blocked = world_->clearance(next.position()) < 0.2;
  if (blocked) twist_.speed = 0.0;
  const Pose2 motion = integrateTwist({}, twist_.speed, twist_.turn_rate, dt);
  const double way = std::abs(twist_.speed * dt);
  truth_ = truth_ * motion;
  odometry_ = driftedOdometry(odometry_, motion, way, drift_, random_);
  travel_ += way;
}

}  // namespace parley::study
