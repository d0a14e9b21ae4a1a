# SPDX-License-Identifier: BSD-3-Clause
"""Small worlds where robots must meet in a narrow place: corridors, doorways, crossings."""
from worlds.files import Scenario, World

CORRIDOR_WIDTHS = (1.2, 1.6, 2.0)
NUMBERS = {2: 'Two', 4: 'Four', 8: 'Eight'}
DOOR_WIDTHS = (0.9, 1.2, 1.6, 2.0, 3.0)


def corridor(width):
    """A corridor of 20 m between two rooms of 4 x 4 m."""
    return World(f'corridor_{width}', f'''
        size 28.6 4.6
        fill
        open  0.3 0.3   4.3 4.3
        open 24.3 0.3  28.3 4.3
        open  4.2 {2.3 - width / 2:g}  24.4 {2.3 + width / 2:g}
        ''')


def corridor_robots(count):
    """Half of the robots in each end room, head-on; goals are the mirrored places."""
    places = {1: [(2.3, 2.3)], 2: [(2.3, 1.2), (2.3, 3.4)], 4: [(3.2, 1.2), (3.2, 3.4), (1.3, 1.2), (1.3, 3.4)]}[count // 2]
    ways = [(x, y, 28.6 - x, y) for x, y in places] + [(28.6 - x, y, x, y) for x, y in places]
    return listed(ways)


def doorway(width):
    """Two halls of 8 x 8 m with a door between them."""
    return World(f'doorway_{width}', f'''
        size 16.8 8.6
        fill
        open 0.3 0.3   8.3 8.3
        open 8.5 0.3  16.5 8.3
        open 8.2 {4.3 - width / 2:g}  8.6 {4.3 + width / 2:g}
        ''')


def doorway_robots():
    """Four robots a side; goals are crosswise, so that all straight lines meet near the door."""
    heights = (1.5, 3.4, 5.2, 7.1)
    ways = [(2.0, y, 14.8, 8.6 - y) for y in heights] + [(14.8, y, 2.0, 8.6 - y) for y in heights]
    return listed(ways)


def listed(ways):
    """Robots robot_1, robot_2, ... with the ways (x, y, goal x, goal y) [m]."""
    return '\n'.join('robot_{} {:g} {:g} {:g} {:g}'.format(number, *way) for number, way in enumerate(ways, 1))


CROSS = '''
size 25.2 25.2
fill
open  0.3 10.6   4.3 14.6
open 20.9 10.6  24.9 14.6
open 10.6  0.3  14.6  4.3
open 10.6 20.9  14.6 24.9
open  4.2 11.95  21.0 13.25
open 11.95  4.2  13.25 21.0
'''
CROSS_ROBOTS = '''
robot_1  2.3 11.6  22.9 11.6
robot_2  2.3 13.6  22.9 13.6
robot_3 22.9 11.6   2.3 11.6
robot_4 22.9 13.6   2.3 13.6
robot_5 11.6  2.3  11.6 22.9
robot_6 13.6  2.3  13.6 22.9
robot_7 11.6 22.9  11.6  2.3
robot_8 13.6 22.9  13.6  2.3
'''

# A hallway with a lobby (A) at its west end, a crossing area (B) in the middle where a second hallway joins, a lobby (C) in the east.
CROSSING_CORRIDOR = '''
size 24 14
fill
open  0.3  4.5   4.8  9.5
open 19.2  4.5  23.7  9.5
open  4.7  6.2  19.3  7.8
open  9.6  4.6  14.4  9.4
open 11.2  9.3  12.8 12.2
open  8.6 11.4  15.4 13.7
open 11.2  1.8  12.8  4.7
open  8.6  0.3  15.4  2.6
pillar 12.0 7.0 0.5
box    2.0 9.1  1.6 0.8
box   22.0 4.9  1.6 0.8
'''
CROSSING_CORRIDOR_ROBOTS = '''
robot_1  1.8  6.4  22.2  7.6
robot_2 22.2  7.6   1.8  6.4
robot_3 10.0 12.6  14.0  1.4
'''

WORLDS = [corridor(width) for width in CORRIDOR_WIDTHS] + [doorway(width) for width in DOOR_WIDTHS] + [
    World('cross', CROSS),
    World('crossing_corridor', CROSSING_CORRIDOR),
]
SCENARIOS = [
    Scenario(f'corridor_{width}_{count}', f'corridor_{width}', f'{NUMBERS[count]} robots head-on in a corridor {width} m wide and 20 m long.',
             180, corridor_robots(count)) for width in CORRIDOR_WIDTHS for count in (2, 4, 8)
] + [
    Scenario(f'doorway_{width}', f'doorway_{width}', f'Four robots against four through one door {width} m wide.', 180, doorway_robots())
    for width in DOOR_WIDTHS
] + [
    Scenario('cross', 'cross', 'Two robots from each of the four arms of a crossing of corridors 1.3 m wide.', 180, CROSS_ROBOTS),
    Scenario('crossing_corridor', 'crossing_corridor', 'Three robots traverse a corridor and cross paths in its central area.', 120,
             CROSSING_CORRIDOR_ROBOTS),
]
