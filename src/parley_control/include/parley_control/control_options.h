// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace parley {

/// How closely the controller tracks, how long it trusts silent inputs, and how early it stops before an obstacle.
struct ControlOptions {
  double period = 0.02;               // [s]
  double look_ahead = 0.01;           // [s]
  double along_gain = 2.0;            // [1/s]
  double cross_gain = 4.0;            // [1/m^2]
  double damping = 0.8;               // [-]
  double heading_gain = 2.0;          // [1/s]
  double correction_speed = 0.3;      // [m/s]
  double correction_turn_rate = 1.0;  // [rad/s]
  double position_tolerance = 0.02;   // [m]
  double heading_tolerance = 0.02;    // [rad]
  double hold_factor = 2.5;           // [-]
  double position_error_limit = 0.5;  // [m]
  double heading_error_limit = 1.2;   // [rad]
  double trajectory_timeout = 0.5;    // [s]
  double odometry_timeout = 0.2;      // [s]
  double lidar_timeout = 0.5;         // [s]
  double stop_margin = 0.03;          // [m]
  double stop_hysteresis = 0.02;      // [m]
  double stop_hold_time = 0.3;        // [s]
  double reaction_time = 0.1;         // [s]
  double braking_share = 1.0;         // [-]
  double standing_speed = 0.01;       // [m/s]
  double standing_turn_rate = 0.02;   // [rad/s]

  template <class Visitor>
  void visit(Visitor& v) {
    v.number("period", period, "s", 0.001, 0.1, "time between two steps, assumed for the first");
    v.number("look_ahead", look_ahead, "s", 0.0, 0.5,
             "the reference twist is read so far ahead: half a period and the drive's delay");
    v.number("along_gain", along_gain, "1/s", 0.0, 10.0, "speed per distance behind the reference");
    v.number("cross_gain", cross_gain, "1/m^2", 0.0, 50.0, "curvature per distance beside the reference");
    v.number("damping", damping, "-", 0.1, 5.0, "of the way back to the reference path; 1 does not overshoot");
    v.number("heading_gain", heading_gain, "1/s", 0.0, 10.0, "turn rate per heading error at standstill; driving adds to it");
    v.number("correction_speed", correction_speed, "m/s", 0.0, 5.0, "most that feedback adds to the reference speed");
    v.number("correction_turn_rate", correction_turn_rate, "rad/s", 0.0, 10.0,
             "most that feedback adds to the reference turn rate");
    v.number("position_tolerance", position_tolerance, "m", 0.001, 0.5,
             "distance along x at which a standing reference is reached");
    v.number("heading_tolerance", heading_tolerance, "rad", 0.001, 0.5, "heading error at which a standing reference is reached");
    v.number("hold_factor", hold_factor, "-", 1.0, 20.0,
             "a robot that has come to rest stays so until an error is this many tolerances");
    v.number("position_error_limit", position_error_limit, "m", 0.05, 10.0,
             "further from the reference than this the plan says nothing: stop");
    v.number("heading_error_limit", heading_error_limit, "rad", 0.1, 1.5,
             "turned away from the reference by more than this: stop");
    v.number("trajectory_timeout", trajectory_timeout, "s", 0.05, 10.0, "stop when the planner has been silent for so long");
    v.number("odometry_timeout", odometry_timeout, "s", 0.02, 5.0, "stop when odometry is older");
    v.number("lidar_timeout", lidar_timeout, "s", 0.02, 5.0, "stop when the scan is older");
    v.number("stop_margin", stop_margin, "m", 0.0, 0.5, "the last-moment stop keeps obstacles so far from the footprint");
    v.number("stop_hysteresis", stop_hysteresis, "m", 0.0, 0.5,
             "more than the margin that must be clear to drive on after a last-moment stop");
    v.number("stop_hold_time", stop_hold_time, "s", 0.0, 5.0,
             "for so long the way must be clear to drive on after a last-moment stop");
    v.number("reaction_time", reaction_time, "s", 0.0, 1.0,
             "from a command to its effect, in which the robot drives on as planned");
    v.number("braking_share", braking_share, "-", 0.1, 1.0, "part of the full braking that the last-moment stop counts on");
    v.number("standing_speed", standing_speed, "m/s", 0.0, 0.2, "measured speeds below this are noise");
    v.number("standing_turn_rate", standing_turn_rate, "rad/s", 0.0, 0.5, "measured turn rates below this are noise");
  }
};

}  // namespace parley
