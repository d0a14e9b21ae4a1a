// SPDX-License-Identifier: BSD-3-Clause
#include "parley_nodelets/planner_node.h"

#include <geometry_msgs/PointStamped.h>
#include <parley_msgs/Goal.h>
#include <parley_msgs/Trajectory.h>

#include "parley_nodelets/map_conversions.h"
#include "parley_nodelets/report.h"

namespace parley {
namespace {

PlannerConfig loadPlannerConfig(const ros::NodeHandle& pnh) {
  ParameterLoader loader(pnh);
  PlannerConfig config;
  config.node = loadNodeConfig(loader);
  loader.load("", config.stage);
  loader.load("goal", config.goal);
  loader.finish();
  return config;
}

constexpr double kOldTeam = 1.0;     // [s] teammates of a message older than this are not counted on
constexpr double kLookAround = 0.2;  // [-] of the planning period: where no scan comes, the trigger is asked so often

bool isStuck(PlanCode code) { return code == PlanCode::kNoRoute || code == PlanCode::kNoPath || code == PlanCode::kBlocked; }

}  // namespace

PlannerNode::PlannerNode(ros::NodeHandle nh, const ros::NodeHandle& pnh, const std::string& name)
    : config_(loadPlannerConfig(pnh)),
      worker_(name, [] {}),
      diagnostics_(nh, pnh, name),
      inputs_(nh, name),
      planner_(std::make_unique<Planner>(config_.stage, config_.node.footprint, config_.node.limits)),
      goal_(std::make_unique<GoalTracker>(config_.goal.tolerance, config_.node.wiring.arrival_hysteresis)),
      trigger_(config_.node.wiring.plan_rate),
      trajectory_(nh.advertise<parley_msgs::Trajectory>("trajectory", 1)),
      path_(nh.advertise<nav_msgs::Path>("trajectory_path", 1, true)),
      goal_publisher_(nh.advertise<parley_msgs::Goal>("goal", 1, true)),
      shut_passage_(nh.advertise<geometry_msgs::PointStamped>("shut_passage", 1)),
      odometry_(nh, config_.node) {
  const auto feed = [this, &nh](const std::string& topic, auto& latest, const Worker::Work& then) {
    using Pointer = decltype(latest.take());
    using Message = std::remove_const_t<typename Pointer::element_type>;
    subscribers_.push_back(nh.subscribe<Message>(topic, 1, [&latest, then](const Pointer& m) {
      latest.put(m);
      then();
    }));
    inputs_.expect<Message>(subscribers_.back());
  };
  feed("obstacles", new_scan_, [] {});
  feed("tracks", new_tracks_, [] {});
  feed("route", new_route_, [] {});
  // The map comes last of what a scan brings about: with it, all is there to plan on.
  feed("local_map", new_map_, [this] { worker_.post([this] { step(); }); });
  // A robot alone has no team stage: nothing is amiss where nobody publishes it.
  subscribers_.push_back(nh.subscribe<parley_msgs::PeerMotions>(
      "peer_motions", 1, [this](const parley_msgs::PeerMotionsConstPtr& m) { new_team_.put(m); }));
  inputs_.expect<nav_msgs::Odometry>(odometry_.subscriber());
  diagnostics_.setHardwareID(config_.node.frames.base);
  diagnostics_.add("stage", [this](Report& status) { report(status); });
  orders_ = std::make_unique<GoalInput>(nh, config_.node.frames);
  worker_.every(nh, kLookAround / config_.node.wiring.plan_rate, [this] { step(); });
  worker_.every(nh, 1.0, [this] { diagnostics_.update(); });
  worker_.start();
}

PlannerNode::~PlannerNode() { worker_.stop(); }

void PlannerNode::step() {
  const double now = ros::Time::now().toSec();
  const OdometrySnapshot odometry = odometry_.read();
  if (continuity_.broken(now, odometry.counters)) forget();
  takeOrder(now);
  takeInputs(odometry.buffer);
  plan_.advance(now);
  if (odometry.buffer.empty() || !scan_ || !map_ || !goal_->goal() || !trigger_.due(now, map_is_new_)) return;
  map_is_new_ = false;
  const Odometry& present = odometry.buffer.latest();
  last_plan_ = plan(now, present, goal_->update(present));
  const TimedPlan timed{last_plan_, now, now + config_.node.wiring.plan_delay};
  plan_.offer(timed.result, timed.made_at, timed.start_time);
  publish(timed);
  answerAction(now, present, last_plan_);
}

void PlannerNode::takeOrder(double now) {
  const std::optional<GoalOrder> order = orders_->take(now);
  if (!order) {
    carryGoal(now);
    return;
  }
  if (order->goal_local) {
    goal_->set(*order->goal_local);
    planner_->reset();
  } else {
    goal_->cancel();
  }
  route_ = {};
  last_progress_ = now;
  publishGoal(now);
}

/// Odometry was corrected: the goal stays where it is in its frame.
void PlannerNode::carryGoal(double now) {
  const std::optional<Eigen::Vector2d> place = goal_->goal() ? orders_->moved() : std::nullopt;
  if (!place) return;
  const Eigen::Vector2d step = *place - *goal_->goal();
  goal_->carry({step.x(), step.y(), 0.0});
  publishGoal(now);
}

bool PlannerNode::isCurrent(const std_msgs::Header& header) const {
  return header.frame_id == config_.node.frames.local && continuity_.isCurrent(header.stamp.toSec());
}

void PlannerNode::takeInputs(const OdometryBuffer& odometry) {
  takeScan(odometry);
  if (const auto message = new_tracks_.take()) {
    auto tracks = fromMessage(*message);
    if (tracks && isCurrent(message->header)) {
      tracks_ = std::move(*tracks);
    } else {
      ++rejected_;
    }
  }
  if (const auto message = new_map_.take()) {
    auto map = fromMessage(*message);
    if (map && isCurrent(message->header)) {
      map_ = std::move(map);
      map_is_new_ = true;
    } else {
      ++rejected_;
    }
  }
  takeRoute();
  takeTeam();
}

void PlannerNode::takeScan(const OdometryBuffer& odometry) {
  const auto message = new_scan_.take();
  if (!message) return;
  std::optional<ObstacleScan> scan = fromMessage(*message);
  const std::optional<Odometry> at_scan = scan ? odometry.at(scan->stamp) : std::nullopt;
  if (!at_scan || !continuity_.isCurrent(scan->stamp) || message->header.frame_id != config_.node.frames.base) {
    ++rejected_;
    return;
  }
  scan_ = std::move(scan);
  T_odom_scan_ = at_scan->pose;
}

void PlannerNode::takeRoute() {
  const auto message = new_route_.take();
  if (!message) return;
  const auto route = fromMessage(*message);
  if (!route || !isCurrent(message->header)) {
    ++rejected_;
  } else if (goal_->goal() && (route->goal - *goal_->goal()).norm() < 1e-6) {
    route_ = route->route;  // a route to the goal before this one is of no use, and no fault
  }
}

void PlannerNode::takeTeam() {
  const auto message = new_team_.take();
  if (!message) return;
  std::optional<TeamMotions> team = fromMessage(*message);
  if (team && isCurrent(message->header)) {
    team_ = std::move(*team);
  } else {
    ++rejected_;
  }
}

PlanResult PlannerNode::plan(double now, const Odometry& odometry, bool at_goal) {
  if (now - map_->stamp > config_.goal.map_timeout) {
    PlanResult result;
    result.status = at_goal ? Status<PlanCode>{PlanCode::kArrived, "at the goal"}
                            : Status<PlanCode>{PlanCode::kNoPath, "the local map is too old"};
    result.keep_committed = at_goal;
    return result;
  }
  if (now - team_.stamp > kOldTeam) {
    team_.peers.clear();
    team_.team_known = false;
  }
  const PlanRequest request{now,
                            now + config_.node.wiring.plan_delay,
                            odometry,
                            *map_,
                            *scan_,
                            T_odom_scan_,
                            tracks_,
                            route_,
                            *goal_->goal(),
                            goal_->tolerance(),
                            plan_.trajectory(),
                            team_.id,
                            team_.peers,
                            team_.team_known,
                            at_goal};
  return planner_->plan(request);
}

void PlannerNode::publish(const TimedPlan& plan) {
  const std::string& local = config_.node.frames.local;
  trajectory_.publish(boost::make_shared<parley_msgs::Trajectory>(toMessage(plan, local)));
  if (path_.getNumSubscribers() > 0 && !plan.result.keep_committed) {
    path_.publish(boost::make_shared<nav_msgs::Path>(toPath(plan.result.trajectory, plan.made_at, local)));
  }
  if (!plan.result.impassable) return;
  auto passage = boost::make_shared<geometry_msgs::PointStamped>();
  passage->header.stamp = ros::Time(plan.made_at);
  passage->header.frame_id = local;
  passage->point.x = plan.result.impassable->x();
  passage->point.y = plan.result.impassable->y();
  shut_passage_.publish(passage);
}

void PlannerNode::publishGoal(double now) {
  auto message = boost::make_shared<parley_msgs::Goal>();
  message->header.stamp = ros::Time(now);
  message->header.frame_id = config_.node.frames.local;
  message->active = goal_->goal().has_value();
  if (message->active) {
    message->position.x = goal_->goal()->x();
    message->position.y = goal_->goal()->y();
  }
  goal_publisher_.publish(message);
}

void PlannerNode::answerAction(double now, const Odometry& odometry, const PlanResult& result) {
  // Who makes room for a stranger because there is no route is stuck too.
  const bool has_way = route_.exists() || !team_.peers.empty() || result.status.is(PlanCode::kArrived);
  if (!isStuck(result.status.code) && has_way) last_progress_ = now;
  if (!orders_->actionRuns()) return;
  orders_->feedback(odometry.pose, odometry.stamp);
  if (result.status.is(PlanCode::kArrived)) {
    orders_->succeed("arrived");
  } else if (now - last_progress_ > config_.goal.patience) {
    orders_->abort(std::string(toString(driveStateOf(result.status.code))) + ": " + result.status.text);
    goal_->cancel();
    route_ = {};
    publishGoal(now);
  }
}

void PlannerNode::forget() {
  planner_->reset();
  plan_.clear();
  trigger_ = PlanTrigger(config_.node.wiring.plan_rate);
  scan_.reset();
  map_.reset();
  tracks_.clear();
  route_ = {};
  team_.peers.clear();
  team_.team_known = false;
}

void PlannerNode::report(Report& report) const {
  report.summary(Report::OK, toString(driveStateOf(last_plan_.status.code)));
  if (!goal_->goal()) report.summary(Report::OK, "no goal");
  if (goal_->goal() && isStuck(last_plan_.status.code)) report.summary(Report::WARN, last_plan_.status.text);
  if (!scan_) report.mergeSummary(Report::WARN, "no obstacle scan");
  if (!map_) report.mergeSummary(Report::WARN, "no local map");
  report.add("trajectories committed", plan_.count());
  report.add("teammates minded", team_.peers.size());
  report.add("escape points taken", last_plan_.escapes);
  report.add("goals refused", orders_->refused());
  report.add("messages rejected", rejected_);
  report.add("exceptions", worker_.errors());
  reportOdometry(report, odometry_.read(), config_.node.frames, ros::Time::now().toSec());
}

}  // namespace parley
