# SPDX-License-Identifier: BSD-3-Clause
"""Scenario B: a warehouse; three aisles lead through the racks, others end in them, and the docks on both sides are combs of bays."""
from worlds.files import Scenario, World

DRAWING = """
size 40 40
wall 0.3  0.15 0.15  39.85 0.15  39.85 39.85  0.15 39.85  0.15 0.15

# three aisles through the middle: 1.5, 1.8 and 1.3 m wide
wall 0.2  13.5 0.3  13.5 4.3  26.5 4.3  26.5 0.3
wall 0.2  13.5 6.0  26.5 6.0
wall 0.2  13.5 18.7  20.7 18.7  20.7 22.1  26.5 22.1
wall 0.2  13.5 20.7  18.7 20.7  18.7 24.1  26.5 24.1
wall 0.2  13.5 34.5  26.5 34.5
wall 0.2  13.5 39.7  13.5 36.0  26.5 36.0  26.5 39.7

# storage halls: two open to the west, two to the east
wall 0.2  13.5 6.0  13.5 7.3  21.1 7.3  21.1 11.9  13.5 11.9  13.5 18.7
wall 0.2  26.5 6.0  26.5 11.9  18.9 11.9  18.9 16.7  26.5 16.7  26.5 22.1
wall 0.2  13.5 20.7  13.5 26.1  20.9 26.1  20.9 31.7  13.5 31.7  13.5 34.5
wall 0.2  26.5 24.1  26.5 25.9  22.1 25.9  22.1 31.7  26.5 31.7  26.5 34.5
solid 15.4  9.1  19.4  9.9
solid 20.6 14.0  24.6 14.8
solid 15.4 28.6  19.2 29.4

# rooms along the aisles
wall 0.2  18.0 0.3  18.0 4.3
wall 0.2  22.4 0.3  22.4 4.3
open  15.2  4.1  16.3  4.5
open  19.6  4.1  20.7  4.5
open  23.8  4.1  24.9  4.5
open  22.6  5.8  23.7  6.2
open  14.8 18.5  15.9 18.9
open  15.0 20.5  16.1 20.9
wall 0.2  17.8 31.7  17.8 34.5
wall 0.2  22.2 31.7  22.2 34.5
open  15.2 34.3  16.3 34.7
open  19.4 34.3  20.5 34.7
wall 0.2  20.0 36.0  20.0 39.7
open  23.8 34.3  24.9 34.7
open  17.0 35.8  18.1 36.2
open  23.0 35.8  24.1 36.2

# docks: combs of bays
wall 0.2  11.0 8.6  6.0 8.6  6.0 21.8  11.0 21.8
wall 0.2  11.0 15.2  6.0 15.2
wall 0.2  11.6 26.0  5.2 26.0  5.2 34.0  11.6 34.0
wall 0.2  29.0 6.0  34.6 6.0  34.6 14.0  29.0 14.0
wall 0.2  28.8 19.0  34.0 19.0  34.0 33.4  28.8 33.4
wall 0.2  28.8 26.2  34.0 26.2

# stores in the corners and racks
solid  4.0  1.8   8.0  2.6
solid  4.0  4.4   8.0  5.2
solid  9.8  1.8  11.8  2.6
solid  9.8  4.4  11.8  5.2
solid 29.0 35.2  33.0 36.0
solid 29.0 37.6  33.0 38.4
solid 34.6 35.2  36.6 36.0
solid 34.6 37.6  36.6 38.4
pillar  8.5 18.5 0.5
pillar  8.5 12.0 0.5
pillar 31.5 22.6 0.5
pillar 31.5 29.8 0.5

clutter 22 6 1.3  6 9  12.5 21
clutter 23 4 1.3  3 22  12.5 26
clutter 24 5 1.3  5.4 26.5  12 33.5
clutter 25 6 1.3  2 34  12.5 39.5
clutter 26 6 1.3  27.5 0.5  39 6
clutter 27 4 1.3  28 6.5  34 13.5
clutter 28 6 1.3  27.5 14  39 19
clutter 29 7 1.3  28 19.5  33.5 33
"""

ROBOTS = """\
robot_1  2.5  5.5  37.4  9.5
robot_2  2.5 15.5  37.4 27.5
robot_3  2.5 24.0  37.4 20.5
robot_4  2.5 33.0  37.4 34.5
robot_5 37.4  4.0   2.5 30.0
robot_6 37.4 12.0   2.5  9.5
robot_7 37.4 24.0   2.5 36.0
robot_8 37.4 31.0   2.5 18.5
"""

WORLDS = [World('scenario_b', DRAWING, ROBOTS)]
SCENARIOS = [
    Scenario('scenario_b', 'scenario_b', 'Eight robots cross a warehouse: three narrow aisles through the racks, dead ends in racks and docks.',
             300, ROBOTS),
]
