# SPDX-License-Identifier: BSD-3-Clause
"""Scenario A: an office wing with three corridors; halls on both sides face the traffic with open fronts."""
from worlds.files import Scenario, World

DRAWING = """
size 40 40
wall 0.3  0.15 0.15  39.85 0.15  39.85 39.85  0.15 39.85  0.15 0.15

# the middle wing: offices around three corridors, 1.8, 1.4 and 1.6 m wide
wall 0.2  14 8.1  14 0.3
wall 0.2  26 8.1  26 0.3
wall 0.2  14 8.1  26 8.1
wall 0.2  20 8.1  20 0.3
open  16.5 7.9  17.6 8.3
open  23.0 7.9  24.1 8.3
wall 0.2  14 10.1  26 10.1
wall 0.2  14 19.2  26 19.2
wall 0.2  17.0 10.1  17.0 19.2
wall 0.2  19.2 10.1  19.2 19.2
wall 0.2  20.8 10.1  20.8 19.2
open  19.3 9.9  20.7 19.4
wall 0.2  14 20.8  26 20.8
wall 0.2  14 30.0  26 30.0
wall 0.2  14 20.8  14 30.0
wall 0.2  26 20.8  26 30.0
wall 0.2  14 25.4  26 25.4
wall 0.2  20 20.8  20 30.0
open  16.4 20.6  17.5 21.0
open  22.4 29.8  23.5 30.2
open  22.4 25.2  23.5 25.6
open  22.4 20.6  23.5 21.0
open  16.4 29.8  17.5 30.2
wall 0.2  14 31.8  26 31.8
wall 0.2  14 31.8  14 39.7
wall 0.2  26 31.8  26 39.7
wall 0.2  18 31.8  18 39.7
wall 0.2  22 31.8  22 39.7
open  15.5 31.6  16.6 32.0
open  19.5 31.6  20.6 32.0
open  23.5 31.6  24.6 32.0

# halls with open fronts
wall 0.2  11.6 4.6  5.0 4.6  5.0 13.8  11.6 13.8
wall 0.2  11.2 23.2  4.6 23.2  4.6 34.2  11.2 34.2
wall 0.2  28.6 5.0  35.2 5.0  35.2 15.0  28.6 15.0
wall 0.2  28.8 25.6  35.0 25.6  35.0 35.6  28.8 35.6

# columns of the halls and partitions
pillar  8.0  7.8 0.5
pillar  8.0 10.8 0.5
pillar  7.6 26.2 0.5
pillar  7.6 31.2 0.5
pillar 32.0  8.4 0.5
pillar 32.0 11.8 0.5
pillar 31.8 28.6 0.5
pillar 31.8 32.4 0.5
wall 0.15  4.4 17.0  4.4 18.6  6.4 18.6
wall 0.15 30.6 22.6 33.0 22.6
wall 0.15 30.6 18.4 30.6 20.2
wall 0.15  9.0 19.8 11.4 19.8
wall 0.15 16.2 23.2 17.6 23.2
wall 0.15 15.6 35.0 16.8 35.0
wall 0.15 23.6 35.4 24.6 35.4
wall 0.15 16.0  3.2 18.2  3.2
wall 0.15 22.0  4.6 22.0  2.6

# rooms at the outer walls
wall 0.2  30.4 39.7  30.4 37.2  33.6 37.2
wall 0.2   7.6  0.3   7.6  2.9  10.8  2.9

clutter 11 9 1.3  4 14.5  13 22.5
clutter 12 7 1.3  5.6 5  13 13
clutter 13 7 1.3  5 24  13 33.5
clutter 14 7 1.3  27 5.5  34.5 14.5
clutter 15 7 1.3  27 26  34.5 35
clutter 16 9 1.3  27 15.5  38 25
clutter 17 6 1.3  2 0.5  13 4
clutter 18 5 1.3  27 36  39 39.5
clutter 19 6 1.3  1 35  13 39.5
clutter 20 6 1.3  27 0.5  39 4.6
"""

ROBOTS = """\
robot_1  2.5  7.0  37.4 33.5
robot_2  2.5 13.0  37.4  9.5
robot_3  2.5 20.0  37.4 14.0
robot_4  2.5 30.0  37.4 29.0
robot_5 37.4  6.0   2.5  9.5
robot_6 37.4 12.5   2.5 28.5
robot_7 37.4 22.0   2.5 33.0
robot_8 37.4 33.0   2.5 19.0
"""

PEOPLE = """
obstacles:
  - {radius: 0.3, speed: 1.0, path: [[36.4, 15.7], [26.8, 18.9]]}
  - {radius: 0.3, speed: 0.8, path: [[30.3, 15.8], [29.2, 23.6]]}
  - {radius: 0.3, speed: 1.0, path: [[13.1, 22.6], [4.7, 22.1]]}
  - {radius: 0.3, speed: 1.2, path: [[6.1, 19.4], [13.3, 18.0]]}
  - {radius: 0.3, speed: 0.8, path: [[27.2, 31.0], [27.2, 36.0]]}
  - {radius: 0.3, speed: 1.2, path: [[12.6, 6.0], [12.6, 12.5]]}
"""

WORLDS = [World('scenario_a', DRAWING, ROBOTS)]
SCENARIOS = [
    Scenario('scenario_a', 'scenario_a', 'Eight robots cross an office wing with three corridors and four halls that are dead ends.', 300,
             ROBOTS),
    Scenario('scenario_a_solo', 'scenario_a', 'One robot alone in the building of scenario_a.', 300, ROBOTS.splitlines()[0]),
    Scenario('people', 'scenario_a', 'Eight robots cross the building of scenario_a while six people walk its halls.', 300, ROBOTS, PEOPLE),
]
