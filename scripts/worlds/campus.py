# SPDX-License-Identifier: BSD-3-Clause
"""A campus of nine buildings, 150 x 150 m, for long ways and large maps. All lengths in metres."""
import random

from worlds.files import Scenario, World

SIDE = 42.0  # of a building [m]


def rectangle(thickness, x1, y1, x2, y2):
    return f'wall {thickness} {x1:g} {y1:g} {x2:g} {y1:g} {x2:g} {y2:g} {x1:g} {y2:g} {x1:g} {y1:g}'


def rooms(draw, x1, x2, y, depth):
    """Rooms between x1 and x2 whose doors are in the wall at `y`; the far wall is at y + depth."""
    lines = [f'wall 0.2 {x1:g} {y:g} {x2:g} {y:g}']
    x = x1
    while x2 - x > 0.1:
        end = x + draw.choice([4.0, 5.0, 5.0, 6.5])
        end = x2 if x2 - end < 3.5 else end
        door = draw.uniform(x + 0.6, end - 1.7)
        lines.append(f'wall 0.2 {end:g} {y:g} {end:g} {y + depth:g}')
        lines.append(f'open {door:.1f} {y - 0.3:g} {door + 1.1:.1f} {y + 0.3:g}')
        x = end
    return lines


def offices(seed, x, y, closed=()):
    """Three wings of rooms on both sides of a corridor 2 m wide; `closed` names corridor ends such as 'w0' or 'e2'."""
    draw = random.Random(seed)
    lines = [rectangle(0.3, x, y, x + SIDE, y + SIDE)]
    for wing in range(3):
        low, middle = y + 14.0 * wing, y + 14.0 * wing + 7.0
        lines.append(f'wall 0.2 {x:g} {low:g} {x + SIDE:g} {low:g}')
        for x1, x2 in ((x, x + 20.0), (x + 22.0, x + SIDE)):
            lines += rooms(draw, x1, x2, middle - 1.0, -6.0) + rooms(draw, x1, x2, middle + 1.0, 6.0)
        for side, x_end in (('w', x), ('e', x + SIDE)):
            if side + str(wing) not in closed:
                lines.append(f'open {x_end - 0.3:g} {middle - 0.8:g} {x_end + 0.3:g} {middle + 0.8:g}')
    lines.append(f'open {x + 20.1:g} {y + 0.2:g} {x + 21.9:g} {y + SIDE - 0.2:g}')
    return lines


def court(seed, x, y, sides):
    """Rooms around a ring corridor 2 m wide and a courtyard with trees; `sides` (of 'nesw') have entrances."""
    draw = random.Random(seed)
    lines = [rectangle(0.3, x, y, x + SIDE, y + SIDE), rectangle(0.2, x + 9, y + 9, x + SIDE - 9, y + SIDE - 9)]
    lines += rooms(draw, x, x + SIDE, y + 7.0, -7.0) + rooms(draw, x, x + SIDE, y + SIDE - 7.0, 7.0)
    lines += [f'wall 0.2 {at:g} {y + 7:g} {at:g} {y + SIDE - 7:g}' for at in (x + 7, x + SIDE - 7)]
    for at in (x + 7, x + SIDE - 7):
        lines += [f'open {at - 0.3:g} {y + b:g} {at + 0.3:g} {y + b + 1.1:g}' for b in (11, 29)]
        lines += [f'wall 0.2 {at - 7 if at < x + 10 else at:g} {y + b:g} {at if at < x + 10 else at + 7:g} {y + b:g}' for b in (17.5, 24.5)]
    doors = {'n': (20, SIDE - 7.3, 22, SIDE + 0.3), 's': (20, -0.3, 22, 7.3), 'w': (-0.3, 20, 7.3, 22),
             'e': (SIDE - 7.3, 20, SIDE + 0.3, 22)}
    for side in sides:
        x1, y1, x2, y2 = doors[side]
        if side in 'ns':
            lines += [f'open {x + x1 - 2:g} {y + y1 + 0.5:g} {x + x2 + 2:g} {y + y2 - 0.5:g}']
            lines += [f'wall 0.2 {at:g} {y + y1 + 0.3:g} {at:g} {y + y2 - 0.3:g}' for at in (x + 18, x + 24)]
        lines.append(f'open {x + x1:g} {y + y1:g} {x + x2:g} {y + y2:g}')
    lines += [f'open {x + 15:g} {y + 8.7:g} {x + 16.6:g} {y + 9.3:g}', f'open {x + 26:g} {y + SIDE - 9.3:g} {x + 27.6:g} {y + SIDE - 8.7:g}']
    lines += [f'pillar {x + a:g} {y + b:g} 0.8' for a in (14, 21, 28) for b in (14, 21, 28)]
    return lines


def hall(seed, x, y, doors):
    """A hall with columns and boxes; `doors` are the lower left and upper right corners of openings, relative to the hall."""
    lines = [rectangle(0.3, x, y, x + SIDE, y + SIDE)]
    lines += [f'open {x + x1:g} {y + y1:g} {x + x2:g} {y + y2:g}' for x1, y1, x2, y2 in doors]
    lines += [f'pillar {x + a:g} {y + b:g} 0.8' for a in (7, 14, 21, 28, 35) for b in (7, 14, 21, 28, 35)]
    lines.append(f'clutter {seed} 30 1.5 {x + 1:g} {y + 1:g} {x + SIDE - 1:g} {y + SIDE - 1:g}')
    return lines


def yards(seed, x, y, opening):
    """Three walled yards, each a dead end 20 m deep, on both sides of a lane; `opening` is 1 if the near ones open east, else -1."""
    lines = []
    for row in range(3):
        low, high = y + 14.0 * row + 0.5, y + 14.0 * row + 12.5
        near, far = (x + 2.0, x + 22.0) if opening > 0 else (x + SIDE - 2.0, x + SIDE - 22.0)
        lines.append(f'wall 0.2 {far:g} {low:g} {near:g} {low:g} {near:g} {high:g} {far:g} {high:g}')
        lines.append(f'clutter {seed + row} 7 1.5 {min(near, far):g} {low:g} {max(near, far):g} {high:g}')
    side = x + SIDE - 8.0 if opening > 0 else x + 8.0
    lines += [f'wall 0.2 {side:g} {y + 4:g} {side:g} {y + 18:g}', f'wall 0.2 {side:g} {y + 24:g} {side:g} {y + 38:g}']
    return lines


def campus():
    """The drawing: streets of 6 m between three rows of three buildings; fences close two streets."""
    low, middle, high = 6.0, 54.0, 102.0
    lines = ['size 150 150', rectangle(0.4, 0.2, 0.2, 149.8, 149.8)]
    lines += yards(50, low, low, 1) + hall(60, middle, low, [(-0.3, 30, 0.3, 33), (20, SIDE - 0.3, 23, SIDE + 0.3), (SIDE - 0.3, 8, SIDE + 0.3, 11)])
    lines += offices(1, high, low, ('w1', 'e2')) + court(2, low, middle, 'wns') + offices(3, middle, middle, ('e0', 'w1', 'e2'))
    lines += court(4, high, middle, 'ens') + offices(5, low, high, ('e1', 'w2'))
    lines += hall(70, middle, high, [(-0.3, 18, 0.3, 21), (SIDE - 0.3, 30, SIDE + 0.3, 33), (8, -0.3, 11, 0.3)]) + yards(80, high, high, -1)
    lines += ['wall 0.2 75 48 75 54', 'wall 0.2 96 117 102 117', 'wall 0.2 48 26 54 26', 'clutter 90 60 1.5 0.5 0.5 149.5 149.5']
    return '\n'.join(lines)


ROBOTS = '''
robot_1   3.0  20.0  147.0 128.0
robot_2   3.0  51.0  147.0  99.0
robot_3   3.0  99.0  147.0  27.0
robot_4   3.0 140.0  147.0  60.0
robot_5 147.0   9.0    3.0  88.0
robot_6 147.0  51.0    3.0 124.0
robot_7 147.0  93.0   23.5  78.5
robot_8 147.0 145.0    3.0   9.0
'''
# Odometry drifts by more than the goal's tolerance on ways of some hundred metres.
BY_ODOMETRY = 'judge: odometry'
WORLDS = [World('campus', campus(), ROBOTS, 0.1)]
SCENARIOS = [
    Scenario('campus', 'campus', 'Eight robots with long ways through a campus of nine buildings; large maps.', 900, ROBOTS,
             BY_ODOMETRY),
    Scenario('campus_solo', 'campus', 'One robot alone with a long way through the campus.', 900, ROBOTS.splitlines()[1],
             BY_ODOMETRY),
]
