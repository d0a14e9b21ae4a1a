// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/radio.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "parley_exchange/udp_transport.h"
#include "parley_nodelets/sensor_conversions.h"

namespace parley {
namespace {

constexpr std::uint32_t kQueue = 200;  // [-] packets: a second of a team of twenty
constexpr std::size_t kHeld = 1000;    // [-] packets that wait for the worker

std::vector<std::string> words(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream stream(text);
  std::vector<std::string> all;
  for (std::string word; stream >> word;) all.push_back(word);
  return all;
}

parley_msgs::PacketPtr toMessage(const Packet& packet, double now) {
  auto message = boost::make_shared<parley_msgs::Packet>();
  message->stamp = toRosTime(now);
  message->data = packet.bytes;
  return message;
}

}  // namespace

Radio::Radio(ros::NodeHandle& nh, const RadioOptions& options)
    : sent_publisher_(nh.advertise<parley_msgs::Packet>("radio/sent", kQueue)) {
  if (options.transport == "udp") {
    UdpSettings settings;
    settings.port = static_cast<std::uint16_t>(options.port);
    settings.broadcast = options.broadcast;
    settings.peers = words(options.peers);
    transport_ = openUdp(settings);
    received_publisher_ = nh.advertise<parley_msgs::Packet>("radio/received", kQueue);
  } else if (options.transport == "topic") {
    received_subscriber_ = nh.subscribe("radio/received", kQueue, &Radio::onPacket, this, ros::TransportHints().tcpNoDelay());
  } else {
    throw std::invalid_argument("transport: '" + options.transport + "' is neither udp nor topic");
  }
}

void Radio::onPacket(const parley_msgs::PacketConstPtr& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  received_.push_back({message->data});
  if (received_.size() <= kHeld) return;
  received_.pop_front();
  ++overflows_;
}

int Radio::overflows() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return overflows_;
}

void Radio::noteProblem() {
  ++failures_;
  problem_ = transport_->problem();
}

void Radio::send(const std::vector<Packet>& packets, double now) {
  for (const Packet& packet : packets) {
    if (transport_ && !transport_->send(packet.bytes, now)) noteProblem();
    sent_publisher_.publish(toMessage(packet, now));
  }
}

std::vector<Packet> Radio::receive(double now) {
  std::vector<Packet> packets;
  if (!transport_) {
    const std::lock_guard<std::mutex> lock(mutex_);
    packets.assign(std::make_move_iterator(received_.begin()), std::make_move_iterator(received_.end()));
    received_.clear();
    return packets;
  }
  for (Bytes& datagram : transport_->receive(now)) packets.push_back({std::move(datagram)});
  if (!transport_->problem().empty()) noteProblem();
  for (const Packet& packet : packets) received_publisher_.publish(toMessage(packet, now));
  return packets;
}

}  // namespace parley
