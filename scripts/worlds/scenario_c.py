# SPDX-License-Identifier: BSD-3-Clause
"""Scenario C: a museum; a ring around a rotunda and two galleries lead across, chapels and apses are dead ends."""
from worlds.files import Scenario, World

DRAWING = """
size 40 40
wall 0.3  0.15 0.15  39.85 0.15  39.85 39.85  0.15 39.85  0.15 0.15

# the rotunda: a ring 1.6 m wide around a core with two chapels, and passages north and south
arc  0.3  20 20  6.75   12  84
arc  0.3  20 20  6.75   96 168
arc  0.3  20 20  6.75  192 264
arc  0.3  20 20  6.75  276 348
arc  0.3  20 20  4.85   24 156
arc  0.3  20 20  4.85  204 336
wall 0.3  20 15.2  20 24.8
wall 0.2  19.25 26.7  19.25 30.9
wall 0.2  20.75 26.7  20.75 30.9
wall 0.2  19.25 13.3  19.25  8.9
wall 0.2  20.75 13.3  20.75  8.9

# north gallery, 1.4 m wide, and south gallery, 1.8 m wide
wall 0.2  13.5 30.9  19.25 30.9
wall 0.2  20.75 30.9  26.5 30.9
wall 0.2  13.5 39.7  13.5 32.5  26.5 32.5  26.5 39.7
wall 0.2  13.5 8.9  19.25 8.9
wall 0.2  20.75 8.9  26.5 8.9
wall 0.2  13.5 0.3  13.5 6.9  26.5 6.9  26.5 0.3
wall 0.2  18.0 32.5  18.0 39.7
wall 0.2  22.4 32.5  22.4 39.7
wall 0.2  18.8 6.9  18.8 0.3
open  15.2 32.3  16.3 32.7
open  19.8 32.3  20.9 32.7
open  24.0 32.3  25.1 32.7
open  15.6  6.7  16.7  7.1
open  22.4  6.7  23.5  7.1

# chapels of the wings
wall 0.2  13.5 30.9  13.5 22.3
wall 0.2  13.5 17.7  13.5  8.9
wall 0.2  26.5 30.9  26.5 22.3
wall 0.2  26.5 17.7  26.5  8.9

# apses: dead ends that are open to the middle
arc  0.2   9.0 11.0 5.2  90 270
wall 0.2   9.0 16.2 11.6 16.2
wall 0.2   9.0  5.8 11.6  5.8
arc  0.2   9.0 29.2 5.2  90 270
wall 0.2   9.0 34.4 11.4 34.4
wall 0.2   9.0 24.0 11.4 24.0
arc  0.2  31.0 28.8 5.2 -90  90
wall 0.2  31.0 34.0 28.4 34.0
wall 0.2  31.0 23.6 28.4 23.6
arc  0.2  31.2  9.4 5.0 -90  90
wall 0.2  31.2 14.4 28.6 14.4
wall 0.2  31.2  4.4 28.6  4.4
wall 0.2  29.4 15.8 32.8 19.2 30.2 21.8

clutter 31 6 1.3  1 0.5  12.5 5.4
clutter 32 3 1.3  5 7  12 15
clutter 33 7 1.3  3 16  13 24.5
clutter 34 3 1.3  5 25.5  12 33.5
clutter 35 6 1.3  2 35  12.5 39.5
clutter 36 6 1.3  27.5 34.6  38 39.5
clutter 37 3 1.3  28 24.5  35 32.5
clutter 38 5 1.3  27.5 14.5  38 23.5
clutter 39 3 1.3  28 5.5  35 13.5
clutter 40 6 1.3  27.5 0.5  38 4.2
"""

ROBOTS = """\
robot_1  2.5  5.5  37.4 28.0
robot_2  2.5 15.5  37.4  9.5
robot_3  2.5 24.0  37.4 34.5
robot_4  2.5 33.0  37.4 20.5
robot_5 37.4  4.0   2.5 19.0
robot_6 37.4 12.0   2.5 11.0
robot_7 37.4 23.5   2.5 36.0
robot_8 37.4 31.0   2.5 30.0
"""

WORLDS = [World('scenario_c', DRAWING, ROBOTS)]
SCENARIOS = [
    Scenario('scenario_c', 'scenario_c', 'Eight robots cross a museum: a ring around a rotunda, two galleries, apses that are dead ends.', 300, ROBOTS),
]
