// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "parley_geometry/options.h"

namespace parley {

/// What the topology stage can be told.
struct TopologyOptions {
  double resolution = 0.05;    // [m]
  double extent = 300.0;       // [m]
  int hit_weight = 3;          // [-]
  int clear_weight = 1;        // [-]
  int evidence_limit = 15;     // [-]
  int occupied_above = 4;      // [-]
  int free_below = -2;         // [-]
  double clear_margin = 0.05;  // [m]

  double margin = 0.01;         // [m]
  double simplify = 0.04;       // [m]
  double max_edge = 30.0;       // [m]
  double clearance_cap = 1.5;   // [m]
  double layer_distance = 0.1;  // [m]

  std::string search = "astar";
  double unknown_cost = 1.3;     // [-]
  double narrow_width = 0.9;     // [m]
  double narrow_cost = 2.0;      // [-]
  double tentative_cost = 8.0;   // [-]
  double goal_tolerance = 0.3;   // [m]
  double start_tolerance = 0.6;  // [m]
  double switch_penalty = 1.0;   // [m]
  double switch_ratio = 0.05;    // [-]
  double class_tube = 2.0;       // [m]
  int max_expansions = 200000;   // [-]
  int max_flood = 20000000;      // [-]

  int max_tiles = 4096;           // [-]
  int max_vertices = 32768;       // [-]
  int max_pairs = 4000000;        // [-]
  int max_layers = 64;            // [-]
  int max_layer_contours = 4096;  // [-]
  int max_layer_cells = 200000;   // [-]

  template <class Visitor>
  void visit(Visitor& v) {
    v.number("resolution", resolution, "m", 0.02, 0.2, "side of a map cell");
    v.number("extent", extent, "m", 10.0, 2000.0, "what lies further than this from the odom origin in x or y is not mapped");
    v.integer("hit_weight", hit_weight, "-", 1, 20, "evidence a cell gains in a scan that hits it");
    v.integer("clear_weight", clear_weight, "-", 1, 20, "evidence a cell loses in a scan that sees through it");
    v.integer("evidence_limit", evidence_limit, "-", 2, 100, "evidence stays within plus and minus this");
    v.integer("occupied_above", occupied_above, "-", 0, 99, "a cell with more evidence than this is occupied");
    v.integer("free_below", free_below, "-", -99, 0, "an occupied cell is free again with less evidence than this");
    v.number("clear_margin", clear_margin, "m", 0.0, 0.5, "a ray clears up to this far short of its hit");
    v.number("margin", margin, "m", 0.0, 0.5,
             "room kept on top of the inscribed radius; a gap narrower than twice the sum is shut");
    v.number("simplify", simplify, "m", 0.005, 0.2, "tolerance of the Douglas-Peucker simplification of contours");
    v.number("max_edge", max_edge, "m", 2.0, 200.0,
             "longest edge between two corners; between corners at unseen space, and to start and goal, there is no limit");
    v.number("clearance_cap", clearance_cap, "m", 0.5, 10.0, "passages wider than this count as this wide");
    v.number("layer_distance", layer_distance, "m", 0.0, 0.5,
             "a peer's outline counts only this far away from what own sensing has seen");
    v.text("search", search, "astar or depth_first: how the graph is searched, both optimal on it");
    v.number("unknown_cost", unknown_cost, "-", 1.0, 10.0, "cost of a metre through space that was never seen");
    v.number("narrow_width", narrow_width, "m", 0.0, 5.0, "passages narrower than this are dearer");
    v.number("narrow_cost", narrow_cost, "-", 0.0, 50.0,
             "extra cost of a metre in a passage of no width, less in proportion up to narrow_width");
    v.number("tentative_cost", tentative_cost, "-", 0.0, 100.0,
             "extra cost of a metre within reach of an outline of a peer whose pose is tentative");
    v.number("goal_tolerance", goal_tolerance, "m", 0.0, 2.0, "a goal too close to an obstacle is moved at most this far");
    v.number("start_tolerance", start_tolerance, "m", 0.0, 2.0, "a start too close to an obstacle is moved at most this far");
    v.number("switch_penalty", switch_penalty, "m", 0.0, 50.0,
             "gain in cost below which the way around an obstacle is not changed");
    v.number("switch_ratio", switch_ratio, "-", 0.0, 1.0,
             "the same in proportion to the cost of the way committed to; both are added");
    v.number("class_tube", class_tube, "m", 0.5, 20.0, "how far from the committed route corners are looked for to mend it");
    v.integer("max_expansions", max_expansions, "-", 100, 100000000,
              "corners a depth-first search visits before it returns the best route so far");
    v.integer("max_flood", max_flood, "-", 0, 1000000000,
              "cells looked at to make sure that there is no way when the graph has none");
    v.integer("max_tiles", max_tiles, "-", 1, 100000, "tiles of 64 by 64 cells; space beyond them stays unknown");
    v.integer("max_vertices", max_vertices, "-", 16, 100000, "corners in the graph; later ones are left out");
    v.integer("max_pairs", max_pairs, "-", 64, 100000000, "pairs of corners watched for an edge; later ones are left out");
    v.integer("max_layers", max_layers, "-", 0, 1000, "origins whose outlines are held; later ones are refused");
    v.integer("max_layer_contours", max_layer_contours, "-", 1, 100000, "outlines held of one origin; the rest is left out");
    v.integer("max_layer_cells", max_layer_cells, "-", 100, 10000000,
              "cells that one origin's outlines may cover; the rest is left out");
  }
};

}  // namespace parley
