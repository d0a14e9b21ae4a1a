// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_geometry/options.h"

namespace parley {

/// What relative localization can be told.
struct RelativeLocalizationOptions {
  double keyframe_distance = 0.8;  // [m]
  double keyframe_angle = 0.8;     // [rad]
  int own_keyframes = 6;           // [-]
  int peer_keyframes = 6;          // [-]
  int sent_keyframes = 4;          // [-]
  int max_reports = 4;             // [-]

  double sight_window = 6.0;        // [s]
  double sight_noise = 0.03;        // [m]
  double sight_gate = 0.35;         // [m]
  double chord_gate = 0.2;          // [m]
  double time_offset_noise = 0.05;  // [s]
  double max_time_offset = 0.25;    // [s]
  int max_hypotheses = 8;           // [-]
  int max_sights = 80;              // [-]
  int max_blobs = 16;               // [-]
  int max_told_blobs = 6;           // [-]

  int matches_mutual = 40;          // [-]
  int matches_alone = 70;           // [-]
  double max_violations = 0.04;     // [-]
  double min_observability = 0.05;  // [-]
  double ambiguity_gap = 0.12;      // [-]
  double search_period = 1.0;       // [s]
  bool global_search = true;

  int confirm_own_sights = 4;        // [-]
  int confirm_peer_sights = 3;       // [-]
  double confirm_span = 0.3;         // [s]
  double confirm_travel = 0.5;       // [m]
  double confirm_distinction = 0.5;  // [m]
  double confirm_residual = 1.0;     // [-]
  double confirm_deviation = 0.12;   // [m]
  double confirm_rotation = 0.03;    // [rad]
  double rival_share = 0.5;          // [-]
  int demote_contradictions = 3;     // [-]

  double drift_translation = 0.01;  // [m]
  double drift_rotation = 0.001;    // [rad]
  double expire_deviation = 0.5;    // [m]
  double expire_age = 600.0;        // [s]
  int max_peers = 64;               // [-]
  int max_edges = 64;               // [-]
  double edge_travel = 3.0;         // [m]

  template <class Visitor>
  void visit(Visitor& v) {
    visitSights(v);
    visitMatches(v);
    visitConfirmation(v);
    visitGraph(v);
  }

 private:
  template <class Visitor>
  void visitSights(Visitor& v) {
    v.number("keyframe_distance", keyframe_distance, "m", 0.1, 10.0, "way after which a new keyframe is taken");
    v.number("keyframe_angle", keyframe_angle, "rad", 0.1, 6.2832, "turn after which a new keyframe is taken");
    v.integer("own_keyframes", own_keyframes, "-", 1, 16, "own keyframes in a submap; older ones are forgotten");
    v.integer("peer_keyframes", peer_keyframes, "-", 1, 16, "keyframes held of each peer; older ones are forgotten");
    v.integer("sent_keyframes", sent_keyframes, "-", 1, 16, "newest keyframes that a peer without a confirmed pose needs");
    v.integer("max_reports", max_reports, "-", 1, 10, "scans with blobs that are told in one go, more new than old");
    v.number("sight_window", sight_window, "s", 1.0, 30.0, "sightings older than this are not used");
    v.number("sight_noise", sight_noise, "m", 0.005, 0.5, "standard deviation of a robot's middle as seen");
    v.number("sight_gate", sight_gate, "m", 0.05, 1.0, "a blob this near to where the peer should be is the peer");
    v.number("chord_gate", chord_gate, "m", 0.02, 1.0, "its width differs from the footprint's by less than this");
    v.number("time_offset_noise", time_offset_noise, "s", 0.0, 0.2, "standard deviation of the offset between the clocks");
    v.number("max_time_offset", max_time_offset, "s", 0.0, 0.5, "largest offset between the clocks that is looked for");
    v.integer("max_hypotheses", max_hypotheses, "-", 1, 64, "poses weighed for each peer; the least supported goes first");
    v.integer("max_sights", max_sights, "-", 8, 400, "scans with their blobs held of each robot; older ones are forgotten");
    v.integer("max_blobs", max_blobs, "-", 1, 100, "blobs used of a scan; the nearest come first");
    v.integer("max_told_blobs", max_told_blobs, "-", 1, 100, "blobs told of a scan; the nearest come first");
  }

  template <class Visitor>
  void visitMatches(Visitor& v) {
    v.integer("matches_mutual", matches_mutual, "-", 1, 1000, "points that must match where robots saw each other");
    v.integer("matches_alone", matches_alone, "-", 1, 1000, "points that must match where they did not");
    v.number("max_violations", max_violations, "-", 0.0, 0.5, "share of points that the other scans may have seen through");
    v.number("min_observability", min_observability, "-", 0.0, 0.5, "a direction with less of the information is not observed");
    v.number("ambiguity_gap", ambiguity_gap, "-", 0.0, 1.0, "share of points by which the best match leads the next one");
    v.number("search_period", search_period, "s", 0.1, 60.0, "least time between two global searches of this robot");
    v.flag("global_search", global_search, "search for a match where robots have not seen each other");
  }

  template <class Visitor>
  void visitConfirmation(Visitor& v) {
    v.integer("confirm_own_sights", confirm_own_sights, "-", 1, 100, "scans in which this robot saw the peer");
    v.integer("confirm_peer_sights", confirm_peer_sights, "-", 1, 100, "scans in which the peer saw this robot");
    v.number("confirm_span", confirm_span, "s", 0.0, 30.0, "time from first to last of them");
    v.number("confirm_travel", confirm_travel, "m", 0.0, 30.0, "way of each robot while the other saw it, together");
    v.number("confirm_distinction", confirm_distinction, "m", 0.0, 10.0, "how far their motion is from that of a queue");
    v.number("confirm_residual", confirm_residual, "-", 0.5, 10.0, "largest root mean square of the residuals over noise");
    v.number("confirm_deviation", confirm_deviation, "m", 0.01, 1.0, "largest standard deviation of the position");
    v.number("confirm_rotation", confirm_rotation, "rad", 0.001, 1.0, "largest standard deviation of the heading");
    v.number("rival_share", rival_share, "-", 0.0, 1.0, "another pose with this share of the support blocks confirmation");
    v.integer("demote_contradictions", demote_contradictions, "-", 1, 100,
              "scans in a row that see through a confirmed peer before it is doubted");
  }

  template <class Visitor>
  void visitGraph(Visitor& v) {
    v.number("drift_translation", drift_translation, "m", 0.0, 1.0, "odometry's drift in position per square root of metre");
    v.number("drift_rotation", drift_rotation, "rad", 0.0, 0.2, "odometry's drift in heading per square root of metre");
    v.number("expire_deviation", expire_deviation, "m", 0.05, 10.0, "a pose less certain than this is no longer confirmed");
    v.number("expire_age", expire_age, "s", 1.0, 86400.0, "a pose without support for so long is forgotten");
    v.integer("max_peers", max_peers, "-", 1, 1000, "peers followed; later ones are refused");
    v.integer("max_edges", max_edges, "-", 2, 1000, "measured poses held; the oldest goes first");
    v.number("edge_travel", edge_travel, "m", 0.1, 100.0, "way of both robots between two measured poses that are kept");
  }
};

}  // namespace parley
