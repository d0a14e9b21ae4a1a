// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>

#include <string>
#include <vector>

namespace parley {

/// Three seconds after the start, warns about every input that nobody publishes and names the topics of its type that
/// exist: most first runs on a robot fail for a topic's name.
class InputCheck {
 public:
  InputCheck(const ros::NodeHandle& nh, std::string name);

  template <class Message>
  void expect(const ros::Subscriber& subscriber) {
    inputs_.push_back({{subscriber, ros::message_traits::DataType<Message>::value()}});
  }
  /// One of the two is enough.
  template <class MessageA, class MessageB>
  void expectEither(const ros::Subscriber& a, const ros::Subscriber& b) {
    inputs_.push_back(
        {{a, ros::message_traits::DataType<MessageA>::value()}, {b, ros::message_traits::DataType<MessageB>::value()}});
  }

  /// A sentence for each input that nobody publishes at present.
  std::vector<std::string> missing() const;

 private:
  struct Topic {
    ros::Subscriber subscriber;
    std::string type;
  };

  std::string name_;
  std::vector<std::vector<Topic>> inputs_;  // of each, one topic is enough
  ros::WallTimer timer_;
};

}  // namespace parley
