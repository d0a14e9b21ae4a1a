// SPDX-License-Identifier: BSD-3-Clause
#include "turn_drive_space.h"

#include <algorithm>
#include <cmath>

namespace parley::study {

namespace {

constexpr double kSpeed = 0.5;                    // [m/s] as the lattice search's motions are driven
constexpr double kAcceleration = 1.9;             // [m/s^2]
constexpr double kTurnRate = 1.49;                // [rad/s]
constexpr double kTurnAcceleration = 3.8;         // [rad/s^2]
constexpr double kLengthStep = 0.05;              // [m]
constexpr double kTurnStep = 3.75 / 180.0 * kPi;  // [rad]
constexpr double kSamePlace = 1e-6;               // [m]

/// From standing to standing.
double timeOf(double way, double rate, double acceleration) {
  const double size = std::abs(way);
  return size * acceleration < rate * rate ? 2.0 * std::sqrt(size / acceleration) : size / rate + rate / acceleration;
}

}  // namespace

double TurnDrive::seconds() const {
  return timeOf(length, kSpeed, kAcceleration) + timeOf(first_turn, kTurnRate, kTurnAcceleration) +
         timeOf(last_turn, kTurnRate, kTurnAcceleration);
}

double TurnDrive::steps() const {
  return std::abs(length) / kLengthStep + (std::abs(first_turn) + std::abs(last_turn)) / kTurnStep;
}

Pose2 TurnDrive::poseAt(const Pose2& from, double steps_done) const {
  const auto part = [&steps_done](double whole, double step) {
    const double done = std::clamp(steps_done * step, 0.0, std::abs(whole));
    steps_done -= std::abs(whole) / step;
    return std::copysign(done, whole);
  };
  const double turned = part(first_turn, kTurnStep), driven = part(length, kLengthStep), turned_last = part(last_turn, kTurnStep);
  const double direction = from.yaw + turned;
  return {from.x + driven * std::cos(direction), from.y + driven * std::sin(direction), wrapAngle(direction + turned_last)};
}

TurnDrive turnDriveBetween(const Pose2& from, const Pose2& to) {
  const Eigen::Vector2d way = to.position() - from.position();
  if (way.norm() < kSamePlace) return {angleBetween(from.yaw, to.yaw), 0.0, 0.0};
  const double bearing = std::atan2(way.y(), way.x());
  const TurnDrive forwards{angleBetween(from.yaw, bearing), way.norm(), angleBetween(bearing, to.yaw)};
  const TurnDrive backwards{angleBetween(from.yaw, bearing + kPi), -way.norm(), angleBetween(bearing + kPi, to.yaw)};
  return forwards.seconds() <= backwards.seconds() ? forwards : backwards;
}

Pose2 TurnDriveSpace::poseOf(const ompl::base::State* state) {
  const auto* values = state->as<StateType>();
  return {values->getX(), values->getY(), values->getYaw()};
}

void TurnDriveSpace::setPose(ompl::base::State* state, const Pose2& pose) {
  auto* values = state->as<StateType>();
  values->setXY(pose.x, pose.y);
  values->setYaw(pose.yaw);
}

double TurnDriveSpace::distance(const ompl::base::State* from, const ompl::base::State* to) const {
  return turnDriveBetween(poseOf(from), poseOf(to)).seconds();
}

void TurnDriveSpace::interpolate(const ompl::base::State* from, const ompl::base::State* to, double share,
                                 ompl::base::State* result) const {
  const Pose2 start = poseOf(from);
  const TurnDrive motion = turnDriveBetween(start, poseOf(to));
  setPose(result, motion.poseAt(start, share * motion.steps()));
}

unsigned int TurnDriveSpace::validSegmentCount(const ompl::base::State* from, const ompl::base::State* to) const {
  return 1U + static_cast<unsigned int>(turnDriveBetween(poseOf(from), poseOf(to)).steps());
}

}  // namespace parley::study
