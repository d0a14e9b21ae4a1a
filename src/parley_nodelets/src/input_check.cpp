// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/input_check.h"

#include <ros/console.h>
#include <ros/master.h>

#include <algorithm>

namespace parley {
namespace {

constexpr double kPatience = 3.0;  // [s] wall time: simulated time may not have begun

std::string topicsOfType(const ros::master::V_TopicInfo& topics, const std::string& type) {
  std::string names;
  for (const ros::master::TopicInfo& topic : topics) {
    if (topic.datatype == type) names += (names.empty() ? "" : ", ") + topic.name;
  }
  return names.empty() ? "none" : names;
}

}  // namespace

InputCheck::InputCheck(const ros::NodeHandle& nh, std::string name) : name_(std::move(name)) {
  timer_ = nh.createWallTimer(
      ros::WallDuration(kPatience),
      [this](const ros::WallTimerEvent&) {
        for (const std::string& text : missing()) ROS_WARN_STREAM_NAMED(name_, name_ << ": " << text);
      },
      true);
}

std::vector<std::string> InputCheck::missing() const {
  std::vector<std::string> sentences;
  ros::master::V_TopicInfo topics;
  for (const std::vector<Topic>& input : inputs_) {
    const bool published =
        std::any_of(input.begin(), input.end(), [](const Topic& t) { return t.subscriber.getNumPublishers() > 0; });
    if (published) continue;
    if (topics.empty()) ros::master::getTopics(topics);
    std::string sentence = "nobody publishes";
    for (const Topic& topic : input) {
      sentence += (&topic == &input.front() ? " " : " or ") + topic.subscriber.getTopic() + " (" + topic.type +
                  "; published of that type: " + topicsOfType(topics, topic.type) + ")";
    }
    sentences.push_back(sentence);
  }
  return sentences;
}

}  // namespace parley
