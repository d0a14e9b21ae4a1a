// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "parley_geometry/odometry_buffer.h"
#include "parley_robot/committed_plan.h"
#include "parley_robot/goal_tracker.h"
#include "parley_robot/packet.h"
#include "parley_robot/periodic.h"
#include "parley_robot/robot_options.h"
#include "parley_robot/smooth_odometry.h"
#include "parley_robot/stage_times.h"
#include "parley_robot/team_link.h"

namespace parley {

/// What a robot does at one instant.
struct RobotOutput {
  Twist2 twist;  // command for the wheels
  DriveState state = DriveState::kStopped;
  std::string reason;           // why it stands, for people; empty while driving
  std::vector<Packet> packets;  // to broadcast
  StageTimes times;
  int replans = 0;         // [-] trajectories committed so far
  int route_switches = 0;  // [-] homotopy class changes so far
  int escapes = 0;         // [-] escape points taken so far
};

/// What was thrown away and why, since the start.
struct RobotCounters {
  int odometry_rejected = 0;     // [-] not finite or out of order
  int odometry_jumps = 0;        // [-] each drops the map
  int odometry_corrections = 0;  // [-] each moves the frame that all inside is in
  int time_resets = 0;           // [-] the clock went back; each starts the robot anew
  int scans_rejected = 0;        // [-] empty, malformed, without odometry
};

/// A whole robot: everything between its sensors and its wheels. It gets time, odometry with drift, lidar, packets and a
/// goal in its own odom frame, and nothing else; it does not know of any world frame. Same inputs, same outputs.
/// All inside, and all that it tells others, is in the local frame, which stays smooth when odometry is corrected.
class RobotStack {
 public:
  /// Throws std::invalid_argument with all problems if the options are not usable.
  explicit RobotStack(const RobotOptions& options);

  /// False if the goal is not finite.
  bool setGoal(const Eigen::Vector2d& goal_odom);
  void cancelGoal();

  void addOdometry(const Odometry& odometry);
  /// The newest reading replaces one that has not been used yet.
  void addScan(const RangeScan& scan);
  void addCloud(const LidarCloud& cloud);

  /// What the radio received; taken up in the next step.
  void addPacket(const Packet& packet) { received_.push_back(packet); }

  /// One turn of the loop at the robot's own time [s]; call it at the control rate, after the sensors.
  RobotOutput step(double now);

  const OdometryBuffer& odometry() const { return odometry_; }
  /// Where the frame of all that is asked for here lies in that of odometry and goal; identity until the first correction.
  const Pose2& odomFromLocal() const { return smooth_.odomFromLocal(); }
  const Topology& topology() const { return topology_; }
  const CommittedPlan& plan() const { return plan_; }
  const PlanResult& lastPlan() const { return last_plan_; }
  const Route& route() const { return route_; }
  const LidarResult& lidar() const { return lidar_result_; }
  /// Null in the variant that does not talk.
  const TeamLink* team() const { return team_ ? &*team_ : nullptr; }
  const RobotCounters& counters() const { return counters_; }

 private:
  void sense(StageTimes& times);
  void meetTeam(double now, StageTimes& times);
  void updateTopology(double now, StageTimes& times);
  void drawMaps(double now);
  void planMotion(double now, StageTimes& times);
  ControlResult driveWheels(double now, StageTimes& times);
  std::vector<Packet> talk(double now, DriveState state);
  void joinTeam();
  void forgetMap();
  void startAnew();
  Route straightRoute() const;

  RobotOptions options_;
  SmoothOdometry smooth_;
  OdometryBuffer odometry_;
  LidarStage lidar_;
  Topology topology_;
  Planner planner_;
  Controller controller_;
  std::optional<TeamLink> team_;
  GoalTracker goal_;
  CommittedPlan plan_;
  Periodic topology_timer_;
  PlanTrigger plan_trigger_;

  std::vector<Packet> received_;
  std::uint32_t restarts_ = 0;  // [-] each makes it another robot on the radio, with another odom frame
  std::variant<std::monostate, RangeScan, LidarCloud> pending_scan_;
  LidarResult lidar_result_;
  bool scan_is_new_ = false;  // nothing has been planned on it yet
  std::optional<Pose2> T_odom_scan_;
  Route route_;
  PlanResult last_plan_;
  RobotCounters counters_;
  double last_step_ = -1e9;  // [s]
};

}  // namespace parley
