// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/local_node.h"

#include <tf2_ros/transform_listener.h>

#include "node_fixture.h"

namespace parley {
namespace {

using test::Listener;
using test::refusal;

/// A robot that drives straight on at 1 m/s, and odometry that is corrected in between.
class LocalNodeTest : public test::NodeFixture {
 protected:
  LocalNodeTest() : raw_(nh_.advertise<nav_msgs::Odometry>("odom", 10)) {
    setParameters(pnh("local"));
    pnh("local").setParam("frames/local", "local");
    odometry_.shutdown();
  }

  nav_msgs::Odometry reading() const {
    Odometry odometry;
    odometry.stamp = time_;
    odometry.pose = correction_ * Pose2{time_ - 10.0, 0.0, 0.0};
    odometry.twist.speed = 1.0;
    return toMessage(odometry, "odom", "base_link");
  }

  /// Readings at 20 Hz until something holds.
  bool driveUntil(const std::function<bool()>& holds) {
    for (int i = 0; i < 1000 && !holds(); ++i) {
      setTime(time_ + 0.05);
      raw_.publish(reading());
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return holds();
  }
  bool isPlacedAt(const Pose2& pose) const {
    if (!buffer_.canTransform("odom", "local", ros::Time(0))) return false;
    const geometry_msgs::Transform t = buffer_.lookupTransform("odom", "local", ros::Time(0)).transform;
    return std::hypot(t.translation.x - pose.x, t.translation.y - pose.y) < 0.02 &&
           std::abs(2.0 * std::atan2(t.rotation.z, t.rotation.w) - pose.yaw) < 0.01;
  }

  Pose2 correction_;
  ros::Publisher raw_;
  Listener<nav_msgs::Odometry> smooth_{nh_, "local_odom"};
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_{buffer_};
};

TEST_F(LocalNodeTest, CorrectionsMoveTheFrameNotTheRobot) {
  const LocalNode node(nh_, pnh("local"), "local");
  ASSERT_TRUE(driveUntil([this] { return smooth_.count() > 10 && isPlacedAt({}); }));
  correction_ = {0.3, -0.2, 0.05};
  smooth_.clear();
  ASSERT_TRUE(driveUntil([this] { return smooth_.count() > 10 && isPlacedAt(correction_); }));
  const auto last = smooth_.last();
  EXPECT_EQ(last->header.frame_id, "local");
  EXPECT_EQ(last->child_frame_id, "base_link");
  EXPECT_NEAR(last->pose.pose.position.x, last->header.stamp.toSec() - 10.0, 0.02);
  EXPECT_NEAR(last->pose.pose.position.y, 0.0, 0.02);
  EXPECT_NEAR(last->twist.twist.linear.x, 1.0, 1e-9);
}

TEST_F(LocalNodeTest, DropsWhatIsNotItsOdometry) {
  const LocalNode node(nh_, pnh("local"), "local");
  ASSERT_TRUE(driveUntil([this] { return smooth_.count() > 2; }));
  setTime(time_ + 0.02);
  nav_msgs::Odometry bad = reading();
  bad.header.frame_id = "map";
  bad.pose.pose.position.x += 0.5;  // would be a correction
  raw_.publish(bad);
  setTime(time_ + 0.02);
  bad = reading();
  bad.pose.pose.position.x = std::nan("");
  raw_.publish(bad);
  smooth_.clear();
  ASSERT_TRUE(driveUntil([this] { return smooth_.count() > 5; }));
  EXPECT_NEAR(smooth_.last()->pose.pose.position.x, smooth_.last()->header.stamp.toSec() - 10.0, 0.02);
  EXPECT_TRUE(isPlacedAt({}));
}

TEST_F(LocalNodeTest, PassesOnWhatIsToStayAsItIs) {
  pnh("local").setParam("frames/local", "odom");
  const LocalNode node(nh_, pnh("local"), "local");
  ASSERT_TRUE(driveUntil([this] { return smooth_.count() > 10; }));
  correction_ = {0.3, -0.2, 0.05};
  smooth_.clear();
  ASSERT_TRUE(driveUntil([this] { return smooth_.count() > 5; }));
  EXPECT_EQ(smooth_.last()->header.frame_id, "odom");
  EXPECT_LT(smooth_.last()->pose.pose.position.y, -0.15);
}

TEST_F(LocalNodeTest, RefusesUnusableParameters) {
  pnh("local").setParam("wiring/correction_distance", -1.0);
  pnh("local").deleteParam("frames/local");
  pnh("local").setParam("unheard_of", 1.0);
  const std::string text = refusal<LocalNode>(nh_, pnh("local"));
  for (const char* name : {"correction_distance", "local: is missing", "unheard_of"})
    EXPECT_NE(text.find(name), std::string::npos) << text;
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "local_node_test");
  ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
