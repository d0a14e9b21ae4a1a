// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parley_geometry/options.h"

namespace parley {

/// What the exchange stage can be told.
struct ExchangeOptions {
  double rate = 1500.0;           // [byte/s]
  double burst = 3000.0;          // [byte]
  int packet_size = 1100;         // [byte]
  double record_reserve = 700.0;  // [byte]
  double keyframe_share = 0.4;    // [-]

  double trajectory_rate_max = 4.0;    // [Hz]
  double trajectory_rate_min = 1.0;    // [Hz]
  double trajectory_tolerance = 0.05;  // [m]
  double beacon_rate_max = 10.0;       // [Hz]
  double beacon_rate_min = 2.0;        // [Hz]
  int beacon_crowd = 4;                // [-]
  int digest_entries = 5;              // [-]

  double resend_interval = 0.75;  // [s]
  double resend_growth = 1.4;     // [-]
  double resend_limit = 1.6;      // [s]
  double relay_delay = 1.0;       // [s]

  double neighbour_timeout = 4.0;  // [s]
  double peer_timeout = 60.0;      // [s]
  double origin_timeout = 900.0;   // [s]

  double anchor_distance = 4.0;    // [m]
  double drift = 0.01;             // [-]
  double yaw_drift = 0.002;        // [rad/m]
  double contour_settle = 1.5;     // [s]
  double contour_tolerance = 0.1;  // [m]
  double contour_extent = 0.25;    // [m]
  double contour_interval = 3.0;   // [s]
  double tombstone_delay = 2.0;    // [s]
  double endorse_distance = 0.15;  // [m]
  int max_edges = 8;               // [-]
  int max_endorsements = 2;        // [-]

  int max_peers = 128;            // [-]
  int max_senders = 256;          // [-]
  int max_origins = 128;          // [-]
  int max_records = 2048;         // [-]
  int max_log_bytes = 65536;      // [byte]
  int max_total_bytes = 4194304;  // [byte]
  double max_packet_rate = 50.0;  // [1/s]
  double max_speed = 10.0;        // [m/s]
  double max_turn_rate = 10.0;    // [rad/s]

  template <class Visitor>
  void visit(Visitor& v) {
    v.number("rate", rate, "byte/s", 100.0, 1e6, "sustained limit of what is sent, 28 bytes of IP and UDP a packet included");
    v.number("burst", burst, "byte", 1200.0, 1e6, "any T seconds carry at most this and T times the rate");
    v.integer("packet_size", packet_size, "byte", 400, 1100, "longest datagram");
    v.number("record_reserve", record_reserve, "byte", 0.0, 1e5,
             "records leave so much of the budget to trajectories and beacons");
    v.number("keyframe_share", keyframe_share, "-", 0.0, 1.0,
             "room in a packet's records kept for keyframes that an unconfirmed neighbour lacks");
    v.number("trajectory_rate_max", trajectory_rate_max, "Hz", 0.5, 20.0, "how often a changing trajectory is sent at most");
    v.number("trajectory_rate_min", trajectory_rate_min, "Hz", 0.1, 10.0, "how often one is sent that does not change");
    v.number("trajectory_tolerance", trajectory_tolerance, "m", 0.0, 1.0, "a trajectory has changed where it differs by more");
    v.number("beacon_rate_max", beacon_rate_max, "Hz", 1.0, 20.0, "beacons while clocks or poses of a neighbour are unknown");
    v.number("beacon_rate_min", beacon_rate_min, "Hz", 0.2, 20.0, "beacons otherwise");
    v.integer("beacon_crowd", beacon_crowd, "-", 1, 1000, "with more neighbours the higher rate sinks in proportion");
    v.integer("digest_entries", digest_entries, "-", 1, 31, "logs of which a beacon tells the coverage");
    v.number("resend_interval", resend_interval, "s", 0.05, 60.0, "before a record is sent a second time");
    v.number("resend_growth", resend_growth, "-", 1.0, 10.0, "each further time takes so much longer");
    v.number("resend_limit", resend_limit, "s", 0.05, 600.0, "longest time between sends");
    v.number("relay_delay", relay_delay, "s", 0.0, 60.0, "mean wait before a record of somebody else is passed on");
    v.number("neighbour_timeout", neighbour_timeout, "s", 0.5, 60.0, "a robot heard within this time is a neighbour");
    v.number("peer_timeout", peer_timeout, "s", 5.0, 3600.0, "a robot not heard for so long is no longer listed");
    v.number("origin_timeout", origin_timeout, "s", 10.0, 1e5,
             "records of a robot are dropped when none was written for so long and it is not listed");
    v.number("anchor_distance", anchor_distance, "m", 0.5, 8.0, "way from one anchor to the next");
    v.number("drift", drift, "-", 0.0, 0.5, "standard deviation of odometry per metre");
    v.number("yaw_drift", yaw_drift, "rad/m", 0.0, 0.5, "the same of its yaw");
    v.number("contour_extent", contour_extent, "m", 0.0, 1.0,
             "smaller contours are not published: single hits, for the most part");
    v.number("contour_settle", contour_settle, "s", 0.0, 10.0,
             "a contour is published when it has not changed for so long, or after two intervals");
    v.number("contour_tolerance", contour_tolerance, "m", 0.0, 1.0, "a contour is published anew where it differs by more");
    v.number("contour_interval", contour_interval, "s", 0.0, 60.0, "between two versions of a contour at least");
    v.number("tombstone_delay", tombstone_delay, "s", 0.0, 60.0, "a contour that is missing so long is withdrawn");
    v.number("endorse_distance", endorse_distance, "m", 0.0, 1.0,
             "a contour within this and two sigma of a confirmed peer's is endorsed and not sent");
    v.integer("max_edges", max_edges, "-", 1, 1000, "peers whose measured pose is told at a time");
    v.integer("max_endorsements", max_endorsements, "-", 0, 100, "with so many of others, no endorsement is added");
    v.integer("max_peers", max_peers, "-", 1, 1000, "robots listed; more are not listened to until one leaves");
    v.integer("max_senders", max_senders, "-", 1, 10000, "robots whose boots are remembered; more are refused");
    v.integer("max_origins", max_origins, "-", 1, 1000, "robots whose records are held; more are refused");
    v.integer("max_records", max_records, "-", 16, 60000, "records held of a robot; more are refused");
    v.integer("max_log_bytes", max_log_bytes, "byte", 4096, 10000000, "bodies held of a robot; more are refused");
    v.integer("max_total_bytes", max_total_bytes, "byte", 4096, 1000000000, "bodies held of all; more are refused");
    v.number("max_packet_rate", max_packet_rate, "1/s", 1.0, 1000.0, "packets listened to of one sender");
    v.number("max_speed", max_speed, "m/s", 0.1, 10.0, "a robot that claims to be faster is not believed");
    v.number("max_turn_rate", max_turn_rate, "rad/s", 0.1, 10.0, "a robot that claims to turn faster is not believed");
  }
};

}  // namespace parley
