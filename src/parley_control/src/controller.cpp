// SPDX-License-Identifier: BSD-3-Clause
#include "parley_control/controller.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "braking.h"
#include "clearance.h"
#include "tracking.h"
#include "twist_limits.h"
#include "watchdog.h"

namespace parley {
namespace {

constexpr double kLongestStep = 0.1;  // [s] after a longer gap the drive speeds up as after this one

template <class Options>
void requireValid(const Options& options, const char* source) {
  std::string all;
  for (const std::string& problem : checkOptions(options, source)) all += problem + "\n";
  if (!all.empty()) throw std::invalid_argument(all);
}

/// Whether the trajectory gives numbers at the times that this step reads.
bool isFinite(const Tracking& tracking) {
  return isFinite(tracking.desired) && isFinite(tracking.intended) && tracking.error.isFinite();
}

std::string offTrajectoryText(const Pose2& error) {
  char text[96];
  std::snprintf(text, sizeof(text), "off the trajectory by %.2f m and %.0f degrees", error.position().norm(),
                std::abs(degrees(error.yaw)));
  return text;
}

/// The planner's word, and where it says nothing why the robot nevertheless stands.
Status<DriveState> intentOf(const ControlRequest& request, bool resting) {
  const bool ended = request.trajectory->endTime() < request.now;
  if (resting && ended && request.intent == DriveState::kDriving) return {DriveState::kStopped, "trajectory has ended"};
  return {request.intent, request.intent_reason};
}

}  // namespace

Controller::Controller(const ControlOptions& options, const Footprint& footprint, const MotionLimits& limits)
    : options_(options), footprint_(footprint), limits_(limits) {
  requireValid(options, "control");
  requireValid(footprint, "footprint");
  requireValid(limits, "limits");
}

void Controller::reset() {
  last_now_.reset();
  last_command_ = {};
  present_.reset();
  resting_ = false;
  blocked_until_.reset();
}

ControlResult Controller::step(const ControlRequest& request) {
  const double dt = advanceClock(request);
  const auto stop = reasonToStop(request, options_);
  locate(request, !stop || stop->code != DriveState::kNoOdometry, dt);
  return stop ? brake(*stop, request.trajectory, dt) : follow(request, dt);
}

/// Time since the last step. The first one starts from the measured twist: someone else may have driven until now.
double Controller::advanceClock(const ControlRequest& request) {
  if (!std::isfinite(request.now)) return options_.period;
  if (last_now_ && request.now < *last_now_) reset();
  const bool first = !last_now_;
  const double dt = first ? options_.period : request.now - *last_now_;
  last_now_ = request.now;
  if (first && request.odometry != nullptr && isFinite(request.odometry->twist)) {
    last_command_ = keepingCurvature(request.odometry->twist, limits_);
  }
  return dt;
}

/// Where the robot is now: by a new reading, and while none comes by what it was told to do since.
void Controller::locate(const ControlRequest& request, bool odometry_is_good, double dt) {
  if (odometry_is_good && std::isfinite(request.now) && (!present_ || request.odometry->stamp != last_odometry_stamp_)) {
    present_ = *request.odometry;
    last_odometry_stamp_ = present_->stamp;
    dt = request.now - present_->stamp;
  } else if (present_) {
    present_->twist = last_command_;
  } else {
    return;
  }
  present_->pose = integrateTwist(present_->pose, present_->twist.speed, present_->twist.turn_rate, dt);
  present_->stamp = request.now;
}

ControlResult Controller::follow(const ControlRequest& request, double dt) {
  const SampledTrajectory& trajectory = *request.trajectory;
  Tracking tracking = track(trajectory, present_->pose, request.now, options_, limits_);
  if (!isFinite(tracking)) return brake({DriveState::kStopped, "trajectory is not finite"}, nullptr, dt);
  resting_ = rests(tracking.reference_stands, tracking.error);
  if (resting_) tracking.desired = tracking.intended = {};
  if (lastMomentStop(request, tracking.intended)) {
    ControlResult result = brake({DriveState::kBlocked, "obstacle in the braking path"}, &trajectory, dt);
    result.emergency = true;
    return result;
  }
  if (tracking.error.position().norm() > options_.position_error_limit ||
      std::abs(tracking.error.yaw) > options_.heading_error_limit) {
    return brake({DriveState::kStopped, offTrajectoryText(tracking.error)}, nullptr, dt);
  }
  const Twist2 twist = limited(last_command_, tracking.desired, limits_, std::min(dt, kLongestStep));
  return send(twist, intentOf(request, resting_));
}

/// A robot at rest is not moved by the noise of its odometry, only by an error well beyond the tolerances.
bool Controller::rests(bool reference_stands, const Pose2& error) {
  const double factor = resting_ ? options_.hold_factor : 1.0;
  return reference_stands && std::abs(error.x) <= factor * options_.position_tolerance &&
         std::abs(error.yaw) <= factor * options_.heading_tolerance;
}

/// Level-triggered: asked anew at each step. Once on, it asks for more room and for some time before it lets go, so that
/// the robot does not stutter up to an obstacle.
bool Controller::lastMomentStop(const ControlRequest& request, const Twist2& intended) {
  if (wouldTouch(request, intended)) {
    blocked_until_ = request.now + options_.stop_hold_time;
  } else if (blocked_until_ && request.now >= *blocked_until_) {
    blocked_until_.reset();
  }
  return blocked_until_.has_value();
}

/// Braking must be free whether it begins now or after the reaction time: a robot that turns as it drives may clear a
/// corner in one case and hit it in the other.
bool Controller::wouldTouch(const ControlRequest& request, const Twist2& intended) const {
  const double margin = options_.stop_margin + (blocked_until_ ? options_.stop_hysteresis : 0.0);
  const double path_time = pathTime(*request.trajectory, present_->pose, request.now);
  const Pose2 T_base_scan = present_->pose.inverse() * request.T_odom_scan;
  const Motion motion{present_->twist, last_command_, intended};
  for (const double reaction_time : {options_.reaction_time, 0.0}) {
    const Braking braking(brakingLimits(limits_, options_), *request.trajectory, path_time + reaction_time);
    const std::vector<Pose2> sweep = brakingSweep(motion, braking, reaction_time, options_, limits_);
    if (touches(sweep, *request.scan, T_base_scan, footprint_, margin)) return true;
  }
  return false;
}

ControlResult Controller::brake(const Status<DriveState>& why, const SampledTrajectory* path, double dt) {
  resting_ = false;
  Braking braking(limits_);
  if (path != nullptr && !path->empty() && present_ && last_now_) {
    braking = Braking(limits_, *path, pathTime(*path, present_->pose, *last_now_));
  }
  const Twist2 twist = braking.next(last_command_, dt);
  return send(isFinite(twist) ? twist : Braking(limits_).next(last_command_, dt), why);
}

ControlResult Controller::send(const Twist2& twist, const Status<DriveState>& why) {
  last_command_ = twist;
  return {twist, why.code, why.text, false};
}

}  // namespace parley
