// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/team_node.h"

#include <parley_msgs/PeerArray.h>
#include <parley_msgs/PeerMaps.h>
#include <parley_msgs/Teammates.h>
#include <visualization_msgs/MarkerArray.h>

#include "parley_exchange/boot_counter.h"
#include "parley_nodelets/motion_conversions.h"
#include "parley_nodelets/sensor_conversions.h"
#include "parley_nodelets/stage_conversions.h"
#include "parley_nodelets/team_conversions.h"
#include "parley_nodelets/team_markers.h"

namespace parley {
namespace {

constexpr double kPeriod = 0.02;                  // [s] at which the radio is served, the control period
constexpr double kMotionsPeriod = 0.1;            // [s] in which the planner is told of the team at least once
constexpr double kRefutedTold = 5.0;              // [s] for which a refuted outline is part of each message
constexpr std::size_t kMostMarkerPoints = 40000;  // per marker: what RViz draws without stutter

}  // namespace

TeamNode::TeamNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name)
    : config_(loadTeamConfig(pnh)),
      key_(loadTeamKey(config_.team.key_file)),
      worker_(name, [] {}),
      diagnostics_(nh, pnh, name),
      inputs_(nh, name),
      peers_(nh.advertise<parley_msgs::PeerArray>("peers", 1)),
      peer_maps_(nh.advertise<parley_msgs::PeerMaps>("peer_maps", 1, true)),
      teammates_(nh.advertise<parley_msgs::Teammates>("teammates", 1)),
      motions_(nh.advertise<parley_msgs::PeerMotions>("peer_motions", 1)),
      markers_(nh.advertise<visualization_msgs::MarkerArray>("team_markers", 1)),
      radio_(nh, config_.team.radio),
      odometry_(nh, config_.node) {
  join();
  subscribe(nh);
  diagnostics_.setHardwareID(config_.node.frames.base);
  diagnostics_.add("stage", [this](Report& status) { report(status); });
  diagnostics_.add("radio", [this](Report& status) { reportRadio(status); });
  worker_.every(nh, kPeriod, [this] { step(); });
  worker_.every(nh, 1.0 / config_.node.wiring.topology_rate, [this] { exchangeMaps(); });
  worker_.every(nh, 1.0, [this] { diagnostics_.update(); });
  worker_.start();
}

TeamNode::~TeamNode() { worker_.stop(); }

void TeamNode::subscribe(ros::NodeHandle& nh) {
  trajectory_subscriber_ = nh.subscribe<parley_msgs::Trajectory>(
      "trajectory", 1, [this](const parley_msgs::TrajectoryConstPtr& m) { new_trajectory_.put(m); });
  state_subscriber_ = nh.subscribe<parley_msgs::RobotState>(
      "robot_state", 1, [this](const parley_msgs::RobotStateConstPtr& m) { new_state_.put(m); });
  contours_subscriber_ = nh.subscribe<parley_msgs::Contours>(
      "contours", 1, [this](const parley_msgs::ContoursConstPtr& m) { new_contours_.put(m); });
  obstacles_subscriber_ =
      nh.subscribe<parley_msgs::ObstacleScan>("obstacles", 1, [this](const parley_msgs::ObstacleScanConstPtr& m) {
        new_scan_.put(m);
        worker_.post([this] { locate(); });
      });
  inputs_.expect<nav_msgs::Odometry>(odometry_.subscriber());
  inputs_.expect<parley_msgs::ObstacleScan>(obstacles_subscriber_);
}

/// What is told is in this odom frame: when it is another one, so is the boot.
void TeamNode::join() {
  ++joins_;
  const std::uint32_t boot = config_.team.boot_file.empty() ? joins_ : nextBoot(config_.team.boot_file);
  const ExchangeIdentity identity{config_.team.name, boot, key_, config_.node.footprint, config_.node.limits};
  team_.emplace(config_.exchange, config_.relative_localization, identity, config_.team.share_maps);
}

/// Joins anew where time or odometry went elsewhere.
OdometrySnapshot TeamNode::readOdometry(double now) {
  OdometrySnapshot odometry = odometry_.read();
  if (continuity_.broken(now, odometry.counters)) {
    team_.reset();
    plan_.clear();
    layers_.clear();
    refuted_.clear();
    reported_bytes_ = 0;
    publishMaps(now);
  }
  if (!team_) join();
  return odometry;
}

void TeamNode::step() {
  const double now = ros::Time::now().toSec();
  const OdometrySnapshot odometry = readOdometry(now);
  takeInputs();
  for (const Packet& packet : radio_.receive(now)) team_->addPacket(packet, now);
  plan_.advance(now);
  if (odometry.buffer.empty()) return;
  radio_.send(team_->step(now, odometry.buffer.latest(), plan_.trajectory(), state_), now);
  publishTeammates(now);
  const double since = now - motions_told_;
  if (since < 0.0 || since > kMotionsPeriod - 0.5 * kPeriod) publishMotions(now);
}

void TeamNode::takeInputs() {
  if (const auto message = new_state_.take()) {
    const bool known = message->state <= parley_msgs::RobotState::DEAD;
    state_ = known ? static_cast<DriveState>(message->state) : DriveState::kStopped;
  }
  if (const auto message = new_trajectory_.take()) {
    const std::optional<TimedPlan> plan = fromMessage(*message);
    if (plan && message->header.frame_id == config_.node.frames.local && continuity_.isCurrent(plan->made_at)) {
      plan_.offer(plan->result, plan->made_at, plan->start_time);
      const Intent& intent = plan->result.intent;
      // The planner takes this robot's number from here: until it has, it speaks in nobody's name.
      const bool has_number = intent.right.depth > 0 || intent.right.holder == team_->id();
      if (!intent.way.empty() && has_number) team_->setIntent(intent);
    } else {
      ++rejected_;
    }
  }
}

void TeamNode::locate() {
  const auto message = new_scan_.take();
  if (!message) return;
  const double now = ros::Time::now().toSec();
  const OdometrySnapshot odometry = readOdometry(now);
  const std::optional<ObstacleScan> scan = fromMessage(*message);
  const std::optional<Odometry> at_scan = scan ? odometry.buffer.at(scan->stamp) : std::nullopt;
  if (!at_scan || message->header.frame_id != config_.node.frames.base || !continuity_.isCurrent(scan->stamp)) {
    ++rejected_;
    return;
  }
  team_->addScan(at_scan->pose, *scan, now);
  team_->locate(now);
  publishPeers(now);
  publishMotions(now);
}

void TeamNode::exchangeMaps() {
  const double now = ros::Time::now().toSec();
  const OdometrySnapshot odometry = readOdometry(now);
  if (const auto message = new_contours_.take(); message && team_->mapIsDue(now)) {
    const std::optional<std::vector<Contour>> contours = fromMessage(*message);
    const bool current = continuity_.isCurrent(message->header.stamp.toSec());
    if (contours && message->header.frame_id == config_.node.frames.local && current) {
      team_->tellMap(*contours, seenThroughOf(*message), now);
    } else {
      ++rejected_;
    }
  }
  if (odometry.buffer.empty()) return;
  const MapChanges changes = team_->drawMaps(odometry.buffer.latest().pose, now);
  for (const std::string& origin : changes.removed) layers_.erase(origin);
  for (const LayerUpdate& layer : changes.drawn) layers_[layer.origin] = toMessage(layer);
  for (const Refuted& outline : changes.refuted) refuted_.push_back({now, toMessage(outline)});
  while (!refuted_.empty() && refuted_.front().first < now - kRefutedTold) refuted_.pop_front();
  if (!changes.removed.empty() || !changes.drawn.empty() || !changes.refuted.empty()) publishMaps(now);
  if (markers_.getNumSubscribers() == 0) return;
  markers_.publish(boost::make_shared<visualization_msgs::MarkerArray>(
      teamMarkers(drawnPeers(*team_, now), layers_, now, config_.node.frames.local, kMostMarkerPoints)));
}

void TeamNode::publishMaps(double now) {
  auto message = boost::make_shared<parley_msgs::PeerMaps>();
  message->header.stamp = toRosTime(now);
  message->header.frame_id = config_.node.frames.local;
  for (const auto& [origin, layer] : layers_) message->layers.push_back(layer);
  for (const auto& [noticed, outline] : refuted_) message->refuted.push_back(outline);
  peer_maps_.publish(message);
}

void TeamNode::publishTeammates(double now) {
  const std::vector<KnownTeammate> bodies = team_->bodies(now);
  if (bodies.empty() && !teammates_told_) return;
  teammates_told_ = !bodies.empty();
  teammates_.publish(boost::make_shared<parley_msgs::Teammates>(toMessage(bodies, now, config_.node.frames.local)));
}

void TeamNode::publishMotions(double now) {
  motions_told_ = now;
  motions_.publish(boost::make_shared<parley_msgs::PeerMotions>(
      toMessage(motionsOf(*team_, now), team_->teammates(), config_.node.frames.local)));
}

void TeamNode::publishPeers(double now) {
  const auto message = boost::make_shared<parley_msgs::PeerArray>(peersOf(*team_, now, config_.node.frames.local));
  peers_.publish(message);
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (const parley_msgs::Peer& peer : message->peers) {
    if (peer.state != parley_msgs::Peer::CONFIRMED) continue;
    geometry_msgs::TransformStamped& t = transforms.emplace_back();
    t.header = message->header;
    t.child_frame_id = peer.frame;
    t.transform.translation.x = peer.pose.pose.position.x;
    t.transform.translation.y = peer.pose.pose.position.y;
    t.transform.rotation = peer.pose.pose.orientation;
  }
  if (!transforms.empty()) transforms_.sendTransform(transforms);
}

}  // namespace parley
