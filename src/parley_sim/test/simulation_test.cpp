// SPDX-License-Identifier: BSD-3-Clause
#include "parley_sim/simulation.h"

#include <gtest/gtest.h>

#include "worlds.h"

namespace parley::sim {
namespace {

Scenario withRobots(const std::vector<Pose2>& starts) {
  Scenario scenario;
  scenario.duration = 1000.0;
  for (const Pose2& start : starts) {
    scenario.robots.push_back(robotAt("robot_" + std::to_string(scenario.robots.size()), start, {18, 18}));
  }
  return scenario;
}

Event event(EventKind kind, double time, std::size_t robot, double duration = 0.0) {
  Event result;
  result.kind = kind;
  result.time = time;
  result.robot = robot;
  result.duration = duration;
  return result;
}

Event door(double time, bool closed, double x) {
  Event result = event(EventKind::kDoor, time, 0);
  result.from = {x, 0};
  result.to = {x, 20};
  result.closed = closed;
  return result;
}

std::vector<SensorReadings> run(Simulation& simulation, double seconds) {
  std::vector<SensorReadings> last;
  const double end = simulation.time() + seconds;
  while (simulation.time() < end - 1e-6) last = simulation.step();
  return last;
}

TEST(SimulationTest, sensorsComeAtTheirRates) {
  const World world = emptyWorld();
  Simulation simulation(withRobots({{5, 5, 0}, {5, 10, 0}}), world);
  int odometry = 0, scans = 0;
  std::vector<double> first_scans(2, -1.0);
  for (int i = 0; i < 500; ++i) {
    const auto readings = simulation.step();
    for (std::size_t r = 0; r < 2; ++r) {
      odometry += readings[r].odometry.has_value() ? 1 : 0;
      scans += readings[r].scan.has_value() ? 1 : 0;
      if (readings[r].scan && first_scans[r] < 0) first_scans[r] = simulation.time();
      EXPECT_NEAR(readings[r].clock, simulation.time(), 1e-12);
    }
  }
  EXPECT_NEAR(odometry, 1000, 2);
  EXPECT_NEAR(scans, 200, 2);
  EXPECT_NE(first_scans[0], first_scans[1]);  // each sensor has its own phase
  EXPECT_NEAR(simulation.time(), 10.0, 1e-9);
}

TEST(SimulationTest, clocksAndOdometryAreEachRobotsOwn) {
  const World world = emptyWorld();
  Scenario scenario = withRobots({{5, 5, 1.0}});
  scenario.robots[0].clock = {100.0, 0.001};
  scenario.robots[0].odometry = {50.0, 0.0, 0.0};
  Simulation simulation(scenario, world);
  simulation.command(0, {1.0, 0.0});
  const auto readings = run(simulation, 5.0);
  EXPECT_NEAR(readings[0].clock, 100.0 + 1.001 * 5.0, 1e-9);
  ASSERT_TRUE(readings[0].odometry.has_value());
  EXPECT_NEAR(readings[0].odometry->stamp, readings[0].clock, 1e-12);
  EXPECT_NEAR(readings[0].odometry->pose.x, 4.75, 1e-6);
  EXPECT_NEAR(readings[0].odometry->pose.y, 0.0, 1e-9);
  EXPECT_NEAR(simulation.truth().bodies[0].state.pose.x, 5.0 + 4.75 * std::cos(1.0), 1e-6);
}

TEST(SimulationTest, aBodyStopsAtAWallAndCanLeaveIt) {
  const World world = emptyWorld(20, 20);
  Simulation simulation(withRobots({{18, 10, 0}}), world);
  simulation.command(0, {2.0, 0.0});
  run(simulation, 5.0);
  const BodyState& state = simulation.truth().bodies[0].state;
  EXPECT_NEAR(state.pose.x, 19.6, 1e-4);
  EXPECT_EQ(state.twist.speed, 0.0);
  EXPECT_EQ(simulation.referee().collisions(ContactKind::kStatic), 1);
  simulation.command(0, {-1.0, 0.0});
  run(simulation, 2.0);
  EXPECT_LT(simulation.truth().bodies[0].state.pose.x, 18.5);
  EXPECT_EQ(simulation.referee().collisions(ContactKind::kStatic), 1);
}

TEST(SimulationTest, bodiesStopAtEachOther) {
  const World world = emptyWorld(20, 20);
  Simulation simulation(withRobots({{8, 10, 0}, {12, 10, kPi}}), world);
  simulation.command(0, {2.0, 0.0});
  simulation.command(1, {2.0, 0.0});
  run(simulation, 4.0);
  EXPECT_NEAR(simulation.truth().bodies[1].state.pose.x - simulation.truth().bodies[0].state.pose.x, 0.8, 1e-4);
  EXPECT_EQ(simulation.referee().collisions(ContactKind::kRobot), 1);
}

TEST(SimulationTest, theKilledBrakeAndSayNothingMore) {
  const World world = emptyWorld(20, 20);
  Scenario scenario = withRobots({{3, 10, 0}, {3, 5, 0}});
  scenario.events = {event(EventKind::kKill, 2.0, 0)};
  Simulation simulation(scenario, world);
  simulation.command(0, {2.0, 0.0});
  run(simulation, 2.0);
  const double x = simulation.truth().bodies[0].state.pose.x;
  EXPECT_NEAR(simulation.truth().bodies[0].state.twist.speed, 2.0, 1e-9);
  const auto readings = run(simulation, 3.0);
  EXPECT_NEAR(simulation.truth().bodies[0].state.pose.x, x + 1.0, 1e-6);
  EXPECT_FALSE(readings[0].present);
  EXPECT_FALSE(readings[0].odometry.has_value());
  simulation.send(0, Payload(10));
  EXPECT_EQ(simulation.radio().packets_sent, 0);
  EXPECT_TRUE(simulation.robot(0).dead());
}

TEST(SimulationTest, stallMuteAndBlindPass) {
  const World world = emptyWorld(20, 20);
  Scenario scenario = withRobots({{3, 10, 0}, {5, 5, 0}});
  scenario.events = {event(EventKind::kStall, 1.0, 0, 2.0), event(EventKind::kMute, 1.0, 0, 2.0),
                     event(EventKind::kBlind, 1.0, 0, 2.0)};
  Simulation simulation(scenario, world);
  simulation.command(0, {0.5, 0.0});
  int scans = 0;
  for (int i = 0; i < 250; ++i) {
    const auto readings = simulation.step();
    const double now = simulation.time();
    scans += readings[0].scan && now > 1.0 + 1e-6 && now < 3.0 - 1e-6 ? 1 : 0;
    if (i == 100) {
      simulation.send(0, Payload(1));
      EXPECT_EQ(simulation.truth().bodies[0].state.twist.speed, 0.0);
      EXPECT_TRUE(readings[0].odometry.has_value());
    }
  }
  EXPECT_EQ(scans, 0);
  EXPECT_EQ(simulation.radio().packets_sent, 0);
  EXPECT_NEAR(simulation.truth().bodies[0].state.twist.speed, 0.5, 1e-9);
  simulation.send(0, Payload(1));
  EXPECT_EQ(simulation.radio().packets_sent, 1);
  run(simulation, 0.06);
  EXPECT_EQ(simulation.radio().received, 1);
}

TEST(SimulationTest, packetsArriveInLaterSteps) {
  const World world = emptyWorld(20, 20);
  Simulation simulation(withRobots({{3, 10, 0}, {5, 10, 0}}), world);
  simulation.step();
  simulation.send(0, {1, 2, 3});
  int steps = 0;
  std::vector<Payload> heard;
  while (heard.empty() && steps < 10) {
    heard = simulation.step()[1].packets;
    ++steps;
  }
  EXPECT_LE(steps, 2);
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(heard[0], Payload({1, 2, 3}));
}

TEST(SimulationTest, aDoorClosesWhenNobodyIsInItsWayAndOpensAgain) {
  const World world = emptyWorld(20, 20);
  Scenario scenario = withRobots({{4, 10, 0}});
  scenario.events = {door(2.0, true, 8.0), door(12.0, false, 8.0)};
  Simulation simulation(scenario, world);
  simulation.command(0, {2.0, 0.0});
  run(simulation, 2.4);  // it is just in front of the door, or in it
  EXPECT_TRUE(simulation.truth().doors.empty());
  run(simulation, 2.0);
  EXPECT_EQ(simulation.truth().doors.size(), 1u);
  EXPECT_TRUE(simulation.referee().incidents().empty());
  simulation.command(0, {-2.0, 0.0});
  run(simulation, 5.0);
  EXPECT_NEAR(simulation.truth().bodies[0].state.pose.x, 8.05 + 0.4, 1e-4);
  EXPECT_EQ(simulation.referee().collisions(ContactKind::kStatic), 1);
  run(simulation, 6.0);
  EXPECT_TRUE(simulation.truth().doors.empty());
  EXPECT_LT(simulation.truth().bodies[0].state.pose.x, 8.0);
}

TEST(SimulationTest, aNewcomerWaitsForItsPlace) {
  const World world = emptyWorld(20, 20);
  Scenario scenario = withRobots({{5, 10, 0}, {5.5, 10, 0}});
  scenario.robots[1].joins_later = true;
  scenario.events = {event(EventKind::kJoin, 1.0, 1)};
  Simulation simulation(scenario, world);
  EXPECT_FALSE(run(simulation, 2.0)[1].present);
  simulation.command(0, {-1.0, 0.0});
  const auto readings = run(simulation, 3.0);
  EXPECT_TRUE(readings[1].present);
  EXPECT_TRUE(simulation.referee().incidents().empty());
  EXPECT_GT(simulation.referee().records()[1].joined_at, 2.0);
  EXPECT_LT(simulation.referee().records()[1].time, 3.0);
}

TEST(SimulationTest, movingObstaclesHitWithoutStoppingAnybody) {
  const World world = emptyWorld(20, 20);
  Scenario scenario = withRobots({{10, 10, 0}});
  scenario.obstacles = {{0.3, 1.0, {{10, 7}, {10, 13}}}};
  Simulation simulation(scenario, world);
  run(simulation, 12.5);  // there and back
  EXPECT_EQ(simulation.referee().touched(), 2);
  EXPECT_EQ(simulation.referee().collisions(ContactKind::kMoving), 0);
  simulation.command(0, {0.1, 0.0});
  run(simulation, 5.0);
  EXPECT_EQ(simulation.referee().collisions(ContactKind::kMoving), 1);
  EXPECT_NEAR(simulation.truth().bodies[0].state.twist.speed, 0.1, 1e-9);
}

/// Everything that a robot senses in five seconds of driving round in circles, as numbers in a row.
std::vector<double> sensedBy(const std::string& name, const Scenario& scenario, const World& world) {
  Simulation simulation(scenario, world);
  std::size_t index = 0;
  while (scenario.robots[index].name != name) ++index;
  std::vector<double> sensed;
  for (int i = 0; i < 250; ++i) {
    const SensorReadings readings = simulation.step()[index];
    if (readings.odometry) {
      const Odometry& o = *readings.odometry;
      sensed.insert(sensed.end(), {o.stamp, o.pose.x, o.pose.y, o.pose.yaw, o.twist.speed, o.twist.turn_rate, o.roll, o.pitch});
    }
    if (readings.scan) sensed.insert(sensed.end(), readings.scan->ranges.begin(), readings.scan->ranges.end());
    if (readings.cloud) {
      for (const LidarPoint& p : readings.cloud->points) sensed.insert(sensed.end(), {p.x, p.y, p.z, p.time});
    }
    simulation.command(index, {1.0, 0.5});
  }
  return sensed;
}

TEST(SimulationTest, sameSeedSameBitsAndAnotherRobotChangesNobodysNoise) {
  const World world = emptyWorld(20, 20);
  for (const LidarMode mode : {LidarMode::kPlanar, LidarMode::kSpatial}) {
    Scenario alone = withRobots({{5, 5, 0}});
    alone.robots[0].lidar.mode = mode;
    Scenario crowd = withRobots({{5, 5, 0}, {17, 17, 0}, {17, 15, 0}});
    crowd.robots[0].lidar.mode = mode;
    std::swap(crowd.robots[0], crowd.robots[2]);  // nor does its place in the file
    const std::vector<double> first = sensedBy("robot_0", alone, world);
    EXPECT_GT(first.size(), 5000u);
    EXPECT_EQ(first, sensedBy("robot_0", alone, world));
    EXPECT_EQ(first, sensedBy("robot_0", crowd, world));
    alone.seed = 2;
    EXPECT_NE(first, sensedBy("robot_0", alone, world));
  }
}

TEST(SimulationTest, endsWhenAllHaveArrivedOrTimeIsUp) {
  const World world = emptyWorld(20, 20);
  Scenario scenario = withRobots({{17.9, 18, 0}});
  Simulation arriving(scenario, world);
  while (!arriving.finished()) arriving.step();
  EXPECT_NEAR(arriving.time(), 0.5, 0.021);
  EXPECT_TRUE(arriving.referee().success());
  scenario.robots[0].goal = {1, 1};
  scenario.duration = 3.0;
  Simulation late(scenario, world);
  while (!late.finished()) late.step();
  EXPECT_NEAR(late.time(), 3.0, 1e-9);
  EXPECT_FALSE(late.referee().success());
}

TEST(SimulationTest, blindSpatialLidarsReportNothingAndComeBack) {
  const World world = emptyWorld(20, 20);
  Scenario scenario = withRobots({{3, 10, 0}});
  scenario.robots[0].lidar.mode = LidarMode::kSpatial;
  scenario.events = {event(EventKind::kBlind, 1.0, 0, 1.0)};
  Simulation simulation(scenario, world);
  int before = 0, during = 0, after = 0;
  for (int i = 0; i < 150; ++i) {
    if (!simulation.step()[0].cloud) continue;
    const double now = simulation.time();
    ++(now <= 1.0 + 1e-6 ? before : now < 2.0 - 1e-6 ? during : after);
  }
  EXPECT_NEAR(before, 10, 1);
  EXPECT_EQ(during, 0);
  EXPECT_NEAR(after, 10, 1);
}

TEST(EncounterCounterTest, countsPairsThatSawEachOtherForASecond) {
  const World world = drawnWorld(20, 20, 0.1, [](double x, double y) { return std::abs(y - 10.0) < 0.1 && x > 5.0; });
  Scenario scenario = withRobots({{3, 12, 0}, {3, 8, 0}, {18, 18, 0}});
  EncounterCounter counter(scenario, world);
  Snapshot snapshot;
  for (const RobotSpec& robot : scenario.robots) snapshot.bodies.push_back({true, {robot.start, {}}, 0.8, 0.4});
  const auto pass = [&](double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / 0.1 + 0.5); ++i) {
      counter.observe(snapshot);
      snapshot.time += 0.1;
    }
  };
  const auto hide = [&]() { snapshot.bodies[0].state.pose.x = snapshot.bodies[1].state.pose.x = 10.0; };
  const auto show = [&]() { snapshot.bodies[0].state.pose.x = snapshot.bodies[1].state.pose.x = 3.0; };
  pass(0.8);
  hide();
  pass(1.0);
  EXPECT_EQ(counter.encounters().size(), 0u);  // too short
  show();
  pass(1.2);
  ASSERT_EQ(counter.encounters().size(), 1u);
  EXPECT_NEAR(counter.encounters()[0].start, 1.8, 1e-9);
  hide();
  pass(4.5);
  show();
  pass(2.0);
  EXPECT_EQ(counter.encounters().size(), 1u);  // the same one
  hide();
  pass(5.5);
  show();
  pass(2.0);
  EXPECT_EQ(counter.encounters().size(), 2u);
  snapshot.doors.push_back(boxOfSegment({0, 10}, {5, 10}, 0.1));
  pass(6.0);
  snapshot.doors.clear();
  pass(0.5);
  EXPECT_EQ(counter.encounters().size(), 2u);
}

}  // namespace
}  // namespace parley::sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
