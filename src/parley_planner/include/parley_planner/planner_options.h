// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace parley {

/// All knobs of the local planner.
struct PlannerOptions {
  // Path
  double look_ahead = 4.5;          // [m]
  double comfort_distance = 0.70;   // [m]
  double clearance_weight = 3.0;    // [-]
  double unknown_cost = 1.5;        // [-]
  double keep_path_discount = 0.9;  // [-]
  double push_distance = 0.6;       // [m]
  double bending_weight = 60.0;     // [-]
  double twisting_weight = 2000.0;  // [-]
  int smoothing_iterations = 10;    // [-]

  // Optimisation of the trajectory
  bool trajectory_optimization = true;
  int optimization_iterations = 12;             // [-]
  double optimization_time_weight = 200.0;      // [1/s^5]
  double optimization_limit_weight = 300.0;     // [-]
  double optimization_push_weight = 4000.0;     // [1/m^2]
  double optimization_deviation_weight = 10.0;  // [1/m^2]

  // Motion
  double time_step = 0.05;         // [s]
  double limit_share = 0.95;       // [-]
  double margin_creeping = 0.05;   // [m]
  double margin_per_speed = 0.04;  // [s]
  double creep_speed = 0.2;        // [m/s]
  double turn_on_spot = 1.2;       // [rad]
  double replan_period = 0.2;      // [s]
  double largest_deviation = 0.2;  // [m]

  // Others
  double prediction_time = 1.5;  // [s]
  double track_margin = 0.1;     // [m]
  double peer_margin = 0.08;     // [m]
  bool conflict_resolution = true;
  bool sight_law = true;
  double sight_reaction_time = 0.2;   // [s]
  double sight_intruder_speed = 2.0;  // [m/s]
  double sight_clearance = 0.6;       // [m]
  double sight_least_speed = 0.4;     // [m/s]

  // Getting unstuck
  double reverse_speed = 0.8;     // [m/s]
  double stuck_time = 3.0;        // [s]
  double margin_tight = 0.03;     // [m]
  int narrow_iterations = 20000;  // [-]

  template <class Visitor>
  void visit(Visitor& v) {
    v.number("look_ahead", look_ahead, "m", 1.0, 20.0, "how far along the route the local goal lies");
    v.number("comfort_distance", comfort_distance, "m", 0.1, 2.0, "a path closer than this to obstacles costs more");
    v.number("clearance_weight", clearance_weight, "-", 0.0, 50.0, "extra cost of a path that grazes an obstacle");
    v.number("unknown_cost", unknown_cost, "-", 1.0, 20.0, "cost of a metre through unseen space");
    v.number("keep_path_discount", keep_path_discount, "-", 0.5, 1.0, "cost factor along the previous path");
    v.number("push_distance", push_distance, "m", 0.0, 2.0, "obstacles nearer than this push the smoothed path away");
    v.number("bending_weight", bending_weight, "-", 0.1, 10000.0, "how stiff the path is against obstacles' push");
    v.number("twisting_weight", twisting_weight, "-", 0.0, 1000000.0, "how much the path resists changes of curvature");
    v.integer("smoothing_iterations", smoothing_iterations, "-", 0, 1000, "steps of the path smoothing");
    v.flag("trajectory_optimization", trajectory_optimization, "make forward drives faster by optimising their curve");
    v.integer("optimization_iterations", optimization_iterations, "-", 0, 1000, "steps of the optimisation at most; 0 is none");
    v.number("optimization_time_weight", optimization_time_weight, "1/s^5", 0.0, 1000000.0,
             "cost of a second, beside that of squared jerk");
    v.number("optimization_limit_weight", optimization_limit_weight, "-", 0.0, 1000000.0,
             "cost of breaking a limit by all of it, each sample");
    v.number("optimization_push_weight", optimization_push_weight, "1/m^2", 0.0, 1000000.0,
             "cost of coming nearer to obstacles than the path should, each sample");
    v.number("optimization_deviation_weight", optimization_deviation_weight, "1/m^2", 0.0, 1000000.0,
             "cost of leaving the smoothed path, each sample");
    v.number("time_step", time_step, "s", 0.01, 0.2, "between the states of a trajectory");
    v.number("limit_share", limit_share, "-", 0.5, 1.0, "share of the motion limits that plans use; control has the rest");
    v.number("margin_creeping", margin_creeping, "m", 0.0, 0.5, "distance kept from obstacles when almost standing");
    v.number("margin_per_speed", margin_per_speed, "s", 0.0, 0.5, "distance kept in addition, per m/s");
    v.number("creep_speed", creep_speed, "m/s", 0.02, 1.0, "speed where there is hardly any room");
    v.number("turn_on_spot", turn_on_spot, "rad", 0.2, 3.2, "a path that starts further off the heading is turned to standing");
    v.number("replan_period", replan_period, "s", 0.0, 2.0, "a valid trajectory is driven this long where nothing else moves");
    v.number("largest_deviation", largest_deviation, "m", 0.05, 2.0, "further off the trajectory, plans start from the odometry");
    v.number("prediction_time", prediction_time, "s", 0.0, 5.0, "how long tracked things are taken to keep their velocity");
    v.number("track_margin", track_margin, "m", 0.0, 1.0, "distance kept from the predicted place of tracked things");
    v.number("peer_margin", peer_margin, "m", 0.0, 1.0,
             "distance kept from where teammates said they will be, their pose's error apart");
    v.flag("conflict_resolution", conflict_resolution, "agree with teammates on who goes first, and make room");
    v.flag("sight_law", sight_law, "drive so that a hidden robot under the same law and this one can both stop");
    v.number("sight_reaction_time", sight_reaction_time, "s", 0.0, 2.0, "from first sight to braking, either robot");
    v.number("sight_intruder_speed", sight_intruder_speed, "m/s", 0.0, 10.0, "speed of robots that nobody has seen");
    v.number("sight_clearance", sight_clearance, "m", 0.0, 2.0, "distance from walls that robots nobody has seen keep");
    v.number("sight_least_speed", sight_least_speed, "m/s", 0.05, 10.0, "sight alone never makes the robot slower than this");
    v.number("stuck_time", stuck_time, "s", 0.5, 60.0, "without progress for this long, the next harder measure is tried");
    v.number("reverse_speed", reverse_speed, "m/s", 0.05, 10.0, "highest speed backwards");
    v.number("margin_tight", margin_tight, "m", 0.0, 0.5, "distance kept when creeping after getting stuck");
    v.integer("narrow_iterations", narrow_iterations, "-", 0, 1000000, "bound of the search with headings");
  }
};

}  // namespace parley
