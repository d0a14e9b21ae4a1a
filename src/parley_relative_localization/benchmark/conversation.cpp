// SPDX-License-Identifier: BSD-3-Clause
#include "conversation.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

namespace parley::study {
namespace {

constexpr double kMessagePeriod = 0.25;  // [s]
constexpr double kDelay = 0.03;          // [s]
constexpr int kEncounterScans = 10;      // [-] of mutual sight in a row
constexpr double kToldSpan = 1.0;        // [s] of sightings that each message is about
constexpr double kRareKeyframe = 2.5;    // [m]
constexpr std::size_t kKeyframes = 2;    // [-] in a message
constexpr double kPlaceBytes = 12.0;     // [-] of identity, stamp and pose of a keyframe
constexpr double kReportBytes = 6.0;     // [-] of a sight report's stamp
constexpr double kBlobBytes = 4.0;       // [-]

constexpr double kTranslationDrift = 0.003;  // [m]
constexpr double kRotationDrift = 0.0002;    // [rad]

double processorTime() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

bool isWrong(double translation, double rotation) { return translation > 0.3 || rotation > radians(5.0); }

Pose2 driftedOdometry(const Pose2& odometry, const Pose2& motion, double way, double drift, std::mt19937& random) {
  const double spread = drift * std::sqrt(std::abs(way));
  std::normal_distribution<double> noise(0.0, 1.0);
  Pose2 measured = motion;
  measured.x += kTranslationDrift * spread * noise(random);
  measured.y += kTranslationDrift * spread * noise(random);
  measured.yaw += kRotationDrift * spread * noise(random);
  return odometry * measured;
}

Conversation::Conversation(const StudyOptions& options, unsigned seed) : options_(options), random_(seed) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  offset_ = options.offset * unit(random_);
  phase_ = 0.5 * (unit(random_) + 1.0) * kMessagePeriod;
  for (const char* name : {"robot_1", "robot_2"}) localizers_.emplace_back(options.localization, name, test::kRobot);
}

void Conversation::see(std::size_t i, const RobotState& robot, ObstacleScan scan) {
  scan.stamp += i == 1 ? offset_ : 0.0;
  localizers_[i].addOwnScan(robot.odometry, scan);
}

void Conversation::talk(double now, const Robots& robots, bool in_range) {
  if (now + phase_ >= next_message_ && in_range) {
    next_message_ = now + phase_ + kMessagePeriod;
    send(compose(now, robots[1]));
  }
  deliver(now);
}

Conversation::Message Conversation::compose(double now, const RobotState& robot) {
  Message message;
  message.arrival = now + kDelay;
  message.motion = {now + offset_, robot.odometry, robot.twist, test::kRobot, localizers_[1].travel()};
  message.sights = localizers_[1].sights(now + offset_ - kToldSpan);
  if (state_ == PoseState::kConfirmed) return message;
  for (const SightReport& report : message.sights) {
    outcome_.bytes += kReportBytes + kBlobBytes * static_cast<double>(report.blobs.size());
  }
  for (const Keyframe& keyframe : localizers_[1].keyframes()) {
    // One now and then before anything is known of the other, again until it arrives; all once it says that it may have been
    // seen.
    const bool is_due = state_heard_ >= PoseState::kCandidate ||
                        (message.keyframes.empty() && localizers_[1].travel() > arrived_travel_ + kRareKeyframe);
    if (arrived_.count(keyframe.id) > 0 || message.keyframes.size() >= kKeyframes || !is_due) continue;
    message.keyframes.push_back(keyframe);
    outcome_.bytes += kPlaceBytes + static_cast<double>(keyframe.descriptor.size());
  }
  return message;
}

/// Either way, what robot 0 says of its state and what robot 1 sends, may be lost.
void Conversation::send(Message message) {
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  if (chance(random_) >= options_.loss) state_heard_ = state_;
  if (chance(random_) < options_.loss) return;
  for (const Keyframe& keyframe : message.keyframes) arrived_.insert(keyframe.id);
  if (!message.keyframes.empty()) arrived_travel_ = localizers_[1].travel();
  messages_.push_back(std::move(message));
}

void Conversation::deliver(double now) {
  for (; !messages_.empty() && messages_.front().arrival <= now; messages_.pop_front()) {
    const Message& message = messages_.front();
    localizers_[0].addPeerMotion("robot_2", message.motion);
    for (const SightReport& report : message.sights) localizers_[0].addPeerSights("robot_2", report);
    for (const Keyframe& keyframe : message.keyframes) localizers_[0].addPeerKeyframe("robot_2", keyframe);
  }
}

void Conversation::weigh(double now, const Robots& robots) {
  const long matches = localizers_[0].counters().matches;
  const double start = processorTime();
  const std::vector<PeerEstimate> estimates = localizers_[0].step(now);
  const double taken = processorTime() - start;
  if (localizers_[0].counters().matches > matches) outcome_.step_seconds.push_back(taken);
  if (estimates.empty()) return;
  state_ = estimates.front().state;
  if (state_ >= PoseState::kTentative) judge(estimates.front(), now, robots);
}

void Conversation::judge(const PeerEstimate& estimate, double now, const Robots& robots) {
  const PoseEstimate& T = estimate.T_odom_peerodom;
  const Pose2 relative = robots[0].odometry.inverse() * T.pose * robots[1].odometry;
  const Pose2 truth = robots[0].truth.inverse() * robots[1].truth;
  const double translation = (relative.position() - truth.position()).norm();
  const double rotation = std::abs(angleBetween(relative.yaw, truth.yaw));
  if (!outcome_.tentative) {
    outcome_.tentative = true;
    outcome_.tentative_error = translation;
    outcome_.tentative_turn = rotation;
  }
  if (state_ != PoseState::kConfirmed) return;
  outcome_.wrong = outcome_.wrong || isWrong(translation, rotation);
  if (outcome_.confirmed) return;
  outcome_.confirmed = true;
  outcome_.translation_error = translation;
  outcome_.rotation_error = rotation;
  const Pose2 T_true = robots[0].odometry * truth * robots[1].odometry.inverse();
  const Eigen::Vector3d error(T.pose.x - T_true.x, T.pose.y - T_true.y, angleBetween(T_true.yaw, T.pose.yaw));
  outcome_.consistency = error.dot(T.covariance.inverse() * error);
  outcome_.travel = robots[0].travel + robots[1].travel - travel_at_sight_;
  outcome_.seconds = now - std::max(first_sight_, 0.0);
}

void Conversation::watch(double now, const Robots& robots, bool sight) {
  scans_in_sight_ = sight ? scans_in_sight_ + 1 : 0;
  if (!sight) return;
  if (first_sight_ < 0.0) {
    first_sight_ = now;
    travel_at_sight_ = robots[0].travel + robots[1].travel;
  }
  last_sight_ = now;
  outcome_.sight += kPeriod;
  outcome_.is_encounter = outcome_.is_encounter || scans_in_sight_ >= kEncounterScans;
}

Outcome Conversation::outcome() const {
  Outcome result = outcome_;
  for (const Keyframe& keyframe : localizers_[0].keyframes()) {
    result.descriptor_bytes.push_back(static_cast<double>(keyframe.descriptor.size()));
  }
  return result;
}

}  // namespace parley::study
