// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/topology_node.h"

#include <parley_msgs/Contours.h>
#include <parley_msgs/Graph.h>
#include <parley_msgs/Route.h>

#include "parley_nodelets/map_conversions.h"
#include "parley_nodelets/report.h"
#include "parley_nodelets/stage_conversions.h"
#include "parley_nodelets/team_conversions.h"
#include "parley_nodelets/topology_markers.h"

namespace parley {
namespace {

constexpr std::size_t kMostMarkerPoints = 40000;  // per marker: what RViz draws without stutter

}  // namespace

TopologyNode::TopologyNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name)
    : config_(loadStageConfig<TopologyOptions>(pnh)),
      worker_(name, [] {}),
      diagnostics_(nh, pnh, name),
      inputs_(nh, name),
      topology_(std::make_unique<Topology>(config_.stage, config_.node.footprint)),
      local_map_(nh.advertise<nav_msgs::OccupancyGrid>("local_map", 1, true)),
      route_publisher_(nh.advertise<parley_msgs::Route>("route", 1, true)),
      contours_(nh.advertise<parley_msgs::Contours>("contours", 1, true)),
      graph_(nh.advertise<parley_msgs::Graph>("graph", 1, true)),
      markers_(nh.advertise<visualization_msgs::MarkerArray>("topology_markers", 1, true)),
      odometry_(nh, config_.node) {
  obstacles_subscriber_ =
      nh.subscribe<parley_msgs::ObstacleScan>("obstacles", 1, [this](const parley_msgs::ObstacleScanConstPtr& m) {
        obstacles_.put(m);
        worker_.post([this] { integrate(); });
      });
  goal_subscriber_ = nh.subscribe<parley_msgs::Goal>("goal", 1, [this](const parley_msgs::GoalConstPtr& m) { new_goal_.put(m); });
  peer_maps_subscriber_ = nh.subscribe<parley_msgs::PeerMaps>(
      "peer_maps", 1, [this](const parley_msgs::PeerMapsConstPtr& m) { new_peer_maps_.put(m); });
  shut_passage_subscriber_ = nh.subscribe<geometry_msgs::PointStamped>(
      "shut_passage", 1, [this](const geometry_msgs::PointStampedConstPtr& m) { new_shut_passage_.put(m); });
  inputs_.expect<nav_msgs::Odometry>(odometry_.subscriber());
  inputs_.expect<parley_msgs::ObstacleScan>(obstacles_subscriber_);
  diagnostics_.setHardwareID(config_.node.frames.base);
  diagnostics_.add("stage", [this](Report& status) { report(status); });
  worker_.every(nh, 1.0 / config_.node.wiring.topology_rate, [this] { update(); });
  worker_.every(nh, 1.0, [this] { diagnostics_.update(); });
  worker_.start();
}

TopologyNode::~TopologyNode() { worker_.stop(); }

void TopologyNode::forgetIfBroken(double now, const OdometrySnapshot& odometry) {
  if (!continuity_.broken(now, odometry.counters)) return;
  topology_->reset();
  layers_.clear();
  newest_scan_.reset();
  route_ = {};
}

void TopologyNode::integrate() {
  const auto message = obstacles_.take();
  if (!message) return;
  const OdometrySnapshot odometry = odometry_.read();
  forgetIfBroken(ros::Time::now().toSec(), odometry);
  const std::optional<ObstacleScan> scan = fromMessage(*message);
  const std::optional<Odometry> at_scan = scan ? odometry.buffer.at(scan->stamp) : std::nullopt;
  if (!at_scan || message->header.frame_id != config_.node.frames.base || !continuity_.isCurrent(scan->stamp)) {
    ++rejected_;
    return;
  }
  topology_->integrate(*scan, at_scan->pose);
  newest_scan_ = scan->stamp;
  publishLocalMap(odometry.buffer.latest().pose);
}

void TopologyNode::update() {
  const double now = ros::Time::now().toSec();
  const OdometrySnapshot odometry = odometry_.read();
  forgetIfBroken(now, odometry);
  takeGoal();
  takePeerMaps();
  takeShutPassage();
  if (odometry.buffer.empty() || !newest_scan_) return;
  last_result_ = topology_->update();
  publishRoute(odometry.buffer.latest().pose);
  publishPictures();
}

void TopologyNode::takeGoal() {
  const auto message = new_goal_.take();
  if (!message) return;
  const Eigen::Vector2d position(message->position.x, message->position.y);
  const bool usable = message->active && position.allFinite() && message->header.frame_id == config_.node.frames.local;
  goal_ = usable ? std::optional<Eigen::Vector2d>(position) : std::nullopt;
  route_ = {};
}

void TopologyNode::takeShutPassage() {
  const auto message = new_shut_passage_.take();
  if (!message) return;
  const Eigen::Vector2d place(message->point.x, message->point.y);
  if (!place.allFinite() || message->header.frame_id != config_.node.frames.local ||
      !continuity_.isCurrent(message->header.stamp.toSec())) {
    ++rejected_;
    return;
  }
  topology_->shutPassage(place);
}

/// Draws what is new and takes away what is no longer told.
void TopologyNode::takePeerMaps() {
  const auto message = new_peer_maps_.take();
  if (!message) return;
  if (message->header.frame_id != config_.node.frames.local || !continuity_.isCurrent(message->header.stamp.toSec())) {
    ++rejected_;
    return;
  }
  std::map<std::string, ros::Time> told;
  for (const parley_msgs::MapLayer& layer : message->layers) {
    const auto drawn = layers_.find(layer.origin);
    if (drawn == layers_.end() || drawn->second != layer.stamp) {
      const std::optional<LayerUpdate> update = fromMessage(layer);
      if (!update) {
        ++rejected_;
        continue;
      }
      topology_->setLayer(*update);
    }
    told[layer.origin] = layer.stamp;
  }
  for (const auto& [origin, version] : layers_) {
    if (told.count(origin) == 0) topology_->removeLayer(origin);
  }
  layers_ = std::move(told);
  for (const parley_msgs::Contour& part : message->refuted) {
    const std::optional<Refuted> outline = refutedOf(part);
    if (outline) topology_->forget(*outline);
    rejected_ += outline ? 0 : 1;
  }
}

void TopologyNode::publishLocalMap(const Pose2& T_odom_base) {
  const LocalMap map = topology_->localMap(T_odom_base.position(), config_.node.wiring.local_map_size, *newest_scan_);
  local_map_.publish(boost::make_shared<nav_msgs::OccupancyGrid>(toMessage(map, config_.node.frames.local)));
}

void TopologyNode::publishRoute(const Pose2& T_odom_base) {
  if (!goal_) return;
  route_ = topology_->route(T_odom_base, *goal_);
  const RouteToGoal route{route_, *goal_};
  route_publisher_.publish(boost::make_shared<parley_msgs::Route>(toMessage(route, *newest_scan_, config_.node.frames.local)));
}

void TopologyNode::publishPictures() {
  const std::string& local = config_.node.frames.local;
  if (contours_.getNumSubscribers() > 0) {
    contours_.publish(boost::make_shared<parley_msgs::Contours>(
        toMessage(topology_->contours(), topology_->seenThrough(), *newest_scan_, local)));
  }
  if (graph_.getNumSubscribers() > 0) {
    graph_.publish(boost::make_shared<parley_msgs::Graph>(toMessage(topology_->graph(), *newest_scan_, local)));
  }
  if (markers_.getNumSubscribers() > 0) {
    markers_.publish(boost::make_shared<visualization_msgs::MarkerArray>(
        topologyMarkers(topology_->fusedContours(), topology_->graph(), route_, *newest_scan_, local, kMostMarkerPoints)));
  }
}

void TopologyNode::report(Report& report) const {
  report.summary(Report::OK, "");
  if (last_result_.saturated) report.mergeSummary(Report::WARN, "a bound of the map or graph is met");
  if (!newest_scan_) report.mergeSummary(Report::WARN, "no obstacle scan");
  report.add("vertices", last_result_.vertices);
  report.add("edges", last_result_.edges);
  report.add("tiles", last_result_.tiles);
  report.add("layers", last_result_.layers);
  report.add("messages without pose or malformed", rejected_);
  report.add("refused by the stage", last_result_.refused);
  report.add("route length", route_.length);
  report.add("route switches", route_.switches);
  report.add("exceptions", worker_.errors());
  reportOdometry(report, odometry_.read(), config_.node.frames, ros::Time::now().toSec());
}

}  // namespace parley
