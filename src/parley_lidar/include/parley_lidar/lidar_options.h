// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace parley {

/// Where the lidar sits on the robot: T_base_lidar. base_link is on the floor, so z is the lidar's height.
struct LidarMount {
  double x = 0.0;    // [m]
  double y = 0.0;    // [m]
  double z = 0.5;    // [m]
  double yaw = 0.0;  // [rad]

  template <class Visitor>
  void visit(Visitor& v) {
    v.number("x", x, "m", -5.0, 5.0, "lidar ahead of base_link");
    v.number("y", y, "m", -5.0, 5.0, "lidar to the left of base_link");
    v.number("z", z, "m", 0.0, 5.0, "lidar above the floor");
    v.number("yaw", yaw, "rad", -6.2832, 6.2832, "turn of the lidar's x axis from the robot's");
  }
};

/// Everything that can be set on the lidar stage. The defaults are for a 0.8 x 0.4 m robot at 2 m/s.
struct LidarOptions {
  int bins = 720;              // [-]
  double max_range = 10.0;     // [m]
  double min_range = 0.1;      // [m]
  double min_height = 0.1;     // [m]
  double max_height = 1.5;     // [m]
  double self_margin = 0.05;   // [m]
  double cloud_view = 6.2832;  // [rad]
  double max_duration = 0.5;   // [s]
  int max_beams = 20000;       // [-]
  int max_points = 100000;     // [-]
  double voxel_size = 0.05;    // [m]

  double outlier_distance = 0.2;  // [m]
  double outlier_memory = 0.35;   // [s]

  double blob_jump = 0.25;       // [m]
  double blob_min_chord = 0.12;  // [m]
  double blob_max_chord = 1.0;   // [m]
  int blob_min_beams = 3;        // [-]

  int max_tracks = 64;              // [-]
  double track_gate = 0.3;          // [m]
  double track_top_speed = 3.0;     // [m/s]
  double track_memory = 0.6;        // [s]
  double track_noise = 0.06;        // [m]
  double track_acceleration = 2.0;  // [m/s^2]

  double moving_window = 0.8;         // [s]
  double moving_displacement = 0.08;  // [m]
  double moving_speed = 0.2;          // [m/s]
  int moving_observations = 3;        // [-]
  int moving_evidence = 4;            // [-]
  double moving_margin = 0.12;        // [m]
  double moving_resolution = 0.07;    // [m]
  double odometry_error = 0.05;       // [-]
  double moving_hold = 3.0;           // [s]

  double undecided_time = 0.4;     // [s]
  double transient_margin = 0.25;  // [m]

  template <class Visitor>
  void visit(Visitor& v) {
    visitScan(v);
    visitBlobs(v);
    visitTracks(v);
  }

 private:
  template <class Visitor>
  void visitScan(Visitor& v) {
    v.integer("bins", bins, "-", 36, 3600, "bearing bins of the obstacle scan");
    v.number("max_range", max_range, "m", 0.5, 100.0, "farther returns count as free space up to here");
    v.number("min_range", min_range, "m", 0.0, 5.0, "nearer returns of a spatial lidar are dropped");
    v.number("min_height", min_height, "m", 0.0, 2.0, "lower returns are floor");
    v.number("max_height", max_height, "m", 0.1, 5.0, "higher returns are passed under");
    v.number("self_margin", self_margin, "m", 0.0, 0.5, "returns this close to the footprint are of the robot itself");
    v.number("cloud_view", cloud_view, "rad", 0.1, 6.2832, "width of a spatial lidar's view, centred on its x axis");
    v.number("max_duration", max_duration, "s", 0.01, 1.0, "longest scan, and latest time of a point in a cloud");
    v.integer("max_beams", max_beams, "-", 1, 1000000, "a planar scan with more beams is malformed");
    v.integer("max_points", max_points, "-", 100, 1000000, "of larger clouds every n-th point is used");
    v.number("voxel_size", voxel_size, "m", 0.02, 1.0, "cell of the voxel grid that thins the points");
    v.number("outlier_distance", outlier_distance, "m", 0.0, 1.0, "a return is alone without another this near");
    v.number("outlier_memory", outlier_memory, "s", 0.0, 1.0, "a lone return is kept if it was seen this recently too");
  }

  template <class Visitor>
  void visitBlobs(Visitor& v) {
    v.number("blob_jump", blob_jump, "m", 0.05, 1.0, "how far a blob stands off from what is behind it");
    v.number("blob_min_chord", blob_min_chord, "m", 0.02, 1.0, "narrowest blob");
    v.number("blob_max_chord", blob_max_chord, "m", 0.1, 3.0, "widest blob");
    v.integer("blob_min_beams", blob_min_beams, "-", 1, 100, "fewest beams on a blob");
  }

  template <class Visitor>
  void visitTracks(Visitor& v) {
    v.integer("max_tracks", max_tracks, "-", 1, 1000, "when full, new blobs are not followed");
    v.number("track_gate", track_gate, "m", 0.05, 2.0, "a blob this near the predicted place may be the same thing");
    v.number("track_top_speed", track_top_speed, "m/s", 0.1, 20.0, "widens the gate by the time since the last sight");
    v.number("track_memory", track_memory, "s", 0.0, 5.0, "a track not seen for so long is forgotten");
    v.number("track_noise", track_noise, "m", 0.005, 1.0, "standard deviation of a blob's middle");
    v.number("track_acceleration", track_acceleration, "m/s^2", 0.1, 20.0, "standard deviation of the acceleration");
    v.number("moving_window", moving_window, "s", 0.1, 3.0, "motion is judged against earlier sights within this time");
    v.number("moving_displacement", moving_displacement, "m", 0.02, 2.0, "what moves is this far from that sight");
    v.number("moving_speed", moving_speed, "m/s", 0.05, 5.0, "what moves is at least this fast");
    v.integer("moving_observations", moving_observations, "-", 2, 100, "what moves was seen this often");
    v.integer("moving_evidence", moving_evidence, "-", 1, 100, "points on it in space seen through, then or now");
    v.number("moving_margin", moving_margin, "m", 0.02, 1.0, "a point is seen through if the view goes on this far");
    v.number("moving_resolution", moving_resolution, "m", 0.01, 1.0, "no judgement where beams lie farther apart");
    v.number("odometry_error", odometry_error, "-", 0.0, 0.5, "odometry's error per metre and radian");
    v.number("moving_hold", moving_hold, "s", 0.0, 60.0, "what stopped counts as moving for so long");
    v.number("undecided_time", undecided_time, "s", 0.0, 5.0, "a new track is kept off the map for so long");
    v.number("transient_margin", transient_margin, "m", 0.0, 1.0, "returns this near a moving track belong to it");
  }
};

}  // namespace parley
