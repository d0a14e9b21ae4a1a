// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "body_view.h"
#include "motion_history.h"
#include "rooms.h"

namespace parley {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

MotionReport motionAt(double stamp) { return {stamp, {}, {}, test::kRobot, 0.0}; }

RelativeEdge goodEdge() {
  RelativeEdge edge;
  edge.from = "b";
  edge.to = "c";
  edge.T_from_to.covariance = Covariance3::Identity();
  return edge;
}

ObstacleScan emptyScan(double stamp) {
  ObstacleScan scan;
  scan.stamp = stamp;
  scan.range_max = 4.0;
  scan.ranges.assign(720, std::numeric_limits<float>::infinity());
  return scan;
}

}  // namespace

TEST(Input, badConfigurationIsRefused) {
  RelativeLocalizationOptions options;
  EXPECT_THROW(RelativeLocalization(options, "", test::kRobot), std::invalid_argument);
  EXPECT_THROW(RelativeLocalization(options, "a", {0.0, 0.4}), std::invalid_argument);
  options.sight_noise = -1.0;
  EXPECT_THROW(RelativeLocalization(options, "a", test::kRobot), std::invalid_argument);
}

TEST(Input, whatCannotBeIsCountedAndDropped) {
  RelativeLocalization localization({}, "a", test::kRobot);
  long refused = 0;
  const auto expectRefused = [&] { EXPECT_EQ(localization.counters().refused, ++refused); };
  localization.addOwnScan({kNan, 0.0, 0.0}, emptyScan(1.0));
  expectRefused();
  localization.addOwnScan({}, ObstacleScan{});
  expectRefused();
  localization.addPeerMotion("b", motionAt(kInf));
  expectRefused();
  MotionReport fast = motionAt(1.0);
  fast.twist.speed = 1e6;
  localization.addPeerMotion("b", fast);
  expectRefused();
  localization.addPeerSights("b", {1.0, {}, {{{kNan, 0.0}, 0.3}}});
  expectRefused();
  localization.addPeerKeyframe("b", {1, 1.0, {}, {1, 2, 3}});
  expectRefused();
  localization.addPeerKeyframe("b", {1, kNan, {}, {}});
  expectRefused();
  RelativeEdge edge = goodEdge();
  edge.T_from_to.covariance(0, 0) = -1.0;
  localization.addEdge(edge);
  expectRefused();
  edge = goodEdge();
  edge.to = edge.from;
  localization.addEdge(edge);
  expectRefused();
  localization.addOwnScan({}, emptyScan(2.0));
  localization.addOwnScan({}, emptyScan(2.0));
  expectRefused();
  EXPECT_TRUE(localization.step(2.0).empty());
}

TEST(Input, peersAreBounded) {
  RelativeLocalizationOptions options;
  options.max_peers = 2;
  RelativeLocalization localization(options, "a", test::kRobot);
  for (const char* name : {"a", "b", "c", "d", ""}) localization.addPeerMotion(name, motionAt(1.0));
  EXPECT_EQ(localization.counters().refused_peers, 3);
  EXPECT_EQ(localization.step(1.0).size(), 2U);
  EXPECT_EQ(localization.step(1.0).front().state, PoseState::kUnknown);
  localization.forget("b");
  EXPECT_EQ(localization.step(1.1).size(), 1U);
  localization.reset();
  EXPECT_TRUE(localization.step(1.2).empty());
}

TEST(Input, edgesOfStrangersPlaceNobody) {
  RelativeLocalization localization({}, "a", test::kRobot);
  localization.addOwnScan({}, emptyScan(1.0));
  localization.addEdge(goodEdge());
  EXPECT_TRUE(localization.step(1.0).empty());
  EXPECT_TRUE(localization.edges().empty());
  EXPECT_STREQ(toString(PoseState::kTentative), "tentative");
}

TEST(Input, keyframesAreTakenOnTheWay) {
  std::mt19937 random(1);
  RelativeLocalization localization({}, "a", test::kRobot);
  const auto walls = test::segmentWorld(test::distinctiveRoom());
  for (int i = 0; i < 60; ++i) {
    const Pose2 pose{1.5 + 0.1 * i, 3.0, 0.0};
    localization.addOwnScan(pose, test::simulatedScan(walls, {}, pose, 0.1 * i, {}, random));
  }
  const std::vector<Keyframe> keyframes = localization.keyframes();
  ASSERT_EQ(keyframes.size(), 4U);
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    EXPECT_NEAR((keyframes[i - 1].T_odom_scan.position() - keyframes[i].T_odom_scan.position()).norm(), 0.8, 0.11);
    EXPECT_GT(keyframes[i - 1].id, keyframes[i].id);
  }
  EXPECT_NEAR(localization.travel(), 5.9, 1e-9);
  EXPECT_LE(localization.sights(0.0).size(), static_cast<std::size_t>(RelativeLocalizationOptions().max_reports));
}

TEST(MotionHistory, interpolatesArcs) {
  MotionHistory history(100);
  const auto truth = [](double t) { return integrateTwist({}, 1.5, 1.2, t); };
  for (const double t : {1.0, 0.0, 0.5, 0.25, 0.75, 0.5}) history.add({t, truth(t), 1.5, 1.2, true});
  for (double t = 0.0; t < 1.2; t += 0.03) {
    const auto at = history.at(t);
    ASSERT_TRUE(at) << t;
    EXPECT_LT((at->pose.position() - truth(t).position()).norm(), 0.003) << t;
    EXPECT_NEAR(angleBetween(at->pose.yaw, truth(t).yaw), 0.0, 1e-6);
    EXPECT_NEAR(at->velocity.norm(), 1.5, 0.05);
  }
  EXPECT_FALSE(history.at(-0.1));
  EXPECT_FALSE(history.at(2.0));
  EXPECT_NEAR(history.travel(0.1, 0.9), 1.2, 0.02);
  EXPECT_EQ(history.travel(-5.0, 0.5), 0.0);
}

TEST(MotionHistory, isBoundedAndHasGaps) {
  MotionHistory history(3);
  for (int i = 0; i < 5; ++i) history.add({2.0 * i, {1.0 * i, 0.0, 0.0}, 0.0, 0.0, false});
  EXPECT_FALSE(history.at(3.0));
  EXPECT_FALSE(history.at(7.0));
  EXPECT_TRUE(history.at(8.0));
  EXPECT_FALSE(history.at(8.2));  // without a speed there is nothing to go on with
  history.forgetBefore(7.0);
  EXPECT_FALSE(history.at(6.0));
}

TEST(BodyView, isWhatALidarSees) {
  std::mt19937 random(2);
  test::LidarModel lidar;
  lidar.noise = 0.0;
  const auto nothing = [](const Eigen::Vector2d&, const Eigen::Vector2d&, double) { return kInf; };
  for (double bearing = -3.0; bearing < 3.0; bearing += 0.5) {
    for (double heading = -3.0; heading < 3.0; heading += 0.4) {
      const Pose2 body{2.2 * std::cos(bearing), 2.2 * std::sin(bearing), heading};
      const ObstacleScan scan = test::simulatedScan(nothing, {{test::kRobot, body, false}}, {}, 0.0, lidar, random);
      const auto view = viewOfBody(test::kRobot, body);
      ASSERT_TRUE(view && scan.blobs.size() == 1) << bearing << " " << heading;
      EXPECT_LT((view->position - scan.blobs.front().position).norm(), 0.035);
      EXPECT_NEAR(view->chord, scan.blobs.front().chord, 0.1);
    }
  }
  EXPECT_FALSE(viewOfBody(test::kRobot, {0.2, 0.0, 0.0}));
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
