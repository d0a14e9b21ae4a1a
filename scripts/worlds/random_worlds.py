# SPDX-License-Identifier: BSD-3-Clause
"""Worlds of 40 x 40 m that nobody drew, for eight robots that cross: `make_worlds FOLDER --random N`.

aisles: a solid middle with three to five aisles through it, others that are dead ends, and cross ways
rooms:  walls that split the middle again and again, with doors of 1.1 to 2 m and boxes
blocks: rows of blocks with streets of 1.2 to 2 m between them
"""
import random

import cv2
import numpy as np

from worlds.drawing import FREE
from worlds.files import Scenario, World, draw

SIZE = 40.0  # [m]
FRAME = f'size {SIZE:g} {SIZE:g}\nwall 0.3  0.15 0.15  39.85 0.15  39.85 39.85  0.15 39.85  0.15 0.15\n'
ROOM = 1.0  # [m] round starts and goals
PASSAGE = 0.5  # [m] radius of the disc that gets from every start to every goal
APART = 2.5  # [m] between starts, and between goals, of one side
TRIES = 200


def shape(kind, *values):
    """A line of a drawing."""
    return f'{kind} ' + ' '.join(f'{value:.2f}' for value in values)


def aisles(rng):
    """A solid middle with ways through it, and halves of ways that look the same."""
    west, east = 13.0, 27.0
    lines = [shape('solid', west, 0.3, east, 39.7)]
    ways, y = [], 1.0 + rng.uniform(1, 5)
    while y + 2.0 < 39.0:
        ways.append((y, rng.uniform(1.2, 2.0)))
        y += ways[-1][1] + rng.uniform(1, 5)
    through = rng.sample(ways, min(len(ways), rng.randint(3, 5)))
    for low, width in ways:
        depth = rng.uniform(5, 10)
        ends = (west, east) if (low, width) in through else rng.choice([(west, west + depth), (east - depth, east)])
        lines.append(shape('open', ends[0] - 0.1, low, ends[1] + 0.1, low + width))
    for _ in range(rng.randint(0, 2)):
        (low, _), (high, _) = sorted(rng.sample(through, 2))
        x = rng.uniform(west + 2, east - 4)
        lines.append(shape('open', x, low, x + rng.uniform(1.2, 1.8), high + 0.5))
    return lines + strewn(rng, 5, 12) + strewn(rng, 28, 35)


def strewn(rng, west, east):
    """Boxes, walls and bays between two x."""
    lines = []
    for _ in range(rng.randint(6, 11)):
        x, y = rng.uniform(west, east) - 0.5, rng.uniform(1, 34)
        width, height = rng.uniform(2, 4), rng.uniform(2, 5)
        kind = rng.choice(['box', 'wall', 'bay'])
        if kind == 'box':
            lines.append(shape('solid', x, y, x + rng.uniform(0.3, 1.2), y + rng.uniform(0.3, 1.2)))
        elif kind == 'wall':
            lines.append(shape('wall', 0.2, x, y, x, y + height))
        else:
            back, front = rng.choice([(x, x + width), (x + width, x)])
            lines.append(shape('wall', 0.2, front, y, back, y, back, y + height, front, y + height))
    return lines


def rooms(rng):
    """Rooms of all sizes behind rooms."""
    lines = []
    split(rng, lines, (5.0, 0.0, 35.0, 40.0), rng.randint(3, 4))
    for _ in range(20):
        x, y, side = rng.uniform(6, 33), rng.uniform(1, 38), rng.uniform(0.3, 1.0)
        lines.append(shape('solid', x, y, x + side, y + side))
    return lines


def split(rng, lines, area, depth):
    """A wall across an area with one to three doors, and the same for both of its parts."""
    west, south, east, north = area
    if depth == 0 or max(east - west, north - south) < 7.0:
        return
    upright = east - west > north - south
    low, high, begin, end = (west, east, south, north) if upright else (south, north, west, east)
    at = rng.uniform(low + 3, high - 3)
    lines.append(shape('wall', 0.2, *((at, begin, at, end) if upright else (begin, at, end, at))))
    for _ in range(1 + (rng.random() < 0.6) + (end - begin > 15.0)):
        width = rng.uniform(1.1, 2.0)
        door = rng.uniform(begin + 0.4, end - 0.4 - width)
        corners = (at - 0.15, door, at + 0.15, door + width) if upright else (door, at - 0.15, door + width, at + 0.15)
        lines.append(shape('open', *corners))
    parts = [(west, south, at, north), (at, south, east, north)] if upright else [(west, south, east, at), (west, at, east, north)]
    for part in parts:
        split(rng, lines, part, depth - 1)


def blocks(rng):
    """Streets between blocks; one in four of those across is closed."""
    lines, x = [], 8.0
    while x < 31.0:
        width, y = rng.uniform(2, 6), 0.3 + rng.uniform(0, 2)
        while y < 39.0:
            height = rng.uniform(2, 7)
            lines.append(shape('solid', x, y, min(x + width, 33.0), min(y + height, 39.7)))
            y += height + (0.0 if rng.random() < 0.25 else rng.uniform(1.2, 2.0))
        x += width + rng.uniform(1.2, 2.2)
    return lines


def places(rng, room, west, east, count):
    """Points between two x with room around, apart from each other; fewer than `count` if there is no more space."""
    found = []
    for _ in range(4000):
        x, y = rng.uniform(west, east), rng.uniform(1.5, SIZE - 1.5)
        apart = all((x - a) ** 2 + (y - b) ** 2 > APART ** 2 for a, b in found)
        if len(found) < count and apart and room[int((SIZE - y) / 0.05), int(x / 0.05)] > ROOM:
            found.append((x, y))
    return found


def crossing(rng, world):
    """The world with four robots from each side, or None if there is no room or no way."""
    image = draw(world)
    room = 0.05 * cv2.distanceTransform((image == FREE).astype(np.uint8), cv2.DIST_L2, 5)
    left, right = places(rng, room, 1.5, 4.0, 8), places(rng, room, 36.0, 38.5, 8)
    _, parts = cv2.connectedComponents((room > PASSAGE).astype(np.uint8))
    if len(left) < 8 or len(right) < 8:
        return None
    if len({parts[int((SIZE - y) / 0.05), int(x / 0.05)] for x, y in left + right}) != 1:
        return None
    ways = list(zip(left[:4] + right[:4], right[4:] + left[4:]))
    lines = [shape(f'robot_{i + 1}', *start, *goal) for i, (start, goal) in enumerate(ways)]
    return world._replace(robots='\n'.join(lines))


def random_worlds(count, seed):
    """`count` worlds of each kind and a scenario for each; same seed, same worlds."""
    found = []
    for name, make in (('aisles', aisles), ('rooms', rooms), ('blocks', blocks)):
        rng = random.Random(f'{name} {seed}')
        made = 0
        for _ in range(TRIES * count):
            if made == count:
                break
            world = crossing(rng, World(f'{name}_{made + 1}', FRAME + '\n'.join(make(rng)), resolution=0.05))
            if world is not None:
                found.append(world)
                made += 1
    comment = 'Eight robots cross a world that nobody drew.'
    return found, [Scenario(world.name, world.name, comment, 300, world.robots) for world in found]

