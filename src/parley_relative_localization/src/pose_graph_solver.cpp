// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph_solver.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "relative_pose_error.h"

namespace parley {
namespace {

constexpr int kIterations = 25;       // [-]
constexpr double kCauchy = 2.0;       // [-] deviations from which on a measured edge loses weight
constexpr double kSameAnchor = 1e-6;  // [m] [rad]

struct Node {
  Anchor anchor;
  double* pose = nullptr;  // x [m], y [m], yaw [rad] in own odom; see layOut
  bool placed = false;
};

using Nodes = std::map<std::string, std::vector<Node>>;  // each robot's by travel

Pose2 poseOf(const Node& node) { return {node.pose[0], node.pose[1], wrapAngle(node.pose[2])}; }

void place(Node& node, const Pose2& pose) {
  node.pose[0] = pose.x;
  node.pose[1] = pose.y;
  node.pose[2] = pose.yaw;
  node.placed = true;
}

/// Standing robots turn: the way alone does not tell anchors apart.
double difference(const Anchor& a, const Anchor& b) {
  return std::abs(a.travel - b.travel) + (a.T_odom_base.position() - b.T_odom_base.position()).norm() +
         std::abs(angleBetween(a.T_odom_base.yaw, b.T_odom_base.yaw));
}

void addAnchor(std::vector<Node>& nodes, const Anchor& anchor) {
  for (const Node& node : nodes) {
    if (difference(node.anchor, anchor) < kSameAnchor) return;
  }
  const auto farther = [](double travel, const Node& node) { return travel < node.anchor.travel; };
  nodes.insert(std::upper_bound(nodes.begin(), nodes.end(), anchor.travel, farther), Node{anchor});
}

/// Gives the nodes room for their poses, one after the other. The covariances' last bits depend on the order of the addresses.
std::vector<double> layOut(Nodes& nodes) {
  std::size_t count = 0;
  for (const auto& [name, anchors] : nodes) count += anchors.size();
  std::vector<double> poses(3 * count, 0.0);
  double* next = poses.data();
  for (auto& [name, anchors] : nodes) {
    for (Node& node : anchors) {
      node.pose = next;
      next += 3;
    }
  }
  return poses;
}

Node& find(std::vector<Node>& nodes, const Anchor& anchor) {
  const auto nearer = [&](const Node& a, const Node& b) { return difference(a.anchor, anchor) < difference(b.anchor, anchor); };
  return *std::min_element(nodes.begin(), nodes.end(), nearer);
}

Anchor fromOf(const RelativeEdge& edge) { return {edge.T_odom_from, edge.travel_from}; }
Anchor toOf(const RelativeEdge& edge) { return {edge.T_odom_to, edge.travel_to}; }

/// Places all anchors of a robot from one that is placed.
void placeAlong(std::vector<Node>& nodes, const Node& from) {
  const Pose2 T_own_odom = poseOf(from) * from.anchor.T_odom_base.inverse();
  for (Node& node : nodes) {
    if (!node.placed) place(node, T_own_odom * node.anchor.T_odom_base);
  }
}

/// First guesses, from robot to robot along the edges; those not reached are left out.
void placeAll(Nodes& nodes, const std::vector<RelativeEdge>& edges) {
  for (bool progress = true; progress;) {
    progress = false;
    for (const RelativeEdge& edge : edges) {
      Node& from = find(nodes[edge.from], fromOf(edge));
      Node& to = find(nodes[edge.to], toOf(edge));
      if (from.placed == to.placed) continue;
      if (from.placed) {
        place(to, poseOf(from) * edge.T_from_to.pose);
        placeAlong(nodes[edge.to], to);
      } else {
        place(from, poseOf(to) * edge.T_from_to.pose.inverse());
        placeAlong(nodes[edge.from], from);
      }
      progress = true;
    }
  }
}

Eigen::Matrix3d rootOfInformation(const Covariance3& covariance) { return covariance.inverse().llt().matrixL().transpose(); }

void addResidual(ceres::Problem& problem, Node& a, Node& b, const PoseEstimate& T_a_b, bool measured) {
  auto error = std::make_unique<RelativePoseError>(T_a_b.pose, rootOfInformation(T_a_b.covariance));
  auto cost = std::make_unique<ceres::AutoDiffCostFunction<RelativePoseError, 3, 3, 3>>(error.release());
  auto loss = measured ? std::make_unique<ceres::CauchyLoss>(kCauchy) : nullptr;
  problem.AddResidualBlock(cost.release(), loss.release(), a.pose, b.pose);
}

void buildProblem(ceres::Problem& problem, Nodes& nodes, const std::vector<RelativeEdge>& edges,
                  const RelativeLocalizationOptions& options) {
  for (auto& [name, anchors] : nodes) {
    for (std::size_t i = 1; i < anchors.size(); ++i) {
      if (!anchors[i].placed) continue;
      const Anchor &a = anchors[i - 1].anchor, &b = anchors[i].anchor;
      const PoseEstimate step{a.T_odom_base.inverse() * b.T_odom_base, driftOver(b.travel - a.travel, options)};
      addResidual(problem, anchors[i - 1], anchors[i], step, false);
    }
  }
  for (const RelativeEdge& edge : edges) {
    Node& from = find(nodes[edge.from], fromOf(edge));
    Node& to = find(nodes[edge.to], toOf(edge));
    if (from.placed && to.placed) addResidual(problem, from, to, edge.T_from_to, true);
  }
}

bool solve(ceres::Problem& problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = kIterations;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.IsSolutionUsable();
}

/// Covariances of each robot's newest anchor against the held one.
bool covariancesOf(ceres::Problem& problem, const std::vector<const double*>& blocks, std::vector<Covariance3>& result) {
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::SPARSE_QR;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  ceres::Covariance covariance(options);
  std::vector<std::pair<const double*, const double*>> pairs;
  pairs.reserve(blocks.size());
  for (const double* block : blocks) pairs.emplace_back(block, block);
  if (!covariance.Compute(pairs, &problem)) return false;
  for (const double* block : blocks) {
    std::array<double, 9> values{};
    if (!covariance.GetCovarianceBlock(block, block, values.data())) return false;
    result.push_back(Eigen::Map<const Eigen::Matrix3d>(values.data()));
  }
  return true;
}

}  // namespace

std::map<std::string, GraphEstimate> solveAnchors(const std::string& own_name, const Anchor& own,
                                                  const std::vector<RelativeEdge>& edges,
                                                  const RelativeLocalizationOptions& options) {
  Nodes nodes;
  addAnchor(nodes[own_name], own);
  for (const RelativeEdge& edge : edges) {
    addAnchor(nodes[edge.from], fromOf(edge));
    addAnchor(nodes[edge.to], toOf(edge));
  }
  std::vector<double> poses = layOut(nodes);
  Node& origin = find(nodes[own_name], own);
  place(origin, own.T_odom_base);
  placeAlong(nodes[own_name], origin);
  placeAll(nodes, edges);
  ceres::Problem problem;
  buildProblem(problem, nodes, edges, options);
  std::map<std::string, GraphEstimate> estimates;
  if (problem.NumResidualBlocks() == 0 || !problem.HasParameterBlock(origin.pose)) return estimates;
  problem.SetParameterBlockConstant(origin.pose);
  if (!solve(problem)) return estimates;
  std::vector<std::string> names;
  std::vector<const double*> blocks;
  for (const auto& [name, anchors] : nodes) {
    if (name == own_name || !anchors.back().placed) continue;
    names.push_back(name);
    blocks.push_back(anchors.back().pose);
  }
  std::vector<Covariance3> covariances;
  if (blocks.empty() || !covariancesOf(problem, blocks, covariances)) return estimates;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Node& newest = nodes[names[i]].back();
    const PoseEstimate T_odom_anchor{poseOf(newest), covariances[i]},
        back{newest.anchor.T_odom_base.inverse(), Covariance3::Zero()};
    GraphEstimate& estimate = estimates[names[i]];
    estimate.T_odom_peerodom = compose(T_odom_anchor, back);
    estimate.travel = newest.anchor.travel;
    for (const RelativeEdge& edge : edges) {
      if (edge.from != names[i] && edge.to != names[i]) continue;
      estimate.stamp = estimate.edges == 0 ? edge.stamp : std::max(estimate.stamp, edge.stamp);
      ++estimate.edges;
    }
  }
  return estimates;
}

}  // namespace parley
