// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "own_recorder.h"
#include "peer_localizer.h"
#include "pose_graph.h"

namespace parley {

/// All peers of a robot and what joins them.
class RelativeLocalization::Core {
 public:
  Core(const RelativeLocalizationOptions& own_options, std::string own_name, const Footprint& own_footprint);

  /// nullptr where there are too many.
  PeerLocalizer* peer(const std::string& peer_name);
  /// The whole of a step: weigh each peer, search for one that nobody sees, judge, solve the graph, answer.
  std::vector<PeerEstimate> step(double now);
  /// Edges about a pose that this robot has seen to be wrong are not taken from others either.
  void addEdge(const RelativeEdge& edge);
  void forget(const std::string& peer_name);

  const RelativeLocalizationOptions options;
  const std::string name;
  const Footprint footprint;
  OwnRecorder own;
  std::map<std::string, PeerLocalizer> peers;
  PoseGraph graph;
  RelativeLocalizationCounters counters;

 private:
  bool isBlocked(double now, const PeerLocalizer& one) const;
  bool contradictsGraph(double now, const PeerLocalizer& one, const SightFit& fit) const;
  bool overlapsKnown(const PeerLocalizer& one, const SightFit& fit) const;
  std::string whoWasAt(double stamp, const Eigen::Vector2d& place, double reach) const;
  void nameBlobs(const std::vector<PeerEstimate>& estimates);
  void searchForOne(double now);
  void updateGraph(double now);
  std::optional<Pose2> knownFrame(const std::string& peer_name) const;
  std::optional<PoseEstimate> byGraph(double now, const std::string& peer_name) const;
  void mergeGraph(double now, const std::string& peer_name, PeerEstimate& estimate) const;

  std::map<std::string, GraphEstimate> solved_;
  std::map<std::string, double> demoted_;        // [s] when a peer's pose was last contradicted
  std::vector<PeerEstimate> known_;              // confirmed at the last step
  std::map<std::string, double> blocked_until_;  // [s]
  double solved_travel_ = 0.0;                   // [m] own odometer then
  double last_solved_ = -1e18;                   // [s]
  double last_search_ = -1e18;                   // [s]
};

}  // namespace parley
