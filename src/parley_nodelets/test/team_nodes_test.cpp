// SPDX-License-Identifier: BSD-3-Clause
#include <parley_msgs/Packet.h>
#include <parley_msgs/PeerArray.h>
#include <parley_msgs/PeerMaps.h>
#include <parley_msgs/PeerMotions.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "node_fixture.h"
#include "parley_exchange/packet_codec.h"
#include "parley_exchange/seal.h"
#include "parley_exchange/team_key.h"
#include "parley_nodelets/lidar_node.h"
#include "parley_nodelets/team_conversions.h"
#include "parley_nodelets/team_node.h"

namespace parley {
namespace {

using test::Listener;
using test::refusal;

/// Two robots under one master, in namespaces of their own. They stand in the same place, as odometry and scans are the
/// fixture's for both.
class TeamNodeTest : public test::NodeFixture {
 protected:
  TeamNodeTest() {
    folder_ = (std::filesystem::temp_directory_path() / "parley_team_XXXXXX").string();
    EXPECT_NE(::mkdtemp(folder_.data()), nullptr);
    std::ofstream(folder_ + "/key") << std::string(64, '7');
    std::ofstream(folder_ + "/other_key") << std::string(64, '8');
    setTeam(pnh("team"), "ann");
    setTeam(ros::NodeHandle(bob_nh_, "team"), "bob");
    // bob hears and sees what ann does
    odometry_relay_ = nh_.subscribe<nav_msgs::Odometry>(
        "local_odom", 100, [this](const nav_msgs::OdometryConstPtr& m) { bob_odometry_.publish(m); });
    obstacles_relay_ = nh_.subscribe<parley_msgs::ObstacleScan>(
        "obstacles", 10, [this](const parley_msgs::ObstacleScanConstPtr& m) { bob_obstacles_.publish(m); });
  }
  ~TeamNodeTest() override {
    ros::param::del(bob_nh_.getNamespace());
    std::filesystem::remove_all(folder_);
  }

  void setTeam(const ros::NodeHandle& own, const std::string& name) const {
    setParameters(own);
    own.setParam("name", name);
    own.setParam("key_file", folder_ + "/key");
    own.setParam("transport", "topic");
  }

  /// Over sockets of this machine instead of topics.
  void setUdp(const ros::NodeHandle& own, const std::string& name, int port, int peer_port) const {
    own.setParam("transport", "udp");
    own.setParam("boot_file", folder_ + "/boots_" + name);
    own.setParam("port", port);
    own.setParam("peers", "127.0.0.1:" + std::to_string(peer_port));
  }

  /// The radio between them, which topics alone are not.
  void connect() {
    air_.push_back(carry(nh_, bob_nh_));
    air_.push_back(carry(bob_nh_, nh_));
  }

  static ros::Subscriber carry(ros::NodeHandle from, ros::NodeHandle to) {
    const ros::Publisher out = to.advertise<parley_msgs::Packet>("radio/received", 100);
    return from.subscribe<parley_msgs::Packet>("radio/sent", 100,
                                               [out](const parley_msgs::PacketConstPtr& m) { out.publish(m); });
  }

  /// What a robot last told of where it means to go.
  std::optional<IntentMessage> lastIntent(const Listener<parley_msgs::Packet>& sent) const {
    if (sent.count() == 0) return std::nullopt;
    const Bytes frame(sent.last()->data.begin(), sent.last()->data.end());
    const auto header = readHeader(frame);
    const auto plain = header ? Sealer(loadTeamKey(folder_ + "/key")).open(*header, frame) : std::nullopt;
    return plain ? decodePacket(*plain).intent : std::nullopt;
  }

  static bool knows(const Listener<parley_msgs::PeerArray>& peers, const std::string& name) {
    if (peers.count() == 0 || peers.last()->peers.size() != 1) return false;
    const parley_msgs::Peer& peer = peers.last()->peers[0];
    return peer.name == name && peer.neighbour != 0 && peer.heard > 0.0 && peer.heard_there > 0.0;
  }

  std::string folder_;
  ros::NodeHandle bob_nh_{"bob"};
  ros::Publisher bob_odometry_{bob_nh_.advertise<nav_msgs::Odometry>("local_odom", 100)};
  ros::Publisher bob_obstacles_{bob_nh_.advertise<parley_msgs::ObstacleScan>("obstacles", 10)};
  ros::Subscriber odometry_relay_, obstacles_relay_;
  std::vector<ros::Subscriber> air_;
  LidarNode lidar_{nh_, pnh("lidar"), "lidar"};
  Listener<parley_msgs::PeerArray> ann_peers_{nh_, "peers"}, bob_peers_{bob_nh_, "peers"};
  Listener<parley_msgs::Packet> ann_received_{nh_, "radio/received"};
};

TEST_F(TeamNodeTest, TwoHearEachOtherByTopics) {
  const TeamNode ann(nh_, pnh("team"), "ann"), bob(bob_nh_, ros::NodeHandle(bob_nh_, "team"), "bob");
  connect();
  ASSERT_TRUE(passUntil([this] { return knows(ann_peers_, "bob") && knows(bob_peers_, "ann"); }));
  EXPECT_EQ(ann_peers_.last()->header.frame_id, "odom");
  EXPECT_EQ(ann_peers_.last()->id, robotIdOf("ann"));
  EXPECT_EQ(ann_peers_.last()->peers[0].id, robotIdOf("bob"));
  EXPECT_GT(ann_peers_.last()->bytes_sent, 0);
}

TEST_F(TeamNodeTest, TwoHearEachOtherByUdpAndBagsCanHoldIt) {
  const int port = 20000 + ::getpid() % 20000;
  setUdp(pnh("team"), "ann", port, port + 1);
  setUdp(ros::NodeHandle(bob_nh_, "team"), "bob", port + 1, port);
  const TeamNode ann(nh_, pnh("team"), "ann"), bob(bob_nh_, ros::NodeHandle(bob_nh_, "team"), "bob");
  ASSERT_TRUE(passUntil([this] { return knows(ann_peers_, "bob") && knows(bob_peers_, "ann"); }));
  EXPECT_GT(ann_received_.count(), 0);
}

TEST_F(TeamNodeTest, ThePlannerIsToldOfTheTeamTenTimesASecond) {
  const TeamNode ann(nh_, pnh("team"), "ann"), bob(bob_nh_, ros::NodeHandle(bob_nh_, "team"), "bob");
  connect();
  Listener<parley_msgs::PeerMotions> bobs(bob_nh_, "peer_motions");
  ASSERT_TRUE(passUntil([&] { return bobs.count() > 0 && knows(bob_peers_, "ann"); }));
  obstacles_relay_.shutdown();  // nothing is weighed any more: from here on it is by the clock alone
  bobs.clear();
  const double before = time_;
  ASSERT_TRUE(passUntil([&] { return bobs.count() >= 10; }));
  EXPECT_LT(time_ - before, 1.3);
  EXPECT_EQ(bobs.last()->header.frame_id, "odom");
  EXPECT_EQ(bobs.last()->id, robotIdOf("bob"));
  EXPECT_TRUE(bobs.last()->peers.empty()) << "heard, but not known where";
  EXPECT_FALSE(bobs.last()->team_known);
}

TEST_F(TeamNodeTest, WhatThePlannerMeansToDoIsTold) {
  const TeamNode ann(nh_, pnh("team"), "ann");
  Listener<parley_msgs::Packet> sent(nh_, "radio/sent");
  ros::Publisher plans = nh_.advertise<parley_msgs::Trajectory>("trajectory", 1);
  parley_msgs::Trajectory plan;
  plan.header.frame_id = "odom";
  plan.verdict = parley_msgs::Trajectory::YIELDING;
  plan.keep_committed = true;
  plan.intent.priority = 1.0;
  plan.intent.way.resize(2);
  plan.intent.way[1].x = 4.0;
  const auto publish = [&] {
    plan.header.stamp = plan.start = ros::Time(time_);
    plans.publish(plan);
  };
  for (int i = 0; i < 15; ++i) {
    publish();
    pass();
    EXPECT_FALSE(lastIntent(sent)) << "in nobody's name";
  }
  plan.intent.holder = robotIdOf("bob");
  plan.intent.depth = 1;
  ASSERT_TRUE(passUntil([&] {
    publish();
    return lastIntent(sent).has_value();
  }));
  EXPECT_EQ(lastIntent(sent)->holder, robotIdOf("bob"));
  EXPECT_EQ(lastIntent(sent)->depth, 1);
  ASSERT_EQ(lastIntent(sent)->way.size(), 2U);
  EXPECT_NEAR(lastIntent(sent)->way[1].x(), 4.0, 0.026);
}

TEST_F(TeamNodeTest, AnotherKeyIsAnotherTeam) {
  ros::NodeHandle(bob_nh_, "team").setParam("key_file", folder_ + "/other_key");
  const TeamNode ann(nh_, pnh("team"), "ann"), bob(bob_nh_, ros::NodeHandle(bob_nh_, "team"), "bob");
  connect();
  ASSERT_TRUE(passUntil([this] { return ann_received_.count() > 20 && ann_peers_.count() > 20; }));
  EXPECT_TRUE(ann_peers_.last()->peers.empty());
}

TEST_F(TeamNodeTest, SurvivesHostilePackets) {
  const TeamNode ann(nh_, pnh("team"), "ann"), bob(bob_nh_, ros::NodeHandle(bob_nh_, "team"), "bob");
  connect();
  ros::Publisher air = nh_.advertise<parley_msgs::Packet>("radio/received", 100);
  ASSERT_TRUE(passUntil([this] { return ann_received_.count() > 0; }));
  const std::vector<std::uint8_t> genuine = ann_received_.last()->data;
  for (std::size_t size = 0; size < 1200; size += 17) {
    parley_msgs::Packet packet;
    packet.data.assign(size, static_cast<std::uint8_t>(size));
    air.publish(packet);
    packet.data = genuine;
    packet.data[size % packet.data.size()] ^= 1U;
    air.publish(packet);
  }
  EXPECT_TRUE(passUntil([this] { return knows(ann_peers_, "bob"); }));
}

TEST_F(TeamNodeTest, JoinsAnewWhenTimeJumpsBack) {
  const TeamNode ann(nh_, pnh("team"), "ann"), bob(bob_nh_, ros::NodeHandle(bob_nh_, "team"), "bob");
  connect();
  setTime(500.0);
  ASSERT_TRUE(passUntil([this] { return knows(ann_peers_, "bob"); }));
  Listener<parley_msgs::PeerMaps> maps(nh_, "peer_maps");
  setTime(5.0);
  ASSERT_TRUE(passUntil([this] { return ann_peers_.last()->header.stamp.toSec() < 100.0 && knows(ann_peers_, "bob"); }));
  EXPECT_TRUE(passUntil([&] { return maps.count() > 0; }));
  EXPECT_TRUE(maps.last()->layers.empty());
}

TEST_F(TeamNodeTest, RefusesUnusableParametersInOneMessage) {
  const ros::NodeHandle own = pnh("team");
  own.deleteParam("name");
  own.deleteParam("key_file");
  own.setParam("transport", "udp");
  own.setParam("port", 0);
  own.setParam("exchange/rate", 1.0);
  own.setParam("relative_localization/max_peer", 3);
  const std::string text = refusal<TeamNode>(nh_, own);
  for (const char* part : {"name: is missing", "key_file: is missing", "boot_file: is missing", "port: value 0", "rate: value 1",
                           "max_peer: unknown key"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
}

TEST_F(TeamNodeTest, RefusesATransportOrAKeyThatIsNone) {
  const ros::NodeHandle own = pnh("team");
  own.setParam("transport", "pigeon");
  EXPECT_NE(refusal<TeamNode>(nh_, own).find("pigeon"), std::string::npos);
  own.setParam("transport", "topic");
  own.setParam("key_file", folder_ + "/none");
  EXPECT_NE(refusal<TeamNode>(nh_, own).find("cannot read the team key"), std::string::npos);
}

TEST(TeamConversions, FramesOfPeersCarryTheOwnPrefix) {
  Teammate teammate;
  teammate.id = 0xab12;
  EXPECT_EQ(peerFrame("odom", teammate), "peer/0000ab12/odom") << "no beacon yet";
  teammate.name = "bob";
  EXPECT_EQ(peerFrame("odom", teammate), "peer/bob/odom");
  EXPECT_EQ(peerFrame("robot_1/odom", teammate), "robot_1/peer/bob/odom");
  teammate.name = "bob/base link";
  EXPECT_EQ(peerFrame("odom", teammate), "peer/0000ab12/odom");
}

TEST(TeamConversions, MessagesHoldWhatWasPutIn) {
  const LayerUpdate layer{"bob", 1, 12.5, {1.0, -2.0, 0.5}, true, {{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 2.0}}, true}}};
  const auto back = fromMessage(toMessage(layer));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->origin, "bob");
  EXPECT_EQ(back->stamp, 12.5);
  EXPECT_NEAR(back->T_odom_peer.yaw, 0.5, 1e-12);
  EXPECT_TRUE(back->obstacle);
  ASSERT_EQ(back->contours.size(), 1U);
  EXPECT_EQ(back->contours[0].polygon, layer.contours[0].polygon);

  const std::vector<Contour> contours{{{{0.0, 0.0}, {1.0, 0.0}}, true, false, {-3, 4}, 2}};
  const auto told = fromMessage(toMessage(contours, {}, 1.0, "odom"));
  ASSERT_TRUE(told && told->size() == 1);
  EXPECT_EQ(told->front().tile, contours[0].tile);
  EXPECT_EQ(told->front().piece, 2);
  EXPECT_TRUE(told->front().hole);

  const auto bodies = fromMessage(toMessage({{{1.0, 2.0, 3.0}, {0.8, 0.4}, 0.1}}, 1.0, "odom"));
  ASSERT_TRUE(bodies && bodies->size() == 1);
  EXPECT_NEAR(bodies->front().pose_odom.yaw, 3.0, 1e-12);
  EXPECT_EQ(bodies->front().margin, 0.1);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "team_nodes_test");
  ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
