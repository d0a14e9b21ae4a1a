// SPDX-License-Identifier: BSD-3-Clause
#include "explanation.h"

#include <iomanip>
#include <sstream>

namespace parley::sim {
namespace {

const char* nameOf(RouteVerdict verdict) {
  switch (verdict) {
    case RouteVerdict::kNoGoal:
      return "no goal";
    case RouteVerdict::kThroughKnown:
      return "through known space";
    case RouteVerdict::kThroughUnknown:
      return "through unknown space";
    case RouteVerdict::kUnreachableAsKnown:
      return "unreachable as known";
  }
  return "";
}

const char* nameOf(PlanCode code) {
  switch (code) {
    case PlanCode::kDriving:
      return "driving";
    case PlanCode::kArrived:
      return "arrived";
    case PlanCode::kNoRoute:
      return "no route";
    case PlanCode::kNoPath:
      return "no path";
    case PlanCode::kBlocked:
      return "blocked";
    case PlanCode::kWaiting:
      return "waiting";
    case PlanCode::kYielding:
      return "yielding";
    case PlanCode::kEscaping:
      return "escaping";
  }
  return "";
}

void write(std::ostream& out, const Eigen::Vector2d& p) { out << " (" << p.x() << ", " << p.y() << ")"; }

void writeRoute(std::ostream& out, const Route& route) {
  out << "route      " << nameOf(route.verdict) << ", " << route.length << " m, cost " << route.cost << ", narrowest "
      << route.narrowest << " m, " << route.switches << " switches:";
  for (const Eigen::Vector2d& p : route.points) write(out, p);
  out << "\n";
}

void writePlan(std::ostream& out, const PlanResult& plan) {
  out << "plan       " << nameOf(plan.status.code) << (plan.status.text.empty() ? "" : ", " + plan.status.text)
      << (plan.keep_committed ? ", keeps what is committed" : ", new") << ", sight allows " << plan.speed_bound
      << " m/s, local goal";
  write(out, plan.local_goal);
  out << "\n";
}

void writeCommitted(std::ostream& out, const CommittedPlan& plan) {
  out << "committed  number " << plan.count();
  if (!plan.trajectory().empty()) {
    const TrajectoryPoint& end = plan.trajectory().points().back();
    out << ", " << plan.trajectory().length() << " m from " << plan.trajectory().startTime() << " s to " << end.time
        << " s, ends at";
    write(out, end.pose.position());
  }
  out << "\n";
}

void writeRight(std::ostream& out, const RightOfWay& right) {
  out << " goes with right " << right.priority << " of " << std::hex << std::setw(8) << std::setfill('0') << right.holder
      << std::dec << std::setfill(' ') << " at depth " << right.depth;
}

void writeIntent(std::ostream& out, const Intent& intent) {
  writeRight(out, intent.right);
  out << ", means to go";
  for (const Eigen::Vector2d& p : intent.way) write(out, p);
  out << "\n";
}

void writeTeam(std::ostream& out, const RobotStack& stack, double now) {
  if (stack.team() == nullptr) return;
  out << "self      ";
  writeIntent(out, stack.lastPlan().intent);
  for (const auto& [id, mate] : stack.team()->teammates()) {
    constexpr const char* kStates[] = {"unknown", "candidate", "tentative", "confirmed"};
    out << "teammate   " << mate.name << " " << kStates[static_cast<int>(mate.estimate.state)]
        << (mate.estimate.direct ? ", measured here" : "") << ", support " << mate.estimate.support << "\n";
  }
  for (const PeerMotion& peer : stack.team()->motions(now)) {
    const auto mate = stack.team()->teammates().find(peer.id);
    out << "peer       " << (mate != stack.team()->teammates().end() ? mate->second.name : "") << " at";
    write(out, peer.trajectory.at(now).pose.position());
    out << " until";
    write(out, peer.trajectory.points().back().pose.position());
    out << " at " << peer.trajectory.endTime() << " s, heard " << now - peer.heard << " s ago, sigma " << peer.sigma << " m,";
    writeIntent(out, peer.intent);
  }
}

void writeTracks(std::ostream& out, const std::vector<TrackedObject>& tracks) {
  for (const TrackedObject& track : tracks) {
    out << "track " << std::setw(5) << std::left << track.id << std::right;
    write(out, track.position);
    out << " at";
    write(out, track.velocity);
    out << " m/s, radius " << track.radius << " m, " << track.observations << " scans"
        << (track.moving      ? ", moving"
            : track.has_moved ? ", has moved"
                              : "")
        << "\n";
  }
}

}  // namespace

std::string explanationOf(const RobotStack& stack) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(2);
  if (stack.odometry().empty()) return "odometry   none\n";
  const Odometry& odometry = stack.odometry().latest();
  out << "odometry   " << odometry.stamp << " s,";
  write(out, odometry.pose.position());
  out << ", yaw " << odometry.pose.yaw << " rad, " << odometry.twist.speed << " m/s, " << odometry.twist.turn_rate << " rad/s\n";
  writeRoute(out, stack.route());
  writePlan(out, stack.lastPlan());
  writeCommitted(out, stack.plan());
  writeTeam(out, stack, odometry.stamp);
  writeTracks(out, stack.lidar().tracks);
  return out.str();
}

}  // namespace parley::sim
