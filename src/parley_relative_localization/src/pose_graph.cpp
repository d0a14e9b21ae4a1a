// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "clique.h"
#include "pose_graph_solver.h"

namespace parley {
namespace {

constexpr double kAgreement = 11.34;  // [-] 99 % of the chi-squared distribution with three degrees of freedom
constexpr double kStillDrift = 1e-3;  // [m] way that even a standing robot's odometry is worth

PoseEstimate odometryBetween(const Pose2& from, double travel_from, const Pose2& to, double travel_to,
                             const RelativeLocalizationOptions& options) {
  return {from.inverse() * to, driftOver(std::abs(travel_to - travel_from), options)};
}

}  // namespace

Covariance3 driftOver(double way, const RelativeLocalizationOptions& options) {
  const double length = way + kStillDrift;
  const double spread = options.drift_translation * options.drift_translation * length;
  const double turn = options.drift_rotation * options.drift_rotation * length;
  const double aside = spread + turn * way * way / 3.0;
  return Eigen::Vector3d(aside + 1e-8, aside + 1e-8, turn + 1e-8).asDiagonal();
}

RelativeEdge reversed(const RelativeEdge& edge) {
  return {edge.to,          edge.from,      edge.stamp,       edge.T_odom_to,
          edge.T_odom_from, edge.travel_to, edge.travel_from, inverse(edge.T_from_to)};
}

PoseGraph::PoseGraph(const RelativeLocalizationOptions& options, std::string own_name)
    : options_(options), own_name_(std::move(own_name)) {}

void PoseGraph::add(const RelativeEdge& edge) {
  const auto is_replaced = [&](const RelativeEdge& other) {
    if (other.from != edge.from || other.to != edge.to) return false;
    const double way = std::abs(other.travel_from - edge.travel_from) + std::abs(other.travel_to - edge.travel_to);
    return way < options_.edge_travel && other.stamp <= edge.stamp;
  };
  const auto is_same = [&](const RelativeEdge& other) {
    return other.from == edge.from && other.to == edge.to && other.stamp == edge.stamp;
  };
  if (std::any_of(edges_.begin(), edges_.end(), is_same)) return;
  const auto old = std::find_if(edges_.rbegin(), edges_.rend(), is_replaced);
  if (old != edges_.rend()) edges_.erase(std::prev(old.base()));
  edges_.push_back(edge);
  if (edges_.size() > static_cast<std::size_t>(options_.max_edges)) edges_.erase(edges_.begin());
  changed_ = true;
}

void PoseGraph::forget(const std::string& robot) {
  const auto touches = [&](const RelativeEdge& edge) { return edge.from == robot || edge.to == robot; };
  const auto end = std::remove_if(edges_.begin(), edges_.end(), touches);
  changed_ = changed_ || end != edges_.end();
  edges_.erase(end, edges_.end());
}

bool PoseGraph::agree(const RelativeEdge& a, const RelativeEdge& b) const {
  const RelativeEdge other = b.from == a.from ? b : reversed(b);
  // T_from_to at the other time, from a: back along from's odometry, across, and along to's.
  const PoseEstimate back = odometryBetween(other.T_odom_from, other.travel_from, a.T_odom_from, a.travel_from, options_);
  const PoseEstimate along = odometryBetween(a.T_odom_to, a.travel_to, other.T_odom_to, other.travel_to, options_);
  const PoseEstimate expected = compose(compose(back, a.T_from_to), along);
  const Eigen::Vector3d error(expected.pose.x - other.T_from_to.pose.x, expected.pose.y - other.T_from_to.pose.y,
                              angleBetween(other.T_from_to.pose.yaw, expected.pose.yaw));
  const Eigen::Matrix3d covariance = expected.covariance + other.T_from_to.covariance;
  return error.dot(covariance.ldlt().solve(error)) < kAgreement;
}

std::vector<RelativeEdge> PoseGraph::consistentEdges() const {
  std::map<std::pair<std::string, std::string>, std::vector<RelativeEdge>> by_pair;
  for (auto edge = edges_.rbegin(); edge != edges_.rend(); ++edge) {  // newest first, which wins among equals
    auto& pair = by_pair[std::minmax(edge->from, edge->to)];
    if (pair.size() < static_cast<std::size_t>(kMostCliqueNodes)) pair.push_back(*edge);
  }
  std::vector<RelativeEdge> kept;
  for (const auto& [names, pair] : by_pair) {
    std::vector<std::vector<bool>> joined(pair.size(), std::vector<bool>(pair.size(), false));
    for (std::size_t i = 0; i < pair.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) joined[i][j] = joined[j][i] = agree(pair[i], pair[j]);
    }
    for (const int index : maximumClique(joined)) kept.push_back(pair[static_cast<std::size_t>(index)]);
  }
  return kept;
}

std::map<std::string, GraphEstimate> PoseGraph::solve(const Anchor& own) {
  changed_ = false;
  return solveAnchors(own_name_, own, consistentEdges(), options_);
}

}  // namespace parley
