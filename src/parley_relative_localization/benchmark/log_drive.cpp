// SPDX-License-Identifier: BSD-3-Clause
#include "log_drive.h"

#include <algorithm>
#include <cmath>

namespace parley::study {
namespace {

constexpr double kTurnRate = 1.0;        // [rad/s]
constexpr double kAcceleration = 1.5;    // [m/s^2]
constexpr double kShortest = 0.02;       // [s] between two knots
constexpr double kComeAbout = 2.0;       // [1/s] change of the rate
constexpr double kMostCorrection = 0.6;  // [m] more between two scans, and the way is a straight line

double distanceOf(const Pose2& a, const Pose2& b) { return (b.position() - a.position()).norm(); }

}  // namespace

LogDrive::LogDrive(const CarmenLog& log, const Stretch& stretch, double speed, double lead) : log_(&log) {
  addKnots(stretch);
  setTimes(speed);
  const auto meeting = std::min_element(knots_.begin(), knots_.end(), [&](const Knot& a, const Knot& b) {
    return std::abs(a.scan - stretch.meeting) < std::abs(b.scan - stretch.meeting);
  });
  clock_ = std::max(meeting->time - lead, 0.0);
  last_scan_ = at(clock_).scan;
}

/// The wheels' way from scan to scan, bent so that it ends where the log's mapping says that the next scan was.
void LogDrive::addKnots(const Stretch& stretch) {
  for (int i = stretch.first; i <= stretch.last; ++i) {
    const LogScan& scan = log_->scans[static_cast<std::size_t>(i)];
    knots_.push_back({scan.T_map_base, static_cast<double>(i)});
    if (i == stretch.last || scan.way.empty()) continue;
    const Pose2 wanted = scan.T_map_base.inverse() * log_->scans[static_cast<std::size_t>(i) + 1].T_map_base;
    const Pose2 correction = scan.way.back().inverse() * wanted;
    if (correction.position().norm() > kMostCorrection) continue;
    const double steps = static_cast<double>(scan.way.size()) + 1.0;  // the last reading is a step before the next scan
    for (std::size_t k = 0; k < scan.way.size(); ++k) {
      const double share = (static_cast<double>(k) + 1.0) / steps;
      const Pose2 motion = scan.way[k] * interpolate({}, correction, share);
      knots_.push_back({scan.T_map_base * motion, static_cast<double>(i) + share});
    }
  }
  if (stretch.backwards) std::reverse(knots_.begin(), knots_.end());
}

/// As fast as speed, turn rate and acceleration allow.
void LogDrive::setTimes(double speed) {
  const std::size_t count = knots_.size();
  for (std::size_t i = 0; i < count; ++i) knots_[i].speed = i == 0 || i + 1 == count ? 0.0 : speed;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double way = distanceOf(knots_[i].pose, knots_[i + 1].pose);
    const double turn = std::abs(angleBetween(knots_[i].pose.yaw, knots_[i + 1].pose.yaw));
    const double limit = turn > 1e-6 ? std::min(speed, way * kTurnRate / turn) : speed;
    knots_[i].speed = std::min(knots_[i].speed, limit);
    knots_[i + 1].speed = std::min(knots_[i + 1].speed, limit);
  }
  const auto relax = [&](const Knot& from, Knot& to) {
    const double way = distanceOf(from.pose, to.pose);
    to.speed = std::min(to.speed, std::sqrt(from.speed * from.speed + 2.0 * kAcceleration * way));
  };
  for (std::size_t i = 0; i + 1 < count; ++i) relax(knots_[i], knots_[i + 1]);
  for (std::size_t i = count - 1; i > 0; --i) relax(knots_[i], knots_[i - 1]);
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double way = distanceOf(knots_[i].pose, knots_[i + 1].pose);
    const double turn = std::abs(angleBetween(knots_[i].pose.yaw, knots_[i + 1].pose.yaw));
    const double mean = 0.5 * (knots_[i].speed + knots_[i + 1].speed);
    const double driving = mean > 0.05 ? way / mean : way / 0.05;
    knots_[i + 1].time = knots_[i].time + std::max({driving, turn / kTurnRate, kShortest});
  }
}

LogDrive::Knot LogDrive::at(double time) const {
  const auto after = std::upper_bound(knots_.begin(), knots_.end(), time, [](double t, const Knot& k) { return t < k.time; });
  if (after == knots_.begin()) return knots_.front();
  if (after == knots_.end()) return knots_.back();
  const Knot &a = *std::prev(after), &b = *after;
  const double share = (time - a.time) / (b.time - a.time);
  return {interpolate(a.pose, b.pose, share), a.scan + share * (b.scan - a.scan), time, 0.0};
}

void LogDrive::step(double dt, bool back_off) {
  last_scan_ = at(clock_).scan;
  const Pose2 before = truth();
  rate_ += std::clamp((back_off ? -1.0 : 1.0) - rate_, -kComeAbout * dt, kComeAbout * dt);
  const double clock = clock_;
  clock_ = std::clamp(clock_ + rate_ * dt, 0.0, knots_.back().time);
  pace_ = (clock_ - clock) / dt;
  travel_ += distanceOf(before, truth());
}

Twist2 LogDrive::twist() const {
  constexpr double kSpan = 0.05;  // [s]
  const double from = std::max(clock_ - kSpan, 0.0), to = std::min(clock_ + kSpan, knots_.back().time);
  if (to - from < 1e-3) return {};
  const Pose2 a = at(from).pose, b = at(to).pose;
  const double along = (b.position() - a.position()).dot(truth().direction());
  return {pace_ * along / (to - from), pace_ * angleBetween(a.yaw, b.yaw) / (to - from)};
}

std::vector<const LogScan*> LogDrive::scans() const {
  const double place = at(clock_).scan;
  const auto before = static_cast<std::size_t>(std::floor(place));
  const std::size_t after = std::min(before + 1, log_->scans.size() - 1);
  std::vector<const LogScan*> result{&log_->scans[before], &log_->scans[after]};
  if (place - std::floor(place) > 0.5) std::swap(result[0], result[1]);
  return result;
}

const LogScan* LogDrive::passed() const {
  const double place = at(clock_).scan;
  const double scan = place > last_scan_ ? std::floor(place) : std::ceil(place);
  const bool is_passed = place > last_scan_ ? scan > last_scan_ : scan < last_scan_;
  return is_passed ? &log_->scans[static_cast<std::size_t>(scan)] : nullptr;
}

}  // namespace parley::study
