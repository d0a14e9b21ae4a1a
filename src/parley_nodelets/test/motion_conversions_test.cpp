// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/motion_conversions.h"

#include <gtest/gtest.h>

#include <limits>

namespace parley {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(TrajectoryMessage, ComesBack) {
  TimedPlan plan;
  plan.made_at = 10.0;
  plan.start_time = 10.05;
  plan.result.status = {PlanCode::kBlocked, "a box"};
  plan.result.trajectory = SampledTrajectory({{10.05, {1.0, 2.0, 0.5}, {0.3, 0.1}}, {11.0, {1.5, 2.0, 0.6}, {}}});
  const auto back = fromMessage(toMessage(plan, "odom"));
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->start_time, 10.05, 1e-9);
  EXPECT_EQ(back->result.status.code, PlanCode::kBlocked);
  EXPECT_EQ(back->result.status.text, "a box");
  ASSERT_EQ(back->result.trajectory.points().size(), 2U);
  EXPECT_TRUE(back->result.trajectory.points()[0].pose == plan.result.trajectory.points()[0].pose);
  EXPECT_EQ(back->result.trajectory.points()[0].twist.turn_rate, 0.1);
}

TEST(TrajectoryMessage, SaysEveryVerdictAndTheIntentAlsoWhereItKeepsWhatIsDriven) {
  TimedPlan plan;
  plan.result.keep_committed = true;
  plan.result.intent = {{2.0, 0xffffffffU, 3}, {{1.0, 2.0}, {-3.0, 4.5}}};
  for (int code = 0; code <= static_cast<int>(PlanCode::kEscaping); ++code) {
    plan.result.status = {static_cast<PlanCode>(code), ""};
    const auto back = fromMessage(toMessage(plan, "odom"));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->result.status.code, plan.result.status.code);
    EXPECT_EQ(back->result.intent.right.priority, 2.0);
    EXPECT_EQ(back->result.intent.right.holder, 0xffffffffU);
    EXPECT_EQ(back->result.intent.right.depth, 3);
    EXPECT_EQ(back->result.intent.way, plan.result.intent.way);
  }
  EXPECT_EQ(static_cast<int>(PlanCode::kYielding), static_cast<int>(parley_msgs::Trajectory::YIELDING));
  EXPECT_EQ(static_cast<int>(PlanCode::kEscaping), static_cast<int>(parley_msgs::Trajectory::ESCAPING));
}

TEST(TrajectoryMessage, RefusesTimeThatRunsBackAndWhatIsNotFinite) {
  TimedPlan plan;
  plan.result.trajectory = SampledTrajectory({{1.0, {}, {}}, {2.0, {}, {}}});
  auto message = toMessage(plan, "odom");
  std::swap(message.points[0], message.points[1]);
  EXPECT_FALSE(fromMessage(message));
  message = toMessage(plan, "odom");
  message.points[1].yaw = kNan;
  EXPECT_FALSE(fromMessage(message));
  message = toMessage(plan, "odom");
  message.verdict = 77;
  EXPECT_FALSE(fromMessage(message));
  message = toMessage(plan, "odom");
  message.intent.priority = kInfinity;
  EXPECT_FALSE(fromMessage(message));
  message = toMessage(plan, "odom");
  message.intent.way.resize(1);
  message.intent.way[0].x = kNan;
  EXPECT_FALSE(fromMessage(message));
}

TeamMotions someMotions() {
  TeamMotions motions;
  motions.stamp = 7.5;
  motions.id = 0x80000001U;
  motions.team_known = true;
  PeerMotion peer;
  peer.id = 42;
  peer.footprint = {0.9, 0.5};
  peer.trajectory = SampledTrajectory({{7.0, {1.0, 2.0, 3.0}, {0.5, 0.25}}, {8.5, {2.0, 2.0, 3.1}, {}}});
  peer.heard = 7.25;
  peer.sigma = 0.125;
  peer.intent = {{1.0, 43, 1}, {{1.0, 2.0}, {9.0, 2.0}}};
  motions.peers = {peer, peer};
  motions.peers[1].id = 43;
  motions.peers[1].intent.way.clear();
  return motions;
}

TEST(PeerMotionsMessage, ComesBack) {
  Teammate known;
  known.name = "bob";
  const auto message = toMessage(someMotions(), {{42, known}}, "odom");
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.peers[0].name, "bob");
  EXPECT_EQ(message.peers[1].name, "");
  const auto back = fromMessage(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->stamp, 7.5);
  EXPECT_EQ(back->id, 0x80000001U);
  EXPECT_TRUE(back->team_known);
  ASSERT_EQ(back->peers.size(), 2U);
  const PeerMotion& peer = back->peers[0];
  EXPECT_EQ(peer.id, 42U);
  EXPECT_EQ(peer.footprint.length, 0.9);
  EXPECT_EQ(peer.footprint.width, 0.5);
  EXPECT_EQ(peer.heard, 7.25);
  EXPECT_EQ(peer.sigma, 0.125);
  ASSERT_EQ(peer.trajectory.points().size(), 2U);
  EXPECT_EQ(peer.trajectory.points()[1].time, 8.5);
  EXPECT_EQ(peer.trajectory.points()[1].pose.yaw, 3.1);
  EXPECT_EQ(peer.trajectory.points()[0].twist.turn_rate, 0.25);
  EXPECT_EQ(peer.intent.right.holder, 43U);
  EXPECT_EQ(peer.intent.right.depth, 1);
  EXPECT_EQ(peer.intent.way.back().x(), 9.0);
  EXPECT_TRUE(back->peers[1].intent.way.empty());
}

TEST(PeerMotionsMessage, OneThatCannotBeIsRefusedWithAll) {
  const std::vector<void (*)(parley_msgs::PeerMotion&)> changes{
      [](parley_msgs::PeerMotion& m) { m.trajectory.clear(); },
      [](parley_msgs::PeerMotion& m) { std::swap(m.trajectory[0], m.trajectory[1]); },
      [](parley_msgs::PeerMotion& m) { m.trajectory[1].turn_rate = kInfinity; },
      [](parley_msgs::PeerMotion& m) { m.length = 0.0; },
      [](parley_msgs::PeerMotion& m) { m.width = kNan; },
      [](parley_msgs::PeerMotion& m) { m.length = kInfinity; },
      [](parley_msgs::PeerMotion& m) { m.sigma = -0.1; },
      [](parley_msgs::PeerMotion& m) { m.sigma = kNan; },
      [](parley_msgs::PeerMotion& m) { m.intent.priority = kNan; },
      [](parley_msgs::PeerMotion& m) { m.intent.way[1].y = kInfinity; },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    auto message = toMessage(someMotions(), {}, "odom");
    changes[i](message.peers[0]);
    EXPECT_FALSE(fromMessage(message)) << i;
  }
  EXPECT_TRUE(fromMessage(parley_msgs::PeerMotions())) << "nobody is known";
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
