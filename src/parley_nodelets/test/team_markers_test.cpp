// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/team_markers.h"

#include <gtest/gtest.h>

#include <set>

namespace parley {
namespace {

using visualization_msgs::Marker;

const Marker& marker(const visualization_msgs::MarkerArray& markers, const std::string& name) {
  for (const Marker& m : markers.markers) {
    if (m.ns == name) return m;
  }
  ADD_FAILURE() << name;
  return markers.markers.front();
}

parley_msgs::MapLayer layer(bool obstacle) {
  parley_msgs::MapLayer message;
  message.origin = "00000001";
  message.T_odom_peer.position.x = 10.0;
  message.T_odom_peer.orientation.w = 1.0;
  message.obstacle = obstacle;
  message.contours.resize(1);
  for (const double x : {0.0, 1.0, 2.0}) {
    geometry_msgs::Point point;
    point.x = x;
    message.contours[0].points.push_back(point);
  }
  return message;
}

TEST(TeamMarkers, DrawPeersWhereTheyAreBelievedToBe) {
  const DrawnPeer ann{
      "ann", PoseState::kConfirmed, {4.0, 2.0, 0.0}, {0.8, 0.4}, {{4.0, 2.0}, {5.0, 2.0}, {6.0, 2.5}}, {{4.0, 2.0}, {9.0, 2.0}},
      ""};
  const DrawnPeer bob{"bob", PoseState::kTentative, {-4.0, 0.0, 0.0}, {0.8, 0.4}, {}, {{-4.0, 0.0}, {-4.0, 1.0}, {0.0, 1.0}},
                      "ann"};
  const auto markers = teamMarkers({ann, bob}, {{"00000001", layer(true)}}, 2.0, "odom", 100);
  ASSERT_FALSE(markers.markers.empty());
  EXPECT_EQ(markers.markers[0].action, Marker::DELETEALL) << "peers that have gone are drawn no more";
  ASSERT_EQ(marker(markers, "peers").points.size(), 10U) << "four sides and the heading";
  for (const geometry_msgs::Point& p : marker(markers, "peers").points) EXPECT_LE(std::hypot(p.x - 4.0, p.y - 2.0), 0.45);
  EXPECT_EQ(marker(markers, "peers in doubt").points.size(), 10U);
  EXPECT_EQ(marker(markers, "plans").points.size(), 4U);
  EXPECT_EQ(marker(markers, "ways").points.size(), 2U);
  EXPECT_EQ(marker(markers, "ways of those who make room").points.size(), 4U);
  EXPECT_LT(marker(markers, "ways").scale.x, marker(markers, "plans").scale.x) << "thinner than what is certain";
  EXPECT_EQ(marker(markers, "maps").points.size(), 4U) << "an open outline";
  EXPECT_EQ(marker(markers, "maps").points[3].x, 12.0);
  EXPECT_EQ(marker(markers, "maps in doubt").action, Marker::DELETE);
  std::set<std::string> texts;
  std::set<int> ids;
  for (const Marker& m : markers.markers) {
    EXPECT_EQ(m.header.frame_id, "odom");
    if (m.ns != "names") continue;
    texts.insert(m.text);
    ids.insert(m.id);
  }
  EXPECT_EQ(texts, (std::set<std::string>{"ann", "bob\ntentative\nmakes room for ann"}));
  EXPECT_EQ(ids.size(), 2U);
}

TEST(TeamMarkers, AreBounded) {
  const auto markers = teamMarkers({}, {{"a", layer(false)}, {"b", layer(false)}}, 2.0, "odom", 5);
  EXPECT_EQ(marker(markers, "maps in doubt").points.size(), 4U) << "whole lines within the bound";
  EXPECT_EQ(marker(markers, "maps").action, Marker::DELETE);
}

}  // namespace
}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
