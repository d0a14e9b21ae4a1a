// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/odometry_node.h"

#include <tf2_ros/transform_listener.h>

#include "node_fixture.h"

namespace parley {
namespace {

using test::Listener;
using test::refusal;

/// Lidar odometry of an IMU 0.3 m ahead of the base and turned to its left, on a robot that drives straight on at 1 m/s.
class OdometryNodeTest : public test::NodeFixture {
 protected:
  OdometryNodeTest() : lidar_odometry_(nh_.advertise<nav_msgs::Odometry>("lidar_odometry", 10)) {
    setParameters(pnh("odometry"));
    pnh("odometry").setParam("robot/mount/x", 0.3);
    pnh("odometry").setParam("robot/mount/yaw", 0.5 * kPi);
    odometry_.shutdown();
  }

  nav_msgs::Odometry reading() const {
    nav_msgs::Odometry message;
    message.header.stamp = ros::Time(time_);
    message.header.frame_id = "camera_init";
    message.child_frame_id = "body";
    message.pose.pose.position.y = -(time_ - 10.0);  // ahead is the right of the IMU
    message.pose.pose.position.z = 0.02;
    message.pose.pose.orientation.w = 1.0;
    return message;
  }

  /// Readings at 20 Hz until something holds.
  bool driveUntil(const std::function<bool()>& holds) {
    for (int i = 0; i < 1000 && !holds(); ++i) {
      setTime(time_ + 0.05);
      lidar_odometry_.publish(reading());
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return holds();
  }

  ros::Publisher lidar_odometry_;
  Listener<nav_msgs::Odometry> found_{nh_, "odom"};
};

TEST_F(OdometryNodeTest, TellsTheBasesPoseAndTwist) {
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  const OdometryNode node(nh_, pnh("odometry"), "odometry");
  ASSERT_TRUE(driveUntil([this] { return found_.count() > 10; }));
  const auto last = found_.last();
  EXPECT_EQ(last->header.frame_id, "odom");
  EXPECT_EQ(last->child_frame_id, "base_link");
  EXPECT_NEAR(last->pose.pose.position.x, last->header.stamp.toSec() - 10.0, 1e-6);
  EXPECT_NEAR(last->pose.pose.position.y, 0.0, 1e-6);
  EXPECT_NEAR(last->twist.twist.linear.x, 1.0, 0.01);
  EXPECT_NEAR(last->twist.twist.angular.z, 0.0, 0.01);
  EXPECT_TRUE(driveUntil([&] { return buffer.canTransform("odom", "base_link", ros::Time(0)); }));
  ASSERT_TRUE(driveUntil([&] { return buffer.canTransform("odom", "camera_init", ros::Time(0)); }));
  EXPECT_NEAR(buffer.lookupTransform("odom", "camera_init", ros::Time(0)).transform.translation.x, 0.3, 1e-9);
}

TEST_F(OdometryNodeTest, DropsWhatIsNoPose) {
  const OdometryNode node(nh_, pnh("odometry"), "odometry");
  ASSERT_TRUE(driveUntil([this] { return found_.count() > 2; }));
  nav_msgs::Odometry bad = reading();
  bad.header.stamp += ros::Duration(0.01);
  bad.pose.pose.position.x = std::nan("");
  lidar_odometry_.publish(bad);
  bad = reading();
  bad.header.stamp += ros::Duration(0.02);
  bad.pose.pose.orientation.w = 0.0;
  lidar_odometry_.publish(bad);
  found_.clear();
  ASSERT_TRUE(driveUntil([this] { return found_.count() > 5; }));
  EXPECT_TRUE(std::isfinite(found_.last()->pose.pose.position.x));
  EXPECT_NEAR(found_.last()->twist.twist.linear.x, 1.0, 0.01);
}

TEST_F(OdometryNodeTest, RefusesUnusableParameters) {
  pnh("odometry").setParam("standing_time", -1.0);
  pnh("odometry").setParam("unheard_of", 1.0);
  const std::string text = refusal<OdometryNode>(nh_, pnh("odometry"));
  EXPECT_NE(text.find("standing_time"), std::string::npos) << text;
  EXPECT_NE(text.find("unheard_of"), std::string::npos) << text;
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "odometry_node_test");
  ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
