// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/bag_recorder.h"

#include <rosbag/bag.h>
#include <rosgraph_msgs/Clock.h>

#include <memory>

#include "bag_messages.h"
#include "parley_sim/input_error.h"

namespace parley::sim {
namespace {

/// One robot's topics, all by its own clock.
class BagRecorder {
 public:
  BagRecorder(const std::string& file, std::size_t robot) : file_(file), robot_(robot) {
    try {
      bag_.open(file, rosbag::bagmode::Write);
    } catch (const rosbag::BagException& error) {
      throw InputError("--bag: " + file + ": cannot be written: " + error.what());
    }
  }

  void note(const FleetRunner& runner) {
    const SensorReadings& readings = runner.readings()[robot_];
    if (!readings.present || readings.clock < 1e-3) return;  // ROS has no time before 0
    try {
      write(runner.simulation().scenario().robots[robot_], readings);
    } catch (const rosbag::BagException& error) {
      throw InputError("--bag: " + file_ + ": cannot be written: " + error.what());
    }
  }

 private:
  void write(const RobotSpec& spec, const SensorReadings& readings) {
    const ros::Time now(readings.clock);
    if (!started_) {
      writeLatched("/tf_static", now, mountMessage(spec.lidar, readings.clock));
      writeLatched("/move_base_simple/goal", now, goalMessage(spec.goalInOdom(), readings.clock));
      started_ = true;
    }
    rosgraph_msgs::Clock clock;
    clock.clock = now;
    bag_.write("/clock", now, clock);
    if (readings.odometry) {
      bag_.write("/odom", now, odometryMessage(*readings.odometry));
      bag_.write("/tf", now, transformMessage(*readings.odometry));
    }
    if (readings.scan) bag_.write("/scan", now, scanMessage(*readings.scan));
    if (readings.cloud && readings.cloud->stamp > 0.0) bag_.write("/points", now, cloudMessage(*readings.cloud));
  }

  /// A bag takes a connection's header as a whole, so that the message's type has to be in it.
  template <class Message>
  void writeLatched(const std::string& topic, const ros::Time& time, const Message& message) {
    auto header = boost::make_shared<ros::M_string>();
    (*header)["topic"] = topic;
    (*header)["type"] = ros::message_traits::datatype(message);
    (*header)["md5sum"] = ros::message_traits::md5sum(message);
    (*header)["message_definition"] = ros::message_traits::definition(message);
    (*header)["latching"] = "1";
    bag_.write(topic, time, message, header);
  }

  std::string file_;
  std::size_t robot_;
  rosbag::Bag bag_;
  bool started_ = false;
};

}  // namespace

StepObserver recordBag(const std::string& file, std::size_t robot) {
  auto recorder = std::make_shared<BagRecorder>(file, robot);
  return [recorder](const FleetRunner& runner) { recorder->note(runner); };
}

}  // namespace parley::sim
