// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "global_search.h"
#include "rooms.h"

namespace parley {
namespace {

using test::LidarModel;

const std::vector<Pose2> kOwnPlaces{{2.0, 3.0, 0.3}, {2.8, 3.2, 0.5}, {3.6, 3.4, 0.2}};
const std::vector<Pose2> kPeerPlaces{{6.0, 3.0, 2.5}, {5.4, 3.3, 2.8}, {5.0, 3.6, 3.0}};
const Pose2 kOwnOdom{1.0, -2.0, 0.7}, kPeerOdom{-3.0, 4.0, -1.9};
const Pose2 kTruth = kOwnOdom.inverse() * kPeerOdom;

SurfaceMap mapOf(const std::vector<test::WallSegment>& walls, const std::vector<Pose2>& places, const Pose2& odom,
                 const LidarModel& lidar, unsigned seed) {
  std::mt19937 random(seed);
  return SurfaceMap(test::scansFrom(test::segmentWorld(walls), places, odom, lidar, random));
}

PoseInformation guess(const Pose2& pose) { return unobserved(pose, kOwnOdom.inverse() * Eigen::Vector2d(4.0, 3.0)); }

}  // namespace

TEST(ScanMatcher, findsTheTruthWithoutNoise) {
  LidarModel exact;
  exact.noise = 0.0;
  exact.range = 12.0;
  const auto room = test::distinctiveRoom();
  const SurfaceMap own = mapOf(room, kOwnPlaces, kOwnOdom, exact, 1), peer = mapOf(room, kPeerPlaces, kPeerOdom, exact, 2);
  const PoseInformation start = guess(kTruth);
  const Pose2 off = movedAbout(kTruth, start.center, {0.12, -0.1, 0.06});
  const ScanMatch match = refineMatch(own.index, peer.sample, unobserved(off, start.center));
  ASSERT_TRUE(match.converged);
  const Eigen::Vector3d error = stepBetween(kTruth, match.estimate.pose, start.center);
  EXPECT_LT(error.head<2>().norm(), 0.012);  // ranges are quantised to 5 cm here
  EXPECT_LT(std::abs(error.z()), radians(0.2));
}

TEST(ScanMatcher, deviationIsWhatItSays) {
  const auto room = test::distinctiveRoom();
  const PoseInformation start = guess(kTruth);
  double squares = 0.0;
  constexpr int kTrials = 40;
  for (unsigned trial = 0; trial < kTrials; ++trial) {
    const SurfaceMap own = mapOf(room, kOwnPlaces, kOwnOdom, {}, 2 * trial + 1),
                     peer = mapOf(room, kPeerPlaces, kPeerOdom, {}, 2 * trial + 2);
    const ScanMatch match = refineMatch(own.index, peer.sample, start);
    ASSERT_TRUE(match.converged);
    const Eigen::Vector3d error = stepBetween(kTruth, match.estimate.pose, start.center);
    EXPECT_LT(error.head<2>().norm(), 0.04);
    squares += error.dot(match.estimate.information * error) / (3.0 * kTrials);
  }
  EXPECT_LT(squares, 1.5);   // not too sure of itself
  EXPECT_GT(squares, 0.02);  // nor without an opinion
}

TEST(ScanMatcher, tooFewPointsAreNoMatch) {
  const SurfaceMap own = mapOf(test::distinctiveRoom(), kOwnPlaces, kOwnOdom, {}, 1);
  EXPECT_FALSE(refineMatch(own.index, {}, guess(kTruth)).converged);
  EXPECT_FALSE(refineMatch(PointIndex({}, 0.4), own.sample, guess(kTruth)).converged);
}

TEST(ScanMatcher, corridorsAreNotObservedAlong) {
  const std::vector<Pose2> here{{0.0, 1.0, 0.0}, {0.7, 1.1, 0.1}}, there{{2.0, 0.9, 3.0}, {1.4, 1.0, 3.1}};
  const SurfaceMap own = mapOf(test::corridor(), here, kOwnOdom, {}, 1), peer = mapOf(test::corridor(), there, kPeerOdom, {}, 2);
  const ScanMatch match = refineMatch(own.index, peer.sample, guess(kTruth));
  ASSERT_TRUE(match.converged);
  EXPECT_LT(match.observability.share, 0.05);
  const Eigen::Vector2d along = Pose2{0.0, 0.0, -kOwnOdom.yaw} * Eigen::Vector2d(1.0, 0.0);
  EXPECT_GT(std::abs(match.observability.weakest.dot(along)), 0.99);
  const Eigen::Matrix3d projected = withoutDirection(match.estimate.information, match.observability.weakest);
  const Eigen::Vector3d u(match.observability.weakest.x(), match.observability.weakest.y(), 0.0);
  EXPECT_NEAR(u.dot(projected * u), 0.0, 1e-6);
  const Eigen::Vector3d across(-u.y(), u.x(), 0.0);
  EXPECT_GT(across.dot(projected * across), 100.0);
}

TEST(PoseInformation, movesBetweenCenters) {
  const PoseEstimate estimate{{1.0, 2.0, 0.4}, Eigen::Vector3d(0.01, 0.02, 0.003).asDiagonal()};
  const Eigen::Vector2d center(4.0, -1.0), other(-2.0, 3.0);
  const Eigen::Matrix3d about = covarianceAbout(estimate, center);
  EXPECT_TRUE(covarianceOfPose(estimate.pose, center, about).isApprox(estimate.covariance, 1e-12));
  const PoseInformation information{estimate.pose, center, about.inverse()};
  EXPECT_TRUE(informationAbout(information, other).inverse().isApprox(covarianceAbout(estimate, other), 1e-9));
  EXPECT_EQ(observabilityOf(Eigen::Matrix3d::Zero()).share, 0.0);
  const Eigen::Vector3d step(0.1, -0.2, 0.3);
  EXPECT_TRUE(stepBetween(estimate.pose, movedAbout(estimate.pose, center, step), center).isApprox(step, 1e-9));
}

TEST(FreeSpace, aTruePoseHasNoViolations) {
  const auto room = test::distinctiveRoom();
  const SurfaceMap own = mapOf(room, kOwnPlaces, kOwnOdom, {}, 1), peer = mapOf(room, kPeerPlaces, kPeerOdom, {}, 2);
  const FreeSpaceVote vote = voteOnFreeSpace(own.submap, peer.submap, kTruth);
  EXPECT_GT(vote.matches, 100);
  EXPECT_LT(vote.violationShare(), 0.02);
}

TEST(FreeSpace, aShiftedPoseIsRejected) {
  const auto room = test::distinctiveRoom();
  const SurfaceMap own = mapOf(room, kOwnPlaces, kOwnOdom, {}, 1), peer = mapOf(room, kPeerPlaces, kPeerOdom, {}, 2);
  const PoseInformation start = guess(kTruth);
  for (const Eigen::Vector3d& step :
       {Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d(0.0, -1.2, 0.0), Eigen::Vector3d(0.0, 0.0, kPi)}) {
    const Pose2 wrong = movedAbout(kTruth, start.center, step);
    const FreeSpaceVote vote = voteOnFreeSpace(own.submap, peer.submap, wrong);
    EXPECT_GT(vote.violationShare(), 0.1) << step.transpose();
    const SurfaceVerdict verdict = checkSurfaces(own, peer, {wrong, start.center, 1e4 * Eigen::Matrix3d::Identity()}, {});
    EXPECT_FALSE(verdict.agrees) << step.transpose();
  }
}

TEST(Submap, dropsWhatWasSeenThrough) {
  const auto walls = test::segmentWorld(test::distinctiveRoom());
  std::mt19937 random(1);
  std::vector<PlacedScan> scans =
      test::scansFrom(walls, {kOwnPlaces[0]}, kOwnOdom, {}, random, {{test::kRobot, {3.4, 4.0, 0.0}, true}});
  const auto near_robot = [](const Submap& submap) {
    int count = 0;
    for (const SurfacePoint& point : submap.points())
      count += (kOwnOdom * point.position - Eigen::Vector2d(3.4, 4.0)).norm() < 0.6;
    return count;
  };
  EXPECT_GT(near_robot(Submap(scans)), 5);
  for (const PlacedScan& later : test::scansFrom(walls, {kOwnPlaces[1]}, kOwnOdom, {}, random)) scans.push_back(later);
  EXPECT_EQ(near_robot(Submap(scans)), 0);
}

TEST(GlobalSearch, findsTheRoomWithoutAGuess) {
  const auto room = test::distinctiveRoom();
  const SurfaceMap own = mapOf(room, kOwnPlaces, kOwnOdom, {}, 1), peer = mapOf(room, kPeerPlaces, kPeerOdom, {}, 2);
  const auto found = searchGlobally(own, peer, {});
  ASSERT_TRUE(found);
  const Eigen::Vector3d error = stepBetween(kTruth, found->pose, found->center);
  EXPECT_LT(error.head<2>().norm(), 0.05);
  EXPECT_LT(std::abs(error.z()), radians(1.0));
}

TEST(GlobalSearch, doesNotKnowInACorridor) {
  const SurfaceMap own = mapOf(test::corridor(), {{0.0, 1.0, 0.0}}, kOwnOdom, {}, 1);
  const SurfaceMap peer = mapOf(test::corridor(), {{20.0, 1.0, 0.0}}, kPeerOdom, {}, 2);
  EXPECT_FALSE(searchGlobally(own, peer, {}));
  EXPECT_FALSE(searchGlobally(own, SurfaceMap({}), {}));
}

TEST(GlobalSearch, aMirroredRoomIsNotTheRoom) {
  std::vector<test::WallSegment> mirrored = test::distinctiveRoom();
  for (test::WallSegment& wall : mirrored) {
    wall.a.x() = 9.0 - wall.a.x();
    wall.b.x() = 9.0 - wall.b.x();
  }
  const SurfaceMap own = mapOf(test::distinctiveRoom(), kOwnPlaces, kOwnOdom, {}, 1),
                   peer = mapOf(mirrored, kPeerPlaces, kPeerOdom, {}, 2);
  EXPECT_FALSE(searchGlobally(own, peer, {}));
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
