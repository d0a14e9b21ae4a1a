#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The worlds and scenarios of maps/ are what they promise; shares no code with what draws them."""
import filecmp
import glob
import heapq
import math
import os
import subprocess
import tempfile
import unittest

import cv2
import numpy as np
import yaml

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..', '..'))
MAPS = os.path.join(ROOT, 'maps')
BUILDINGS = ('scenario_a', 'scenario_b', 'scenario_c')
UNREACHABLE = ('blocked',)
STEPS = [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)]

NUMBER = (int, float)
ROBOT_PARTS = {
    'footprint': {'length', 'width'},
    'limits': {'speed', 'turn_rate', 'acceleration', 'turn_acceleration'},
    'lidar': {'range', 'beams', 'rate', 'noise', 'mode', 'pose'},
    'odometry': {'rate', 'translation_noise', 'rotation_noise'},
    'clock': {'offset', 'drift'},
    'radio': {'range', 'success_rate', 'latency', 'jitter', 'bandwidth', 'line_of_sight'},
}
SCENARIO_KEYS = {'map', 'duration', 'robots', 'seed', 'goal_tolerance', 'judge', 'events', 'obstacles'} | set(ROBOT_PARTS)
EVENT_KEYS = ({'kill'}, {'stall', 'for'}, {'mute', 'for'}, {'blind', 'for'}, {'join'}, {'door', 'state'})


class World:
    """A map_server map: `clearance` is the distance [m] of each pixel's centre to the nearest solid pixel's edge."""

    def __init__(self, path):
        with open(path) as file:
            self.description = yaml.safe_load(file)
        self.resolution = self.description['resolution']
        self.image_path = os.path.join(os.path.dirname(path), self.description['image'])
        self.image = cv2.imread(self.image_path, cv2.IMREAD_UNCHANGED)
        self.free = (255 - self.image.astype(int)) / 255.0 < self.description['free_thresh']
        self.clearance = distance(self.free, self.resolution)

    def pixel(self, x, y):
        """Row and column of a point [m]."""
        return self.free.shape[0] - 1 - int(y // self.resolution), int(x // self.resolution)

    def connected(self, radius, start, goal):
        """Whether a disc of the radius [m] gets from start to goal [m]."""
        _, labels = cv2.connectedComponents((self.clearance >= radius).astype(np.uint8), connectivity=8)
        first, second = labels[self.pixel(*start)], labels[self.pixel(*goal)]
        return first > 0 and first == second

    def coarse(self, factor):
        """The least clearance [m] of each block of factor x factor pixels."""
        rows, columns = (size // factor * factor for size in self.free.shape)
        blocks = self.clearance[:rows, :columns].reshape(rows // factor, factor, columns // factor, factor)
        return blocks.min(axis=(1, 3))


def distance(free, resolution):
    """Distance [m] of each free pixel's centre to the edge of the nearest solid pixel; solid outside."""
    padded = np.pad(free.astype(np.uint8), 1)
    pixels = cv2.distanceTransform(padded, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)[1:-1, 1:-1]
    return np.maximum(pixels - 0.5, 0.0) * resolution


def load(path):
    with open(path) as file:
        return yaml.safe_load(file)


def named(folder=''):
    """(name, path) of each YAML file in maps/ or below."""
    paths = sorted(glob.glob(os.path.join(MAPS, folder, '*.yaml')))
    return [(os.path.splitext(os.path.basename(path))[0], path) for path in paths]


def footprint(scenario, robot, margin):
    """The footprint at the start, grown by the margin [m], as a rotated rectangle of OpenCV [m] [deg]."""
    size = {'length': 0.8, 'width': 0.4, **scenario.get('footprint', {}), **robot.get('footprint', {})}
    x, y, yaw = robot['start']
    return (x, y), (size['length'] + 2 * margin, size['width'] + 2 * margin), math.degrees(yaw)


def is_free(world, rectangle):
    """Whether a rotated rectangle covers nothing solid."""
    (x, y), size, angle = rectangle
    row, column = world.pixel(x, y)
    outline = cv2.boxPoints(((column, row), tuple(side / world.resolution for side in size), -angle))
    covered = cv2.fillPoly(np.zeros(world.free.shape, np.uint8), [outline.round().astype(np.int32)], 1)
    return not (covered.astype(bool) & ~world.free).any()


def way_lengths(passable, goal):
    """Length [cells] of the shortest way on 8 neighbours from each passable cell to the goal cell."""
    lengths = np.full(passable.shape, np.inf)
    lengths[goal] = 0.0
    queue = [(0.0, goal)]
    while queue:
        length, (row, column) = heapq.heappop(queue)
        if length > lengths[row, column]:
            continue
        for down, right in STEPS:
            cell = (row + down, column + right)
            farther = length + math.hypot(down, right)
            if passable[cell] and farther < lengths[cell]:
                lengths[cell] = farther
                heapq.heappush(queue, (farther, cell))
    return lengths


def widest_way(clearance):
    """Least clearance [m] on the way from the first to the last column that keeps it greatest, and the cell where it is."""
    best = np.zeros(clearance.shape)
    queue = [(-clearance[row, 0], (row, 0), (row, 0)) for row in range(clearance.shape[0])]
    heapq.heapify(queue)
    while queue:
        width, cell, narrowest = heapq.heappop(queue)
        if cell[1] == clearance.shape[1] - 1:
            return -width, narrowest
        for down, right in STEPS:
            row, column = cell[0] + down, cell[1] + right
            if not (0 <= row < clearance.shape[0] and 0 <= column < clearance.shape[1]):
                continue
            narrower = min(-width, clearance[row, column])
            if narrower > best[row, column]:
                best[row, column] = narrower
                heapq.heappush(queue, (-narrower, (row, column), (row, column) if narrower < -width else narrowest))
    return 0.0, (0, 0)


def ways_across(world, x1, x2, least):
    """Widths [m] of the ways from x1 to x2 [m] that are at least so wide; each is plugged before the next is looked for."""
    columns = slice(int(x1 / world.resolution), int(x2 / world.resolution))
    free = world.free.copy()
    widths = []
    while True:
        radius, (row, column) = widest_way(distance(free, world.resolution)[:, columns])
        if 2 * radius < least:
            return widths
        widths.append(2 * radius)
        plug = int((radius + 0.15) / world.resolution)
        free = cv2.circle(free.astype(np.uint8), (column + columns.start, row), plug, 0, -1) > 0


def large_walls(world, size):
    """Mask of solid parts whose bounding box is at least `size` [m] wide or high."""
    _, labels, stats, _ = cv2.connectedComponentsWithStats((~world.free).astype(np.uint8), connectivity=8)
    longest = stats[:, cv2.CC_STAT_WIDTH:cv2.CC_STAT_HEIGHT + 1].max(axis=1) * world.resolution
    large = longest >= size
    large[0] = False
    return large[labels]


def trap_cost(world, start, goal):
    """What the worst dead end on the straight line costs [m]: the way in and the longer way from there, on a map known in whole."""
    cell = 4 * world.resolution
    lengths = way_lengths(world.coarse(4) >= 0.25, (world.free.shape[0] // 4 - 1 - int(goal[1] / cell), int(goal[0] / cell))) * cell
    walls = large_walls(world, 3.0)
    worst, best, travelled = 0.0, (math.inf, 0.0), 0.0
    for step in np.arange(0.0, math.dist(start, goal), 0.1):
        x, y = (a + (b - a) * step / math.dist(start, goal) for a, b in zip(start, goal))
        row, column = world.pixel(x, y)
        travelled += 0.1
        if walls[row, column]:
            best = (math.inf, 0.0)
        elif np.isfinite(lengths[row // 4, column // 4]):
            best = min(best, (lengths[row // 4, column // 4], travelled))
            worst = max(worst, lengths[row // 4, column // 4] - best[0] + travelled - best[1])
    return worst


class WorldsTest(unittest.TestCase):
    def test_map_files(self):
        for name, path in named():
            with self.subTest(world=name):
                world = World(path)
                self.assertEqual(set(world.description), {'image', 'resolution', 'origin', 'negate', 'occupied_thresh', 'free_thresh'})
                self.assertEqual(world.description['origin'], [0, 0, 0])
                self.assertLess(os.path.getsize(world.image_path), 200000)
                self.assertEqual(set(np.unique(world.image)), {0, 254})
                edge = np.concatenate([world.free[0], world.free[-1], world.free[:, 0], world.free[:, -1]])
                self.assertFalse(edge.any(), 'the edge is solid')

    def test_gaps_are_open_or_closed(self):
        """Nothing is between 0.4 and 0.85 m wide: a place that a disc of 0.4 m reaches is covered by one of 0.85 m."""
        for name, path in named():
            with self.subTest(world=name):
                world = World(path)
                beyond = cv2.distanceTransform((world.clearance < 0.425).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
                narrow = (world.clearance > 0.2) & (beyond * world.resolution > 0.425 + world.resolution)
                self.assertEqual([(c * world.resolution, (narrow.shape[0] - r) * world.resolution) for r, c in np.argwhere(narrow)[:3]], [])

    def test_nominal_widths(self):
        for name, path in named():
            kind, _, nominal = name.rpartition('_')
            if kind in ('corridor', 'doorway'):
                with self.subTest(world=name):
                    width, _ = widest_way(World(path).clearance[:, 60:-60])
                    self.assertAlmostEqual(2 * width, float(nominal), delta=0.06)

    def test_ways_across_the_buildings(self):
        for name in BUILDINGS:
            with self.subTest(world=name):
                widths = ways_across(World(os.path.join(MAPS, name + '.yaml')), 12.0, 28.0, 1.15)
                self.assertGreaterEqual(len(widths), 3)
                self.assertLess(max(widths), 2.05)

    def test_reproducible(self):
        script = os.path.join(ROOT, 'scripts', 'make_worlds')
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([script, folder], check=True)
            for path in glob.glob(MAPS + '/**/*.*', recursive=True):
                made = os.path.join(folder, os.path.relpath(path, MAPS))
                if path.endswith('.png'):
                    self.assertTrue(np.array_equal(cv2.imread(path, 0), cv2.imread(made, 0)), path)
                elif path.endswith('.yaml'):
                    self.assertTrue(filecmp.cmp(path, made, shallow=False), path)


class RandomWorldsTest(unittest.TestCase):
    @staticmethod
    def make(folder, seed):
        script = os.path.join(ROOT, 'scripts', 'make_worlds')
        subprocess.run([script, folder, '--random', '1', '--seed', str(seed)], check=True)
        return {name: load(os.path.join(folder, 'scenarios', name + '.yaml')) for name in ('aisles_1', 'blocks_1', 'rooms_1')}

    def test_every_goal_can_be_reached(self):
        for seed in (1, 2, 3):
            with tempfile.TemporaryDirectory() as folder:
                for name, scenario in self.make(folder, seed).items():
                    world = World(os.path.join(folder, 'scenarios', scenario['map']))
                    self.assertEqual(len(scenario['robots']), 8)
                    for robot in scenario['robots']:
                        self.assertTrue(world.connected(0.4, robot['start'][:2], robot['goal']), (seed, name, robot['name']))

    def test_follow_from_the_seed(self):
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as same, tempfile.TemporaryDirectory() as other:
            self.assertEqual(self.make(one, 1), self.make(same, 1))
            self.assertNotEqual(self.make(one, 1), self.make(other, 2))
            for path in glob.glob(one + '/*.png'):
                made = os.path.join(same, os.path.basename(path))
                self.assertTrue(np.array_equal(cv2.imread(path, 0), cv2.imread(made, 0)), path)


class ScenariosTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenarios = []
        for name, path in named('scenarios'):
            scenario = load(path)
            cls.scenarios.append((name, scenario, World(os.path.join(os.path.dirname(path), scenario['map']))))

    def for_each(self, check):
        for name, scenario, world in self.scenarios:
            with self.subTest(scenario=name):
                check(name, scenario, world)

    def test_format(self):
        self.for_each(self.check_format)

    def test_starts_are_clear(self):
        self.for_each(self.check_starts)

    def test_goals_are_reachable(self):
        self.for_each(self.check_goals)

    def test_straight_lines_lead_into_traps(self):
        self.for_each(self.check_traps)

    def check_format(self, _, scenario, world):
        self.assertLessEqual(set(scenario), SCENARIO_KEYS)
        self.assertGreater(scenario['duration'], 0)
        names = [robot['name'] for robot in scenario['robots']]
        self.assertEqual(len(names), len(set(names)))
        for robot in scenario['robots']:
            self.assertLessEqual({'name', 'start', 'goal'}, set(robot))
            self.assertLessEqual(set(robot), {'name', 'start', 'goal'} | set(ROBOT_PARTS))
            self.assertEqual((len(robot['start']), len(robot['goal'])), (3, 2))
            self.assertTrue(all(isinstance(value, NUMBER) for value in robot['start'] + robot['goal']))
        for part, keys in ROBOT_PARTS.items():
            for holder in [scenario] + scenario['robots']:
                self.assertLessEqual(set(holder.get(part, {})), keys)
        self.check_events(scenario, names, world)
        self.check_obstacles(scenario, world)

    def check_events(self, scenario, names, world):
        for event in scenario.get('events', []):
            self.assertIn(set(event) - {'time'}, EVENT_KEYS)
            self.assertLess(event['time'], scenario['duration'])
            for verb in {'kill', 'stall', 'mute', 'blind', 'join'} & set(event):
                self.assertIn(event[verb], names)
            if 'door' in event:
                self.assertIn(event['state'], ('open', 'closed'))
                middle = np.mean(event['door'], axis=0)
                self.assertTrue(world.free[world.pixel(*middle)], 'a door stands in an opening')

    def check_obstacles(self, scenario, world):
        for obstacle in scenario.get('obstacles', []):
            self.assertLessEqual(set(obstacle), {'radius', 'speed', 'path'})
            for (x1, y1), (x2, y2) in zip(obstacle['path'], obstacle['path'][1:]):
                for share in np.linspace(0, 1, 100):
                    at = world.pixel(x1 + (x2 - x1) * share, y1 + (y2 - y1) * share)
                    self.assertGreater(world.clearance[at], obstacle['radius'] + 0.05)

    def check_starts(self, _, scenario, world):
        for index, robot in enumerate(scenario['robots']):
            grown = footprint(scenario, robot, 0.15)
            self.assertTrue(is_free(world, grown), robot['name'] + ' starts clear of walls')
            for other in scenario['robots'][:index]:
                meeting, _ = cv2.rotatedRectangleIntersection(grown, footprint(scenario, other, 0.0))
                self.assertEqual(meeting, cv2.INTERSECT_NONE, f"{robot['name']} and {other['name']} start apart")

    def check_goals(self, name, scenario, world):
        for robot in scenario['robots']:
            for radius in (0.25, 0.35):
                reachable = world.connected(radius, robot['start'][:2], robot['goal'])
                self.assertEqual(reachable, name not in UNREACHABLE, f"{robot['name']} as a disc of {radius} m")

    def check_traps(self, name, scenario, world):
        if name in BUILDINGS + ('u_trap',):
            costs = [trap_cost(world, robot['start'][:2], robot['goal']) for robot in scenario['robots']]
            self.assertGreaterEqual(sum(cost > 7.5 for cost in costs), 0.6 * len(costs), costs)


if __name__ == '__main__':
    unittest.main()
