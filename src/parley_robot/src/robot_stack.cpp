// SPDX-License-Identifier: BSD-3-Clause
#include "parley_robot/robot_stack.h"

#include <stdexcept>

namespace parley {
namespace {

constexpr double kTimeReset = 1.0;               // [s] going back by more means that time started again
constexpr std::uint32_t kRestartsPerBoot = 256;  // [-] more, and it stays off the radio

RobotOptions usable(const RobotOptions& options) {
  std::string all;
  for (const std::string& problem : checkRobot(options)) all += problem + "\n";
  if (!all.empty()) throw std::invalid_argument(all);
  return options;
}

PlannerOptions plannerOf(const RobotOptions& options) {
  PlannerOptions planner = options.planner;
  if (options.variant == Variant::kNoConflictResolution || options.variant == Variant::kReactive) {
    planner.conflict_resolution = false;
  }
  return planner;
}

}  // namespace

RobotStack::RobotStack(const RobotOptions& options)
    : options_(usable(options)),
      smooth_({options.wiring.correction_distance, options.wiring.correction_angle, options.wiring.jump_distance,
               options.wiring.jump_angle},
              options.limits),
      odometry_(2.0, 2000, options.wiring.jump_distance, options.wiring.jump_angle),
      lidar_(options.lidar, options.footprint, options.mount),
      topology_(options.topology, options.footprint),
      planner_(plannerOf(options), options.footprint, options.limits),
      controller_(options.control, options.footprint, options.limits),
      goal_(options.goal_tolerance, options.wiring.arrival_hysteresis),
      topology_timer_(options.wiring.topology_rate),
      plan_trigger_(options.wiring.plan_rate) {
  joinTeam();
}

/// What is told is in this odom frame: when it is another one, so is the boot. With all boots used it is silent: packets of
/// a boot that was there before would be sealed alike.
void RobotStack::joinTeam() {
  team_.reset();
  if (options_.variant == Variant::kReactive || restarts_ == kRestartsPerBoot) return;
  const ExchangeIdentity identity{options_.name, options_.boot * kRestartsPerBoot + restarts_, options_.key, options_.footprint,
                                  options_.limits};
  ++restarts_;
  team_.emplace(options_.exchange, options_.relative_localization, identity, options_.variant != Variant::kNoSharing);
}

bool RobotStack::setGoal(const Eigen::Vector2d& goal_odom) {
  if (!goal_.set(smooth_.odomFromLocal().inverse() * goal_odom)) return false;
  route_ = {};
  planner_.reset();
  return true;
}

void RobotStack::cancelGoal() {
  goal_.cancel();
  route_ = {};
}

void RobotStack::addOdometry(const Odometry& odometry) {
  const Pose2 T_odom_before = smooth_.odomFromLocal();
  const Odometry local = smooth_.add(odometry);
  if (smooth_.corrections() > counters_.odometry_corrections) {
    counters_.odometry_corrections = smooth_.corrections();
    goal_.carry(smooth_.odomFromLocal().inverse() * T_odom_before);
  }
  switch (odometry_.add(local)) {
    case OdometryVerdict::kAccepted:
      break;
    case OdometryVerdict::kNotFinite:
    case OdometryVerdict::kOutOfOrder:
      ++counters_.odometry_rejected;
      break;
    case OdometryVerdict::kTimeWentBack:
      ++counters_.time_resets;
      last_step_ = odometry.stamp;  // this reset is counted once
      startAnew();
      break;
    case OdometryVerdict::kJumped:
      // What was mapped before the jump no longer lies where odometry says.
      ++counters_.odometry_jumps;
      forgetMap();
      break;
  }
}

void RobotStack::addScan(const RangeScan& scan) { pending_scan_ = scan; }

void RobotStack::addCloud(const LidarCloud& cloud) { pending_scan_ = cloud; }

RobotOutput RobotStack::step(double now) {
  if (now < last_step_ - kTimeReset) {
    ++counters_.time_resets;
    odometry_.clear();
    startAnew();
  }
  last_step_ = now;

  RobotOutput output;
  sense(output.times);
  meetTeam(now, output.times);
  updateTopology(now, output.times);
  planMotion(now, output.times);
  const ControlResult drive = driveWheels(now, output.times);

  output.twist = drive.twist;
  output.state = drive.state;
  output.reason = drive.reason;
  output.packets = talk(now, drive.state);
  output.replans = plan_.count();
  output.route_switches = route_.switches;
  output.escapes = last_plan_.escapes;
  return output;
}

void RobotStack::sense(StageTimes& times) {
  if (std::holds_alternative<std::monostate>(pending_scan_) || odometry_.empty()) return;
  const std::vector<KnownTeammate> bodies = team_ ? team_->bodies(odometry_.latest().stamp) : std::vector<KnownTeammate>{};
  LidarResult result;
  times.lidar = timed([&] {
    if (const auto* scan = std::get_if<RangeScan>(&pending_scan_)) {
      result = lidar_.process(*scan, odometry_, bodies);
    } else {
      result = lidar_.process(std::get<LidarCloud>(pending_scan_), odometry_, bodies);
    }
  });
  pending_scan_ = std::monostate{};
  const std::optional<Odometry> at_scan = odometry_.at(result.scan.stamp);
  if (!result.status.is(LidarCode::kOk) || !at_scan) {
    ++counters_.scans_rejected;
    return;
  }
  lidar_result_ = std::move(result);
  T_odom_scan_ = at_scan->pose;
  scan_is_new_ = true;
  times.map_fusion = timed([&] { topology_.integrate(lidar_result_.scan, *T_odom_scan_); });
}

void RobotStack::meetTeam(double now, StageTimes& times) {
  if (team_) {
    for (const Packet& packet : received_) team_->addPacket(packet, now);
  }
  received_.clear();
  if (!team_ || !scan_is_new_) return;
  times.relative_localization = timed([&] {
    team_->addScan(*T_odom_scan_, lidar_result_.scan, now);
    team_->locate(now);
  });
}

void RobotStack::updateTopology(double now, StageTimes& times) {
  if (odometry_.empty() || !T_odom_scan_ || !topology_timer_.due(now)) return;
  if (options_.variant == Variant::kReactive) {
    route_ = straightRoute();
    return;
  }
  const double drawing = timed([&] { drawMaps(now); });
  times.map_fusion = std::max(0.0, times.map_fusion) + drawing;
  times.topology = timed([&] { topology_.update(); });
  if (team_ && team_->mapIsDue(now)) team_->tellMap(topology_.contours(), topology_.seenThrough(), now);
  if (!goal_.goal()) return;
  times.route = timed([&] { route_ = topology_.route(odometry_.latest().pose, *goal_.goal()); });
}

void RobotStack::drawMaps(double now) {
  if (!team_) return;
  const MapChanges changes = team_->drawMaps(odometry_.latest().pose, now);
  for (const std::string& origin : changes.removed) topology_.removeLayer(origin);
  for (const LayerUpdate& layer : changes.drawn) topology_.setLayer(layer);
  for (const Refuted& outline : changes.refuted) topology_.forget(outline);
}

void RobotStack::planMotion(double now, StageTimes& times) {
  if (odometry_.empty() || !T_odom_scan_ || !goal_.goal() || !plan_trigger_.due(now, scan_is_new_)) return;
  scan_is_new_ = false;
  const double start_time = now + options_.wiring.plan_delay;
  const bool at_goal = goal_.update(odometry_.latest());
  times.local_plan = timed([&] {
    const LocalMap map =
        topology_.localMap(odometry_.latest().pose.position(), options_.wiring.local_map_size, lidar_result_.scan.stamp);
    const PlanRequest request{now,
                              start_time,
                              odometry_.latest(),
                              map,
                              lidar_result_.scan,
                              *T_odom_scan_,
                              lidar_result_.tracks,
                              route_,
                              *goal_.goal(),
                              goal_.tolerance(),
                              plan_.trajectory(),
                              team_ ? team_->id() : 0,
                              team_ ? team_->motions(now) : std::vector<PeerMotion>{},
                              team_ && team_->isTeamKnown(now),
                              at_goal};
    last_plan_ = planner_.plan(request);
  });
  times.trajectory = last_plan_.trajectory_time;
  if (last_plan_.impassable) topology_.shutPassage(*last_plan_.impassable);
  plan_.offer(last_plan_, now, start_time);
  if (team_ && !last_plan_.intent.way.empty()) team_->setIntent(last_plan_.intent);
}

ControlResult RobotStack::driveWheels(double now, StageTimes& times) {
  plan_.advance(now);
  ControlRequest request;
  request.now = now;
  request.odometry = odometry_.empty() ? nullptr : &odometry_.latest();
  request.trajectory = &plan_.trajectory();
  request.trajectory_stamp = plan_.stamp();
  request.scan = T_odom_scan_ ? &lidar_result_.scan : nullptr;
  request.T_odom_scan = T_odom_scan_.value_or(Pose2{});
  request.intent = goal_.goal() ? plan_.state() : DriveState::kStopped;
  request.intent_reason = goal_.goal() ? plan_.reason() : "no goal";
  ControlResult result;
  times.control = timed([&] { result = controller_.step(request); });
  return result;
}

std::vector<Packet> RobotStack::talk(double now, DriveState state) {
  if (!team_ || odometry_.empty()) return {};
  return team_->step(now, odometry_.latest(), plan_.trajectory(), state);
}

Route RobotStack::straightRoute() const {
  Route route;
  if (!goal_.goal()) return route;
  route.verdict = RouteVerdict::kThroughUnknown;
  route.points = {odometry_.latest().pose.position(), *goal_.goal()};
  route.length = route.cost = (route.points.back() - route.points.front()).norm();
  return route;
}

void RobotStack::forgetMap() {
  lidar_.reset();
  topology_.reset();
  planner_.reset();
  plan_.clear();
  controller_.reset();
  T_odom_scan_.reset();
  scan_is_new_ = false;
  received_.clear();
  route_ = {};
  joinTeam();
}

void RobotStack::startAnew() {
  forgetMap();
  pending_scan_ = std::monostate{};
  topology_timer_ = Periodic(options_.wiring.topology_rate);
  plan_trigger_ = PlanTrigger(options_.wiring.plan_rate);
}

}  // namespace parley
