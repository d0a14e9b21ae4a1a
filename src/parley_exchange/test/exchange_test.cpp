// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "parley_exchange/packet_codec.h"
#include "team.h"

namespace parley {
namespace {

/// Two or more robots that stand about a metre apart, each at the origin of its own odom frame.
Team standingTeam(std::size_t count, std::uint64_t seed = 1) {
  Team team(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t robot = team.add(17.0 * static_cast<double>(i));
    team[robot].setOdometry(standing({}, team.timeOf(robot)), DriveState::kStopped);
  }
  return team;
}

PeerPose confirmedAt(double x) {
  PeerPose pose;
  pose.T_odom_peer.pose = {x, 0.0, 0.0};
  pose.T_odom_peer.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal();
  pose.state = EdgeState::kConfirmed;
  pose.support = 3;
  return pose;
}

}  // namespace

TEST(Exchange, refusesABadIdentityWithAllProblems) {
  ExchangeOptions options;
  options.rate = -1.0;
  ExchangeIdentity identity;
  identity.name = "two words";
  try {
    const Exchange exchange(options, identity);
    FAIL();
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    for (const char* part : {"name", "rate", "footprint: length", "limits: speed"}) {
      EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
    }
  }
}

TEST(Exchange, peersHearOfEachOther) {
  Team team = standingTeam(2);
  team.connectAll();
  team[0].setOdometry({team.timeOf(0), {1.0, 2.0, 0.5}, {0.4, -0.2}, 0.0, 0.0}, DriveState::kDriving);
  team.run(1.0);
  const std::vector<PeerState> peers = team[1].peers(team.timeOf(1));
  ASSERT_EQ(peers.size(), 1U);
  const PeerState& peer = peers[0];
  EXPECT_EQ(peer.name, "robot_0");
  EXPECT_EQ(peer.id, team[0].id());
  EXPECT_TRUE(peer.neighbour);
  EXPECT_TRUE(peer.proven);
  EXPECT_FALSE(peer.duplicate);
  EXPECT_NEAR(peer.odometry.pose.x, 1.0, 0.006);
  EXPECT_NEAR(peer.odometry.twist.speed, 0.4, 0.011);
  EXPECT_NEAR(peer.footprint.length, 0.8, 1e-9);
  EXPECT_NEAR(peer.limits.turn_rate, 1.57, 0.026);
  EXPECT_EQ(peer.state, DriveState::kDriving);
  EXPECT_NEAR(peer.heard, 1.0, 0.01);
  EXPECT_GT(peer.heard_there, 0.9);
  EXPECT_EQ(team.eventCount(1, ExchangeEventKind::kPeerAppeared), 1);
}

TEST(Exchange, clocksAgreeWithinTwentyMilliseconds) {
  for (const double loss : {0.0, 0.5, 0.8}) {
    Team team = standingTeam(2, 5);
    team.connectAll();
    team.loss = loss;
    team.run(20.0, [&](std::size_t i) { team[i].setOdometry(standing({}, team.timeOf(i)), DriveState::kStopped); });
    const PeerState peer = team[1].peers(team.timeOf(1)).front();
    EXPECT_TRUE(peer.clock_known) << loss;
    EXPECT_LT(peer.clock_error, 0.035) << loss;
    // The pose was taken at the team's time of the beacon; what the other makes of it is off by the clock alone.
    const double age = team.timeOf(1) - peer.odometry.stamp;
    EXPECT_LT(std::abs(age - std::round(age / 0.05) * 0.05), 0.02) << loss;
  }
}

TEST(Exchange, aTrajectoryArrivesOnTheOwnClock) {
  Team team = standingTeam(2);
  team.connectAll();
  team.run(2.0);
  std::vector<TrajectoryPoint> points;
  const double start = team.timeOf(0);
  for (int i = 0; i <= 60; ++i) {
    const double t = 0.05 * i, speed = t < 2.0 ? 1.0 : std::max(0.0, 3.0 - t);
    const double x = t < 2.0 ? t : 2.0 + (t - 2.0) - 0.5 * (t - 2.0) * (t - 2.0);
    points.push_back({start + t, {x, 0.0, 0.0}, {speed, 0.0}});
  }
  team[0].setTrajectory(SampledTrajectory(points), DriveState::kDriving);
  team.run(0.15);
  const auto received = team[1].trajectoryOf(team[0].id(), team.timeOf(1));
  ASSERT_TRUE(received);
  EXPECT_EQ(received->state, DriveState::kDriving);
  for (double t = 0.2; t < 3.0; t += 0.1) {
    const double own_time = start + t - team.members[0].clock_offset + team.members[1].clock_offset;
    EXPECT_NEAR(received->trajectory.at(own_time).pose.x, SampledTrajectory(points).at(start + t).pose.x, 0.04) << t;
  }
  EXPECT_NEAR(received->trajectory.points()[2].twist.speed, 1.0, 0.1);
  EXPECT_EQ(received->trajectory.points().back().twist.speed, 0.0);
  EXPECT_FALSE(team[0].trajectoryOf(team[1].id(), team.timeOf(0)));
}

TEST(Exchange, trajectoriesGoOutWhenTheyChangeAndNotTooOften) {
  Team team = standingTeam(1);
  const auto count = [&](double step) {
    const std::int64_t before = team[0].counters().packets_sent;
    double x = 0.0;
    team.run(10.0, [&](std::size_t) {
      x += step;
      team[0].setTrajectory(SampledTrajectory::standing({x, 0.0, 0.0}, team.timeOf(0)), DriveState::kDriving);
    });
    return static_cast<double>(team[0].counters().packets_sent - before) / 10.0;
  };
  const double still = count(0.0), moving = count(0.1);
  EXPECT_LE(still, 3.5) << "with two beacons a second";
  EXPECT_GE(still, 2.0);
  EXPECT_LE(moving, 6.2);
  EXPECT_GE(moving, 3.9);
  const SectionBytes& sections = team[0].counters().sections_sent;
  EXPECT_GT(sections.trajectory, 0U);
}

TEST(Exchange, conflictsAndObservationsArrive) {
  Team team = standingTeam(2);
  team.connectAll();
  team.run(1.0);
  Conflict claim;
  claim.peer = team[1].id();
  claim.kind = ConflictKind::kYield;
  claim.cost = 12.5;
  claim.lease = 3.0;
  claim.round = 4;
  claim.place = Eigen::Vector2d(1.0, -2.0);
  EXPECT_TRUE(team[0].setConflicts({claim}));
  EXPECT_TRUE(team[0].setObservations({{0.0, {1.0, 1.0, 0.1}, {{2.0, 0.5, 0.4}}}}, team.timeOf(0)));
  team.run(0.25);
  const auto conflicts = team[1].conflictsOf(team[0].id());
  ASSERT_TRUE(conflicts);
  ASSERT_EQ(conflicts->conflicts.size(), 1U);
  EXPECT_EQ(conflicts->conflicts[0].kind, ConflictKind::kYield);
  EXPECT_NEAR(conflicts->conflicts[0].place->y(), -2.0, 0.006);
  const auto observations = team[1].observationsOf(team[0].id(), team.timeOf(1));
  ASSERT_EQ(observations.size(), 1U);
  ASSERT_EQ(observations[0].blobs.size(), 1U);
  EXPECT_NEAR(observations[0].blobs[0].range, 2.0, 0.003);
  EXPECT_NEAR(observations[0].stamp, team.timeOf(1) - 0.25, 0.02);
  team[0].setConflicts({});
  team.run(0.5);
  EXPECT_TRUE(team[1].conflictsOf(team[0].id())->conflicts.empty());
  EXPECT_FALSE(team[1].conflictsOf(99));
  EXPECT_TRUE(team[0].observationsOf(team[1].id(), team.timeOf(0)).empty());
}

/// Of a hundred scans of ten seconds, how many another robot hears of; and what that costs. [-], [byte/s]
std::pair<double, double> shareOfScans(double loss, bool confirmed) {
  Team team = standingTeam(2, 6);
  team.connectAll();
  team.loss = loss;
  std::vector<ObservationMessage> scans;
  std::set<double> heard;
  std::size_t before = 0;
  team.run(30.0, [&](std::size_t i) {
    team[i].setOdometry(standing({}, team.timeOf(i)), DriveState::kStopped);
    PeerPose known;
    known.T_odom_peer.covariance.setIdentity();
    if (confirmed) known.state = EdgeState::kConfirmed;
    team[i].setPeerPose(team[1 - i].id(), known, team.timeOf(i));
    if (team.now < 110.0) before = team[0].counters().sections_sent.observation;
    if (i == 0 && std::fmod(team.now + 0.01, 0.1) < 0.05) {
      for (ObservationMessage& scan : scans) scan.age += 0.1;
      scans.insert(scans.begin(), {0.0, {}, {{team.now - 100.0, 0.0, 0.5}}});  // the range says which one it is
      if (scans.size() > 8) scans.pop_back();
      team[0].setObservations(scans, team.timeOf(0));
    }
    if (i == 0) return;
    for (const PeerObservations& scan : team[1].observationsOf(team[0].id(), team.timeOf(1))) {
      const double range = scan.blobs.at(0).range;
      if (range < 9.9 || range > 19.9) continue;  // by then clocks are known; more than 20 m does not fit
      EXPECT_NEAR(scan.stamp - team.members[1].clock_offset, 100.0 + range, 0.05);
      heard.insert(std::round(10.0 * range));
    }
  });
  return {static_cast<double>(heard.size()) / 100.0,
          static_cast<double>(team[0].counters().sections_sent.observation - before) / 20.0};
}

TEST(Exchange, scansAreToldAgainWhereMuchIsLost) {
  const auto [all, all_bytes] = shareOfScans(0.0, false);
  const auto [few, few_bytes] = shareOfScans(0.8, false);
  const auto [known, known_bytes] = shareOfScans(0.8, true);
  std::printf(
      "scans heard of: %.2f without loss (%.0f byte/s), %.2f at 80 %% loss (%.0f), %.2f to a robot that is known (%.0f)\n", all,
      all_bytes, few, few_bytes, known, known_bytes);
  EXPECT_GT(few, 2.0 * known);
  EXPECT_LT(few_bytes, 350.0);
  EXPECT_LT(all_bytes, 120.0);
  EXPECT_LT(known_bytes, 120.0);
}

TEST(Exchange, anIntentIsHeardAndGoesOutAgainWhenRightOfWayChanges) {
  Team team = standingTeam(2);
  team.connectAll();
  team.run(1.0);
  EXPECT_FALSE(team[1].intentOf(team[0].id())) << "nothing said";
  IntentMessage intent{1.0, team[0].id(), 0, {{0.0, 0.0}, {3.0, 0.02}, {3.0, -40.0}}};
  EXPECT_TRUE(team[0].setIntent(intent));
  team.run(1.0);
  EXPECT_FALSE(team[1].intentOf(team[0].id())) << "it goes with a trajectory, and there is none";
  const auto still = [&](std::size_t i) {
    team[i].setTrajectory(SampledTrajectory::standing({}, team.timeOf(i)), DriveState::kWaiting);
  };
  team.run(0.15, still);
  auto heard = team[1].intentOf(team[0].id());
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->intent.holder, team[0].id());
  EXPECT_EQ(heard->intent.depth, 0);
  ASSERT_EQ(heard->intent.way.size(), 3U);
  EXPECT_NEAR(heard->intent.way[2].y(), -40.0, 0.026);
  EXPECT_GT(heard->received, team.timeOf(1) - 0.16);
  // The same intent waits for the next trajectory, once a second; another's right of way does not.
  for (const int depth : {1, 2, 1}) {
    team.run(0.3, still);
    intent.depth = depth;
    intent.holder = team[1].id();
    team[0].setIntent(intent);
    team.run(0.1, still);
    heard = team[1].intentOf(team[0].id());
    EXPECT_EQ(heard->intent.depth, depth);
    EXPECT_EQ(heard->intent.holder, team[1].id());
  }
  EXPECT_FALSE(team[1].intentOf(99));
  EXPECT_FALSE(team[0].intentOf(team[1].id()));
}

TEST(Exchange, anIntentThatStaysIsToldTwiceASecondAndOneThatChangedThreeTimesAtOnce) {
  Team team = standingTeam(1);
  IntentMessage intent{1.0, team[0].id(), 0, {{0.0, 0.0}, {8.0, 0.0}}};
  double x = 0.0;
  const auto bytes = [&](double duration) {
    const std::size_t before = team[0].counters().sections_sent.conflict;
    team.run(duration, [&](std::size_t) {
      x += 0.1;
      team[0].setIntent(intent);
      team[0].setTrajectory(SampledTrajectory::standing({x, 0.0, 0.0}, team.timeOf(0)), DriveState::kDriving);
    });
    return static_cast<double>(team[0].counters().sections_sent.conflict - before);
  };
  bytes(2.0);
  PacketContent one;
  one.intent = intent;
  const auto size = static_cast<double>(encodePacket(one).size() - 4);
  EXPECT_NEAR(bytes(10.0) / size, 20.0, 4.0);
  intent.depth = 1;
  intent.holder = 5;
  EXPECT_NEAR(bytes(0.8) / size, 3.0, 0.1) << "with each trajectory";
}

TEST(Exchange, whatIsNotFiniteIsRefusedAndCounted) {
  Team team = standingTeam(1);
  const double nan = std::nan("");
  Exchange& exchange = team[0];
  EXPECT_FALSE(exchange.setOdometry(standing({nan, 0.0, 0.0}, 1.0), DriveState::kStopped));
  EXPECT_FALSE(exchange.setTrajectory(SampledTrajectory::standing({0.0, nan, 0.0}, 1.0), DriveState::kStopped));
  Conflict conflict;
  conflict.cost = nan;
  EXPECT_FALSE(exchange.setConflicts({conflict}));
  EXPECT_FALSE(exchange.setConflicts(std::vector<Conflict>(20)));
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Eigen::Vector2d> here = {{0.0, 0.0}};
  EXPECT_FALSE(exchange.setIntent({nan, 1, 0, here}));
  EXPECT_FALSE(exchange.setIntent({infinity, 1, 0, here}));
  EXPECT_FALSE(exchange.setIntent({-1.0, 1, 0, here}));
  EXPECT_FALSE(exchange.setIntent({1.0, 1, -1, here}));
  EXPECT_FALSE(exchange.setIntent({1.0, 1, 16, here}));
  EXPECT_FALSE(exchange.setIntent({1.0, 1, 0, {}}));
  EXPECT_FALSE(exchange.setIntent({1.0, 1, 0, {{0.0, 0.0}, {nan, 0.0}}}));
  EXPECT_FALSE(exchange.setIntent({1.0, 1, 0, {{0.0, 5000.0}}}));
  EXPECT_FALSE(exchange.setIntent({1.0, 1, 0, std::vector<Eigen::Vector2d>(16, here[0])}));
  EXPECT_TRUE(exchange.setIntent({1.0, 1, 15, std::vector<Eigen::Vector2d>(15, here[0])}));
  EXPECT_FALSE(exchange.setObservations({{0.0, {}, {{nan, 0.0, 0.0}}}}, 1.0));
  EXPECT_FALSE(exchange.publishKeyframe(Bytes(1000), {}, 1.0, 1.0));
  EXPECT_FALSE(exchange.setPeerPose(5, PeerPose(), 1.0)) << "no covariance";
  EXPECT_FALSE(exchange.setPeerPose(exchange.id(), confirmedAt(1.0), 1.0));
  EXPECT_FALSE(exchange.moveAnchor(77, {}, 1.0));
  EXPECT_FALSE(exchange.contest({5, 1, 1}, 1.0));
  EXPECT_EQ(exchange.counters().inputs_refused, 18);
  exchange.publishContours({{1, {{nan, 0.0}, {1.0, 1.0}}, false, false, 0.0}, {2, {{0.0, 0.0}}, false, false, 0.0}}, 1.0);
  EXPECT_EQ(exchange.counters().contours_refused, 2);
  EXPECT_TRUE(exchange.contoursOf(exchange.id()).empty());
}

TEST(Exchange, keyframesReachNeighboursWhosePoseIsUnknown) {
  Team team = standingTeam(3);
  team.connect(0, 1);
  team.connect(0, 2);
  for (int i = 0; i < 10; ++i) {
    const auto id =
        team[0].publishKeyframe(Bytes(150, static_cast<std::uint8_t>(i)), {1.0 * i, 0.0, 0.1}, team.timeOf(0), team.timeOf(0));
    EXPECT_EQ(id, static_cast<std::uint32_t>(i + 1));
    team.run(0.5);
  }
  team.run(4.0);
  const auto keyframes = team[1].keyframesOf(team[0].id(), team.timeOf(1));
  ASSERT_EQ(keyframes.size(), 8U);
  EXPECT_EQ(keyframes.back().id, 10U);
  EXPECT_EQ(keyframes.back().descriptor, Bytes(150, 9));
  EXPECT_NEAR(keyframes.back().pose.x, 9.0, 0.003);
  EXPECT_NEAR(keyframes.back().stamp, team.timeOf(1) - 4.5, 0.02);
  EXPECT_TRUE(team[1].keyframesOf(team[2].id(), team.timeOf(1)).empty());
}

TEST(Exchange, aRestartedPeerIsTakenAsNew) {
  Team team = standingTeam(2);
  team.connectAll();
  team[0].publishContours({wall(1, 0.0, 1.0, 2.0)}, team.timeOf(0));
  team.run(3.0);
  EXPECT_EQ(team[1].contoursOf(team[0].id()).size(), 1U);
  const std::size_t again = team.add(0.0, 2, "robot_0");
  team[again].setOdometry(standing({}, team.timeOf(again)), DriveState::kStopped);
  team.members[0].on = false;
  team.connect(1, again);
  team.run(2.0);
  EXPECT_EQ(team.eventCount(1, ExchangeEventKind::kPeerRestarted), 1);
  EXPECT_TRUE(team[1].contoursOf(team[0].id()).empty());
  team.members[0].on = true;
  team.run(2.0);
  EXPECT_GT(team[1].counters().dropped_boot, 0);
  EXPECT_EQ(team.eventCount(1, ExchangeEventKind::kDuplicateName), 1) << "both send";
  EXPECT_TRUE(team[1].peers(team.timeOf(1)).front().duplicate);
}

TEST(Exchange, aNamesakeIsNoticed) {
  Team team = standingTeam(1);
  const std::size_t twin = team.add(5.0, 1, "robot_0");
  team[twin].setOdometry(standing({}, team.timeOf(twin)), DriveState::kStopped);
  team.connect(0, twin);
  team.run(3.0);
  EXPECT_EQ(team.eventCount(0, ExchangeEventKind::kDuplicateName), 1);
  EXPECT_EQ(team.eventCount(twin, ExchangeEventKind::kDuplicateName), 1);
}

TEST(Exchange, whoIsSilentIsForgotten) {
  Team team = standingTeam(2);
  team.connectAll();
  team[0].publishContours({wall(1, 0.0, 1.0, 2.0)}, team.timeOf(0));
  team.run(3.0);
  team.cut(0, 1);
  team.run(5.0);
  EXPECT_FALSE(team[1].peers(team.timeOf(1)).front().neighbour);
  team.run(60.0);
  EXPECT_TRUE(team[1].peers(team.timeOf(1)).empty());
  EXPECT_EQ(team.eventCount(1, ExchangeEventKind::kPeerLost), 1);
  EXPECT_EQ(team[1].contoursOf(team[0].id()).size(), 1U) << "its map is still good";
  team.now += 1000.0;
  team.run(1.0);
  EXPECT_TRUE(team[1].contoursOf(team[0].id()).empty());
}

TEST(Exchange, theSameCallsGiveTheSameBytes) {
  const auto play = [] {
    Team team = standingTeam(3, 9);
    team.connectAll();
    team.loss = 0.5;
    team[0].publishContours({wall(1, 0.0, 1.0, 2.0), wall(2, 0.0, 2.0, 2.0)}, team.timeOf(0));
    team.run(5.0);
    return team.sent;
  };
  EXPECT_EQ(play(), play());
}

}  // namespace parley

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
