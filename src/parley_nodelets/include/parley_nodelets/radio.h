// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <parley_msgs/Packet.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>

#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "parley_exchange/transport.h"
#include "parley_robot/packet.h"

namespace parley {

/// How packets leave and reach a robot.
struct RadioOptions {
  std::string transport = "udp";
  int port = 47100;                           // [-]
  std::string broadcast = "255.255.255.255";  // address
  std::string peers;                          // addresses

  template <class Visitor>
  void visit(Visitor& v) {
    v.text("transport", transport, "udp, or topic: packets come by radio/received alone, as in simulation and replay");
    v.integer("port", port, "-", 1, 65535, "UDP port of the team");
    v.text("broadcast", broadcast, "broadcast address of the link, such as 10.0.0.255");
    v.text("peers", peers, "addresses to send to instead, address or address:port, separated by blanks");
  }
};

/// Carries a robot's packets. Whatever the transport, what goes is on `radio/sent` and what comes on `radio/received`, so
/// that a bag holds it.
class Radio {
 public:
  /// Throws std::invalid_argument if the options cannot be used.
  Radio(ros::NodeHandle& nh, const RadioOptions& options);

  void send(const std::vector<Packet>& packets, double now);
  /// What has come since the last call, in order.
  std::vector<Packet> receive(double now);

  int failures() const { return failures_; }
  int overflows() const;
  /// Why the last failure was one; empty before.
  const std::string& problem() const { return problem_; }

 private:
  void onPacket(const parley_msgs::PacketConstPtr& message);
  void noteProblem();

  std::unique_ptr<Transport> transport_;  // null: by topic
  int failures_ = 0;                      // [-]
  std::string problem_;
  mutable std::mutex mutex_;
  std::deque<Packet> received_;  // by topic, not yet taken
  int overflows_ = 0;            // [-] packets lost because nobody took them
  ros::Publisher sent_publisher_;
  ros::Publisher received_publisher_;
  ros::Subscriber received_subscriber_;
};

}  // namespace parley
