// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "pace.h"
#include "team.h"

namespace parley {
namespace {

/// Robots on random tours of a hall. Each replans four times a second, sees a new contour every two metres and has each
/// revised twice, and sends a keyframe every 1.2 m; they are in reach of each other within `range` metres.
class Tour {
 public:
  Tour(std::size_t count, double side, double range, double loss, std::uint64_t seed)
      : side_(side), range_(range), random_(seed) {
    team.loss = loss;
    for (std::size_t i = 0; i < count; ++i) {
      team.add(random_.real(-50.0, 50.0));
      robots_.push_back({random_.pose(0.5 * side), 0.0, 0, {}, 0, {}});
    }
  }

  void run(double duration) {
    int turn = 0;
    team.run(duration, [&](std::size_t i) {
      if (i == 0 && turn++ % 10 == 0) relink();
      drive(i);
    });
  }

  /// Of one robot. [byte/s]
  double rate(double duration) const {
    double sum = 0.0;
    for (const auto& packet : team.sent) sum += static_cast<double>(packet.second);
    return sum / duration / static_cast<double>(robots_.size());
  }
  /// Where the bytes of one robot go. [byte/s]
  void print(const char* name, double duration) {
    SectionBytes sum;
    double packets = 0.0, received = 0.0, fresh = 0.0;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      sum += team[i].counters().sections_sent;
      packets += static_cast<double>(team[i].counters().packets_sent);
      received += static_cast<double>(team[i].counters().records_received);
      fresh += static_cast<double>(team[i].counters().records_new);
    }
    const double all = duration * static_cast<double>(robots_.size());
    const auto each = [all](std::size_t bytes) { return static_cast<double>(bytes) / all; };
    std::printf(
        "%s: %.0f byte/s a robot in %.1f packets/s: trajectory %.0f, intent %.0f, beacon %.0f, sightings %.0f, map %.0f, "
        "keyframe %.0f, frames and headers %.0f; "
        "%.0f %% of contours shared, %.0f %% of the records that came were new\n",
        name, rate(duration), packets / all, each(sum.trajectory), each(sum.conflict), each(sum.beacon), each(sum.observation),
        each(sum.map), each(sum.keyframe), 61.0 * packets / all, 100.0 * shared(), 100.0 * fresh / received);
  }
  /// Share of the contours and anchors of all robots that each of them holds. [-]
  double shared() {
    double held = 0.0, all = 0.0;
    for (std::size_t of = 0; of < robots_.size(); ++of) {
      for (std::size_t by = 0; by < robots_.size(); ++by) {
        held += static_cast<double>(team[by].contoursOf(team[of].id()).size());
        all += static_cast<double>(team[of].contoursOf(team[of].id()).size());
      }
    }
    return held / all;
  }

  Team team{3};

 private:
  struct Robot {
    Pose2 pose;        // in the hall, which here is its odom frame too
    double travelled;  // [m]
    int seen;          // contours
    std::vector<OwnContour> contours;
    int keyframes;
    std::vector<ObservationMessage> scans;  // the newest first
  };

  void relink() {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      for (std::size_t j = i + 1; j < robots_.size(); ++j) {
        const bool near = (robots_[i].pose.position() - robots_[j].pose.position()).norm() < range_;
        near ? team.connect(i, j) : team.cut(i, j);
      }
    }
  }

  void drive(std::size_t i) {
    Robot& robot = robots_[i];
    const bool outside = robot.pose.position().cwiseAbs().maxCoeff() > 0.5 * side_;
    const double turn = outside ? 1.0 : 0.6 * std::sin(0.3 * team.now + static_cast<double>(i));
    const bool inward = outside && robot.pose.direction().dot(robot.pose.position()) < 0.0;
    robot.pose = integrateTwist(robot.pose, 1.0, inward ? 0.0 : turn, 0.05);
    robot.travelled += 0.05;
    const double now = team.timeOf(i);
    team[i].setOdometry({now, robot.pose, {1.0, turn}, 0.0, 0.0}, DriveState::kDriving);
    if (std::fmod(team.now, 0.25) < 0.05) plan(i, turn, now);
    if (robot.travelled > 1.2 * (robot.keyframes + 1)) {
      ++robot.keyframes;
      team[i].publishKeyframe(random_.bytes(140), robot.pose, now, now);
    }
    see(i, now);
    if (std::fmod(team.now, 0.1) < 0.05) sight(i, now);
    if (std::fmod(now, 2.0) < 0.05) recognise(i, now);
  }

  /// Relative poses are known a few seconds after robots meet.
  void recognise(std::size_t i, double now) {
    for (const PeerState& peer : team[i].peers(now)) {
      if (now - peer.first_heard < 5.0) continue;
      PeerPose pose;
      pose.T_odom_peer.covariance = Eigen::Vector3d(1e-3, 1e-3, 1e-5).asDiagonal();
      pose.state = EdgeState::kConfirmed;
      team[i].setPeerPose(peer.id, pose, now);
    }
  }

  void plan(std::size_t i, double turn, double now) {
    std::vector<TrajectoryPoint> points;
    Pose2 pose = robots_[i].pose;
    for (int k = 0; k <= 30; ++k) {
      points.push_back({now + 0.1 * k, pose, {1.0, turn}});
      pose = integrateTwist(pose, k < 25 ? 1.0 : 0.2, turn, 0.1);
    }
    team[i].setTrajectory(SampledTrajectory(points), DriveState::kDriving);
    // Eight metres ahead with a corner every two, and now and then by another's right.
    const Eigen::Vector2d here = robots_[i].pose.position();
    IntentMessage intent{1.0, team[i].id() + (std::fmod(now, 10.0) < 2.0 ? 1 : 0), 0, {here}};
    for (int k = 1; k <= 4; ++k) intent.way.emplace_back(here + Eigen::Vector2d(2.0 * k, 0.5 * (k % 2)));
    team[i].setIntent(intent);
  }

  /// Whoever is within the lidar's 4 m, and now and then a thing that is no robot.
  void sight(std::size_t i, double now) {
    Robot& robot = robots_[i];
    ObservationMessage scan{0.0, robot.pose, {}};
    if (std::fmod(robot.travelled, 6.0) < 2.0) scan.blobs.push_back({3.0, 1.0, 0.5});
    for (const Robot& other : robots_) {
      const double range = (other.pose.position() - robot.pose.position()).norm();
      if (&other != &robot && range > 0.1 && range < 4.0 && scan.blobs.size() < 6) scan.blobs.push_back({range, 0.0, 0.5});
    }
    for (ObservationMessage& before : robot.scans) before.age += 0.1;
    if (!scan.blobs.empty()) robot.scans.insert(robot.scans.begin(), scan);
    if (robot.scans.size() > 4) robot.scans.pop_back();
    team[i].setObservations(robot.scans, now);
  }

  void see(std::size_t i, double now) {
    Robot& robot = robots_[i];
    if (robot.travelled > 2.0 * robot.seen) {
      OwnContour contour{robot.seen, {}, false, false, now};
      const Eigen::Vector2d at = robot.pose.position();
      for (int k = 0; k < 11; ++k) contour.polygon.push_back(at + Eigen::Vector2d(0.4 * k, 1.5 + 0.3 * (k % 2)));
      robot.contours.push_back(contour);
      // The two before are seen better now.
      for (int k = robot.seen - 2; k < robot.seen; ++k) {
        if (k >= 0) robot.contours[static_cast<std::size_t>(k)].polygon.back().x() += 0.3;
      }
      ++robot.seen;
    }
    if (std::fmod(now, 0.5) < 0.05) team[i].publishContours(robot.contours, now);
  }

  double side_;   // [m]
  double range_;  // [m]
  RandomContent random_;
  std::vector<Robot> robots_;
};

/// Any T seconds carry at most burst + rate * T.
void expectWithinBudget(const Team& team) {
  for (const auto& packets : team.sent_by) {
    for (std::size_t i = 0; i < packets.size(); ++i) {
      double sum = 0.0;
      for (std::size_t j = i; j < packets.size(); ++j) {
        sum += static_cast<double>(packets[j].second);
        ASSERT_LE(sum, team.options.burst + team.options.rate * (packets[j].first - packets[i].first) + 1e-6);
      }
    }
  }
}

}  // namespace

TEST(Budget, eightRobotsWithoutLoss) {
  Tour tour(8, 40.0, 10.0, 0.0, 1);
  tour.run(60.0);
  tour.print("8 robots, no loss", 60.0);
  EXPECT_LT(tour.rate(60.0), 1000.0);
  EXPECT_GT(tour.shared(), 0.5);
  expectWithinBudget(tour.team);
}

TEST(Budget, eightRobotsAtEightyPercentLoss) {
  Tour tour(8, 40.0, 10.0, 0.8, 1);
  tour.run(60.0);
  tour.print("8 robots, 80 % loss", 60.0);
  EXPECT_LT(tour.rate(60.0), 1500.0);
  EXPECT_GT(tour.shared(), 0.25);
  expectWithinBudget(tour.team);
}

TEST(Budget, sixtyFourRobots) {
  Tour tour(64, 40.0, 8.0, 0.0, 2);
  tour.run(20.0);
  tour.print("64 robots, no loss", 20.0);
  // The bucket starts full, so short runs can exceed its rate by the burst.
  EXPECT_LT(tour.rate(20.0), 1500.0 + 3000.0 / 20.0);
  EXPECT_GT(tour.shared(), 0.15);
  expectWithinBudget(tour.team);
}

TEST(Budget, holdsWhateverIsAskedFor) {
  Team team(4);
  for (int i = 0; i < 3; ++i) team.add();
  team.connectAll();
  RandomContent random(5);
  std::vector<OwnContour> contours;
  for (int k = 0; k < 400; ++k) contours.push_back(wall(k, 1.0 + random.real(0.0, 0.5), 0.05 * k - 10.0, 3.0));
  double x = 0.0;
  team.run(20.0, [&](std::size_t i) {
    x += 0.3;
    const double now = team.timeOf(i);
    team[i].setOdometry(standing({std::fmod(x, 900.0), 0.0, 0.0}, now), DriveState::kDriving);
    team[i].setTrajectory(SampledTrajectory::standing({x, 0.0, 0.0}, now), DriveState::kDriving);
    team[i].setIntent({random.real(0.0, 9.0), random.word(), 0, std::vector<Eigen::Vector2d>(15, {x, 300.0 - x})});
    team[i].setConflicts(std::vector<Conflict>(static_cast<std::size_t>(random.whole(0, 7))));
    team[i].setObservations(std::vector<ObservationMessage>(4, {0.0, {}, std::vector<Observation>(8, {1.0, 0.0, 0.5})}), now);
    team[i].publishKeyframe(random.bytes(250), {}, now, now);
    if (random.chance(0.05)) team[i].publishContours(contours, now);
  });
  expectWithinBudget(team);
  // Under that load the trajectory still comes first, four times a second.
  const auto trajectory = team[1].trajectoryOf(team[0].id(), team.timeOf(1));
  ASSERT_TRUE(trajectory);
  EXPECT_LT(team.timeOf(1) - trajectory->received, 0.4);
}

TEST(Budget, aTrajectoryOfThreeSecondsTakesFortyBytes) {
  std::vector<TrajectoryPoint> points;
  Pose2 pose;
  double speed = 2.0;
  for (int k = 0; k <= 60; ++k) {
    points.push_back({0.05 * k, pose, {speed, 0.0}});
    if (k > 35) speed = std::max(0.0, speed - 0.1);
    pose = integrateTwist(pose, speed, 0.5 * std::sin(0.1 * k), 0.05);
  }
  PacketContent content;
  content.trajectory = trajectoryMessage(SampledTrajectory(points), DriveState::kDriving, 0.0);
  EXPECT_LT(sectionBytes(encodePacket(content)).trajectory, 50U);
  EXPECT_EQ(content.trajectory->poses.size(), 13U);
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
