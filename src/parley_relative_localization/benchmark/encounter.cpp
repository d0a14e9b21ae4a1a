// SPDX-License-Identifier: BSD-3-Clause
#include "encounter.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <deque>
#include <set>

namespace parley::study {
namespace {

constexpr double kPeriod = 0.1;          // [s] of the lidar
constexpr double kMessagePeriod = 0.25;  // [s]
constexpr double kDelay = 0.03;          // [s]
constexpr double kRadio = 10.0;          // [m]
constexpr double kLongest = 16.0;        // [s]
constexpr double kAfter = 4.0;           // [s] that an encounter is followed after the last sight
constexpr int kEncounterScans = 10;      // [-] of mutual sight in a row
constexpr double kRareKeyframe = 2.5;    // [m]
constexpr double kPlaceBytes = 12.0;     // [-] of identity, stamp and pose of a keyframe
constexpr double kReportBytes = 6.0;     // [-] of a sight report's stamp
constexpr double kBlobBytes = 4.0;       // [-]

double processorTime() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// What is on its way from robot 1 to robot 0.
struct Message {
  double arrival = 0.0;  // [s]
  MotionReport motion;
  std::vector<SightReport> sights;
  std::vector<Keyframe> keyframes;
};

class Run {
 public:
  Run(const GridWorld& world, const StudyOptions& options, unsigned seed, bool elsewhere)
      : world_(world), options_(options), random_(seed), elsewhere_(elsewhere) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    offset_ = options.offset * unit(random_);
    phase_ = 0.5 * (unit(random_) + 1.0) * kMessagePeriod;
  }

  bool place() { return elsewhere_ ? placeElsewhere() : placeMeeting(); }

  /// Robots that were to be elsewhere came near each other on their way.
  bool haveMet() const { return have_met_; }

  Outcome run() {
    const WallRange_ walls = [this](const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double limit) {
      return world_.range(from, direction, limit);
    };
    for (int step = 0; step * kPeriod < kLongest; ++step) {
      const double now = step * kPeriod;
      drive();
      for (std::size_t i = 0; i < 2; ++i) scan(i, walls, now);
      talk(now);
      weigh(now);
      watch(now);
      if (last_sight_ >= 0.0 && now > last_sight_ + kAfter) break;
    }
    for (const Keyframe& keyframe : localizers_[0].keyframes()) {
      outcome_.descriptor_bytes.push_back(static_cast<double>(keyframe.descriptor.size()));
    }
    return outcome_;
  }

 private:
  using WallRange_ = test::WallRange;

  void add(const Eigen::Vector2d& start, const Eigen::Vector2d& goal, const Footprint& footprint, double speed) {
    movers_.emplace_back(world_, start, goal, footprint, speed, options_.drift, random_());
  }

  /// A place so far from `p` by the way that robots drive.
  std::optional<Eigen::Vector2d> placeAt(const GoalField& field, double least, double most) {
    for (int attempt = 0; attempt < 400; ++attempt) {
      const Eigen::Vector2d p = world_.place(0.4, random_);
      if (field.distance(p) >= least && field.distance(p) <= most) return p;
    }
    return std::nullopt;
  }

  /// Robots start `least` to 8 m from a place and pass it on the way to somewhere else.
  bool placePair(const Eigen::Vector2d& meeting, double least) {
    const GoalField field(world_, meeting, 0.3);
    const auto a = placeAt(field, least, 8.0), b = placeAt(field, least, 8.0), goal = placeAt(field, 3.0, 12.0);
    if (!a || !b || !goal || (*a - *b).norm() < 3.0) return false;
    const bool swap = random_() % 2 == 0;
    add(*a, swap ? *b : *goal, test::kRobot, options_.speed * speedFactor());
    add(*b, *a, test::kRobot, options_.speed * speedFactor());
    return true;
  }

  double speedFactor() { return 0.6 + 0.1 * static_cast<double>(random_() % 8); }

  void finishPlacing() {
    for (int i = 0; i < options_.clutter; ++i) {
      const GoalField field(world_, movers_.front().truth().position(), 0.3);
      const auto start = placeAt(field, 1.0, 10.0), goal = placeAt(field, 1.0, 10.0);
      if (start && goal) add(*start, *goal, {0.4, 0.4}, 1.0);
    }
    for (std::size_t i = 0; i < 2; ++i)
      localizers_.emplace_back(options_.localization, i == 0 ? "robot_1" : "robot_2", test::kRobot);
  }

  bool placeMeeting() {
    movers_.clear();
    const Eigen::Vector2d meeting = world_.place(0.4, random_);
    if (!placePair(meeting, 3.0)) return false;
    if (random_() % 3 == 0) {
      const GoalField field(world_, meeting, 0.3);
      const auto start = placeAt(field, 1.0, 6.0), goal = placeAt(field, 3.0, 10.0);
      if (start && goal) add(*start, *goal, test::kRobot, options_.speed * speedFactor());
    }
    finishPlacing();
    return true;
  }

  bool placeElsewhere() {
    movers_.clear();
    const Eigen::Vector2d here = world_.place(0.4, random_), there = world_.place(0.4, random_);
    if ((here - there).norm() < 16.0 || !placePair(here, 1.5) || !placePair(there, 1.5)) return false;
    std::swap(movers_[1], movers_[2]);  // robots 0 and 1 talk, 2 and 3 are those that they meet
    finishPlacing();
    return true;
  }

  void drive() {
    constexpr int kParts = 5;
    for (int part = 0; part < kParts; ++part) {
      for (Mover& mover : movers_) {
        std::vector<const Mover*> others;
        for (const Mover& other : movers_) {
          if (&other != &mover) others.push_back(&other);
        }
        mover.step(kPeriod / kParts, others);
      }
    }
  }

  /// What robot i sees, stamped by its own clock.
  void scan(std::size_t i, const WallRange_& walls, double now) {
    std::vector<test::Body> bodies;
    for (const Mover& other : movers_) {
      const bool is_near = (other.truth().position() - movers_[i].truth().position()).norm() < options_.lidar.range + 1.0;
      if (&other != &movers_[i] && is_near) bodies.push_back(other.body());
    }
    const ObstacleScan seen =
        test::simulatedScan(walls, bodies, movers_[i].truth(), now + (i == 1 ? offset_ : 0.0), options_.lidar, random_);
    localizers_[i].addOwnScan(movers_[i].odometry(), seen);
  }

  void talk(double now) {
    const bool in_range = elsewhere_ || (movers_[0].truth().position() - movers_[1].truth().position()).norm() < kRadio;
    if (now + phase_ >= next_message_ && in_range) {
      next_message_ = now + phase_ + kMessagePeriod;
      Message message;
      message.arrival = now + kDelay;
      message.motion = {now + offset_, movers_[1].odometry(), movers_[1].twist(), movers_[1].footprint(),
                        localizers_[1].travel()};
      message.sights = localizers_[1].sights(reported_);
      if (!message.sights.empty()) reported_ = message.sights.back().stamp;
      if (state_ != PoseState::kConfirmed) {
        for (const SightReport& report : message.sights) {
          outcome_.bytes += kReportBytes + kBlobBytes * static_cast<double>(report.blobs.size());
        }
        for (const Keyframe& keyframe : localizers_[1].keyframes()) {
          // One now and then before anything is known of the other; all once it says that it may have been seen.
          const bool is_due = state_heard_ >= PoseState::kCandidate || localizers_[1].travel() > told_travel_ + kRareKeyframe;
          if (arrived_.count(keyframe.id) > 0 || message.keyframes.size() >= 2 || !is_due) continue;
          told_travel_ = localizers_[1].travel();
          message.keyframes.push_back(keyframe);
          outcome_.bytes += kPlaceBytes + static_cast<double>(keyframe.descriptor.size());
        }
      }
      std::uniform_real_distribution<double> chance(0.0, 1.0);
      if (chance(random_) >= options_.loss) state_heard_ = state_;
      if (chance(random_) >= options_.loss) {
        for (const Keyframe& keyframe : message.keyframes) arrived_.insert(keyframe.id);
        messages_.push_back(message);
      }
    }
    for (; !messages_.empty() && messages_.front().arrival <= now; messages_.pop_front()) {
      const Message& message = messages_.front();
      localizers_[0].addPeerMotion("robot_2", message.motion);
      for (const SightReport& report : message.sights) localizers_[0].addPeerSights("robot_2", report);
      for (const Keyframe& keyframe : message.keyframes) localizers_[0].addPeerKeyframe("robot_2", keyframe);
    }
  }

  void weigh(double now) {
    const long matches = localizers_[0].counters().matches;
    const double start = processorTime();
    const std::vector<PeerEstimate> estimates = localizers_[0].step(now);
    const double taken = processorTime() - start;
    if (localizers_[0].counters().matches > matches) outcome_.step_seconds.push_back(taken);
    if (estimates.empty()) return;
    const PeerEstimate& estimate = estimates.front();
    state_ = estimate.state;
    outcome_.tentative = outcome_.tentative || state_ >= PoseState::kTentative;
    if (state_ == PoseState::kConfirmed) judge(estimate, now);
  }

  void judge(const PeerEstimate& estimate, double now) {
    const PoseEstimate& T = estimate.T_odom_peerodom;
    const Pose2 T_true =
        movers_[0].odometry() * movers_[0].truth().inverse() * movers_[1].truth() * movers_[1].odometry().inverse();
    const Pose2 relative = movers_[0].odometry().inverse() * T.pose * movers_[1].odometry();
    const Pose2 truth = movers_[0].truth().inverse() * movers_[1].truth();
    const double translation = (relative.position() - truth.position()).norm();
    const double rotation = std::abs(angleBetween(relative.yaw, truth.yaw));
    outcome_.wrong = outcome_.wrong || translation > 0.3 || rotation > radians(5.0);
    if (outcome_.confirmed) return;
    outcome_.confirmed = true;
    outcome_.translation_error = translation;
    outcome_.rotation_error = rotation;
    const Eigen::Vector3d error(T.pose.x - T_true.x, T.pose.y - T_true.y, angleBetween(T_true.yaw, T.pose.yaw));
    outcome_.consistency = error.dot(T.covariance.inverse() * error);
    outcome_.travel = movers_[0].travel() + movers_[1].travel() - travel_at_sight_;
    outcome_.seconds = now - std::max(first_sight_, 0.0);
  }

  void watch(double now) {
    const Eigen::Vector2d a = movers_[0].truth().position(), b = movers_[1].truth().position();
    const double distance = (a - b).norm();
    have_met_ = have_met_ || distance < options_.lidar.range + 1.0;
    const bool sight = !elsewhere_ && distance < options_.lidar.range && world_.range(a, (b - a) / distance, distance) > distance;
    scans_in_sight_ = sight ? scans_in_sight_ + 1 : 0;
    if (!sight) return;
    if (first_sight_ < 0.0) {
      first_sight_ = now;
      travel_at_sight_ = movers_[0].travel() + movers_[1].travel();
    }
    last_sight_ = now;
    outcome_.sight += kPeriod;
    outcome_.is_encounter = outcome_.is_encounter || scans_in_sight_ >= kEncounterScans;
  }

  const GridWorld& world_;
  const StudyOptions& options_;
  std::mt19937 random_;
  bool elsewhere_;
  double offset_ = 0.0, phase_ = 0.0;  // [s]
  std::vector<Mover> movers_;
  std::vector<RelativeLocalization> localizers_;
  std::deque<Message> messages_;
  std::set<int> arrived_;
  double reported_ = -1.0;                         // [s] peer's clock
  double next_message_ = 0.0;                      // [s]
  double first_sight_ = -1.0, last_sight_ = -1.0;  // [s]
  double travel_at_sight_ = 0.0;                   // [m]
  int scans_in_sight_ = 0;
  bool have_met_ = false;
  double told_travel_ = -1e9;  // [m] robot 1's, when it last sent a keyframe
  PoseState state_ = PoseState::kUnknown, state_heard_ = PoseState::kUnknown;
  Outcome outcome_;
};

std::optional<Outcome> simulate(const GridWorld& world, const StudyOptions& options, unsigned seed, bool elsewhere) {
  Run run(world, options, seed, elsewhere);
  for (int attempt = 0; attempt < 20; ++attempt) {
    if (!run.place()) continue;
    const Outcome outcome = run.run();
    return elsewhere && run.haveMet() ? std::nullopt : std::optional<Outcome>(outcome);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Outcome> runEncounter(const GridWorld& world, const StudyOptions& options, unsigned seed) {
  return simulate(world, options, seed, false);
}

std::optional<Outcome> runElsewhere(const GridWorld& world, const StudyOptions& options, unsigned seed) {
  return simulate(world, options, seed, true);
}

}  // namespace parley::study
