# SPDX-License-Identifier: BSD-3-Clause
"""Turns a drawing in text into a black and white picture of a world.

One shape a line, lengths in metres, x to the right and y up from the lower left corner, angles in degrees:

    size W H                        the world; must come first
    fill                            everything solid, to be opened up by `open`
    wall T X Y X Y [X Y ...]        a wall of thickness T along a polyline
    arc T X Y R A B                 a wall of thickness T along a circle around (X, Y) from angle A to B
    box X Y W H [ANGLE]             a solid rectangle around its centre
    solid X1 Y1 X2 Y2               a solid rectangle by two corners
    pillar X Y D                    a solid disc of diameter D
    open X1 Y1 X2 Y2                a rectangle without anything solid: a door, a corridor
    clutter SEED N GAP X1 Y1 X2 Y2  N random boxes, GAP away from all else, inside the rectangle
"""
import math
import random

import cv2
import numpy as np

FREE, SOLID = 254, 0
KEPT_RADIUS = 1.2  # around starts and goals, where clutter does not reach [m]


class Drawing:
    """The picture of a world, drawn shape by shape on square pixels."""

    def __init__(self, text, resolution, keep=()):
        """Draws `text` at `resolution` [m/px]; clutter stays away from the points `keep` [m]."""
        self.resolution = resolution
        self.kept = keep
        self.image = None
        for line in text.splitlines():
            words = line.split('#')[0].split()
            if words:
                getattr(self, words[0])(*(float(word) for word in words[1:]))

    def size(self, width, height):
        """Starts with an empty world of width x height [m]."""
        shape = (round(height / self.resolution), round(width / self.resolution))
        self.image = np.full(shape, FREE, np.uint8)
        self.y, self.x = np.indices(shape, np.float64)
        self.x = (self.x + 0.5) * self.resolution
        self.y = (shape[0] - self.y - 0.5) * self.resolution

    def fill(self):
        """Makes everything solid."""
        self.image[:] = SOLID

    def within(self, x, y, reach):
        """The part of the picture that holds all that is within `reach` of (x, y) [m], as a pair of slices."""
        rows, columns = self.image.shape
        left, right = (x - reach) / self.resolution - 1, (x + reach) / self.resolution + 1
        top, bottom = rows - (y + reach) / self.resolution - 1, rows - (y - reach) / self.resolution + 1
        return (slice(max(0, math.floor(top)), max(0, math.ceil(bottom))),
                slice(max(0, math.floor(left)), min(columns, max(0, math.ceil(right)))))

    def rectangle(self, x, y, width, height, angle):
        """Window and mask of pixels whose centres lie in a rectangle around (x, y) [m], turned by angle [rad]."""
        window = self.within(x, y, math.hypot(width, height) / 2)
        dx, dy = self.x[window] - x, self.y[window] - y
        along = dx * math.cos(angle) + dy * math.sin(angle)
        across = dy * math.cos(angle) - dx * math.sin(angle)
        slack = 1e-6
        return window, (abs(along) < width / 2 - slack) & (abs(across) < height / 2 - slack)

    def paint(self, value, *rectangle):
        """Fills a rectangle as above with a value."""
        window, mask = self.rectangle(*rectangle)
        self.image[window][mask] = value

    def wall(self, thickness, *points):
        pairs = list(zip(points[0::2], points[1::2]))
        for (x1, y1), (x2, y2) in zip(pairs, pairs[1:]):
            length = math.hypot(x2 - x1, y2 - y1) + thickness
            self.paint(SOLID, (x1 + x2) / 2, (y1 + y2) / 2, length, thickness, math.atan2(y2 - y1, x2 - x1))

    def arc(self, thickness, x, y, radius, start, end):
        steps = max(1, math.ceil(abs(end - start) / 4.0))
        angles = (math.radians(start + (end - start) * step / steps) for step in range(steps + 1))
        points = [(x + radius * math.cos(angle), y + radius * math.sin(angle)) for angle in angles]
        self.wall(thickness, *(value for point in points for value in point))

    def box(self, x, y, width, height, angle=0.0):
        self.paint(SOLID, x, y, width, height, math.radians(angle))

    def solid(self, x1, y1, x2, y2):
        self.paint(SOLID, (x1 + x2) / 2, (y1 + y2) / 2, abs(x2 - x1), abs(y2 - y1), 0.0)

    def open(self, x1, y1, x2, y2):
        self.paint(FREE, (x1 + x2) / 2, (y1 + y2) / 2, abs(x2 - x1), abs(y2 - y1), 0.0)

    def pillar(self, x, y, diameter):
        window = self.within(x, y, diameter / 2)
        self.image[window][np.hypot(self.x[window] - x, self.y[window] - y) < diameter / 2 - 1e-6] = SOLID

    def clutter(self, seed, count, gap, x1, y1, x2, y2):
        """Places up to `count` random boxes and partitions; what does not fit after 60 tries each is left out."""
        draw = random.Random(int(seed))
        placed, clearance = 0, self.clearance()
        for _ in range(int(count) * 60):
            if placed < count and self.place(draw, clearance, gap, (x1, y1, x2, y2)):
                placed, clearance = placed + 1, self.clearance()

    def place(self, draw, clearance, gap, area):
        """Tries one random piece of furniture; says whether it was placed."""
        width, height = draw.choice([(1.2, 0.8), (0.8, 0.8), (2.0, 0.8), (1.6, 1.2), (0.6, 0.6), (2.4, 1.0), (2.4, 0.15)])
        angle = math.radians(draw.choice([0, 0, 0, 90, 90, 90, 30, 45, 120]))
        x, y = draw.uniform(area[0], area[2]), draw.uniform(area[1], area[3])
        window, mask = self.rectangle(x, y, width, height, angle)
        if not mask.any() or clearance[window][mask].min() < gap:
            return False
        self.image[window][mask] = SOLID
        return True

    def clearance(self):
        """Distance [m] from each pixel to the nearest solid one, the edge of the world or a kept place."""
        free = np.pad((self.image == FREE).astype(np.uint8), 1)
        distance = cv2.distanceTransform(free, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)[1:-1, 1:-1] * self.resolution
        for x, y in self.kept:
            window = self.within(x, y, KEPT_RADIUS)
            distance[window][np.hypot(self.x[window] - x, self.y[window] - y) < KEPT_RADIUS] = 0.0
        return distance
