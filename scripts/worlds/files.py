# SPDX-License-Identifier: BSD-3-Clause
"""Worlds and scenarios as plain data, and the files that hold them."""
import math
import os
from collections import namedtuple

import cv2
import numpy as np

from worlds.drawing import FREE, SOLID, Drawing

# drawing: text as in drawing.py; robots: text as in parse_robots, whose places clutter keeps clear; resolution [m/px];
# hollow: closed rooms stay free inside
World = namedtuple('World', 'name drawing robots resolution hollow', defaults=('', 0.05, False))
# comment: one line on what it tests; duration [s]; more: YAML lines that follow the robots
Scenario = namedtuple('Scenario', 'name world comment duration robots more', defaults=('',))


def parse_robots(text):
    """Lines of `name x y goal_x goal_y [yaw]` [m] [deg] as tuples (name, start with yaw [rad], goal)."""
    robots = []
    for words in (line.split() for line in text.splitlines() if line.strip()):
        x, y, goal_x, goal_y = map(float, words[1:5])
        yaw = math.radians(float(words[5])) if len(words) > 5 else math.atan2(goal_y - y, goal_x - x)
        robots.append((words[0], (x, y, round(yaw, 2)), (goal_x, goal_y)))
    return robots


def draw(world):
    """The picture of a world; unless it is hollow, space cut off from its largest free part becomes solid."""
    places = [place for _, start, goal in parse_robots(world.robots) for place in (start[:2], goal)]
    image = Drawing(world.drawing, world.resolution, places).image
    if world.hollow:
        return image
    _, labels, stats, _ = cv2.connectedComponentsWithStats((image == FREE).astype(np.uint8), connectivity=4)
    largest = 1 + int(np.argmax(stats[1:, cv2.CC_STAT_AREA]))
    image[labels != largest] = SOLID
    return image


def write_world(world, folder):
    """Writes <name>.png and <name>.yaml for map_server."""
    stem = os.path.join(folder, world.name)
    cv2.imwrite(stem + '.png', draw(world), [cv2.IMWRITE_PNG_COMPRESSION, 9])
    with open(stem + '.yaml', 'w') as out:
        out.write(f'image: {world.name}.png\nresolution: {world.resolution}\norigin: [0.0, 0.0, 0.0]\n'
                  'negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n')


def write_scenario(scenario, folder):
    """Writes <name>.yaml; the map lies in the folder above."""
    lines = [f'# {scenario.comment}', f'map: ../{scenario.world}.yaml', f'duration: {scenario.duration}', 'robots:']
    for name, start, goal in parse_robots(scenario.robots):
        numbers = (', '.join(f'{value:g}' for value in values) for values in (start, goal))
        lines.append('  - {{name: {}, start: [{}], goal: [{}]}}'.format(name, *numbers))
    lines += scenario.more.strip('\n').splitlines()
    with open(os.path.join(folder, scenario.name + '.yaml'), 'w') as out:
        out.write('\n'.join(lines) + '\n')
