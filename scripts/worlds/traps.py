# SPDX-License-Identifier: BSD-3-Clause
"""Small worlds for route choice: dead ends, doors that close, parked robots, goals that cannot be reached."""
from worlds.files import Scenario, World

ROOM = '''
size 10 10
wall 0.2  0.1 0.1  9.9 0.1  9.9 9.9  0.1 9.9  0.1 0.1
box 5.0 5.2  1.2 0.8
box 3.2 7.2  0.8 0.8
box 7.0 3.0  0.8 1.2 30
'''
ROOM_ROBOTS = '''
robot_1  1.5 2.0  8.4 7.8
robot_2  8.4 7.8  1.5 2.0
'''

U_TRAP = '''
size 24 18
wall 0.3  0.15 0.15  23.85 0.15  23.85 17.85  0.15 17.85  0.15 0.15
wall 0.2  7.5 4.5  16.0 4.5  16.0 13.5  7.5 13.5
'''

# Two corridors of nearly equal length to the goal: the northern one is 0.5 m shorter as it seems, and closed at its far end.
PING_PONG = '''
size 32 20
fill
open  0.3  0.3   7.3 19.7
open 24.7  0.3  31.7 19.7
open  7.2 14.0  24.5 15.6
open  7.2  4.0  24.8  5.6
box   3.8 17.2  1.2 0.8
box   3.8  2.8  0.8 0.8
box  28.0 14.8  1.2 1.2
box  28.0  4.4  1.2 0.8
'''

DOOR = '''
size 24 20
wall 0.3  0.15 0.15  23.85 0.15  23.85 19.85  0.15 19.85  0.15 0.15
wall 0.2  12.0 0.3  12.0 19.7
open 11.8 13.4  12.2 14.6
open 11.8  1.4  12.2  3.0
box   6.0  7.0  1.6 0.8
box   4.0 10.6  0.8 0.8
box  18.0  7.4  1.2 1.2
box  20.2 11.0  1.6 0.8
box  17.0 17.0  0.8 0.8
'''

POCKET = '''
size 12.6 6.6
fill
open  0.3 0.3   6.3 6.3
open  6.2 2.7  12.3 3.9
'''

PARKED = '''
size 28 10
fill
open  0.3 0.3   5.3 9.7
open 22.7 0.3  27.7 9.7
open  5.2 5.6  22.8 7.2
open  5.2 1.2  22.8 2.8
'''

BLOCKED = '''
size 16 12
wall 0.2   0.1 0.1  15.9 0.1  15.9 11.9  0.1 11.9  0.1 0.1
wall 0.2  10.0 3.0  14.0 3.0  14.0 9.0  10.0 9.0  10.0 3.0
box   6.0 8.6  1.2 0.8
'''

WORLDS = [World('room', ROOM), World('u_trap', U_TRAP), World('ping_pong', PING_PONG), World('door', DOOR), World('pocket', POCKET),
          World('parked', PARKED), World('blocked', BLOCKED, hollow=True)]
DOORWAY = '[[12, 13.4], [12, 14.6]]'
SCENARIOS = [
    Scenario('room', 'room', 'Two robots swap places in a room with a few boxes; quick.', 60, ROOM_ROBOTS),
    Scenario('u_trap', 'u_trap', 'One robot; its straight way leads into a large U, nearer to one arm: which way out is no toss-up.', 120, 'robot_1  2.5 6.6  21.5 7.1'),
    Scenario('ping_pong', 'ping_pong', 'One robot before two corridors of nearly equal length; the northern one is a dead end.', 180,
             'robot_1  2.5 9.9  29.5 10.1'),
    Scenario('ping_pong_pair', 'ping_pong', 'A teammate comes out of the dead end and tells robot_1, which must choose once and stay with it.', 180,
             'robot_1  2.5 9.9  29.5 10.1\nrobot_2 22.5 14.8  5.0 6.0 180'),
    Scenario('door', 'door', 'The door that a robot has seen open closes before it; a longer way round exists.', 120,
             'robot_1  2.5 14.0  21.5 14.0', f'events:\n  - {{time: 4, door: {DOORWAY}, state: closed}}'),
    Scenario('door_opens', 'door', 'The door is closed at first and opens again while two robots are on their way round.', 120,
             'robot_1  2.5 14.0  21.5 14.0\nrobot_2 21.5  9.0  2.5 17.0',
             f'events:\n  - {{time: 1, door: {DOORWAY}, state: closed}}\n  - {{time: 12, door: {DOORWAY}, state: open}}'),
    Scenario('pocket', 'pocket', 'Two robots with swapped goals in a dead end 1.2 m wide; one must let the other out.', 120,
             'robot_1  8.6 3.3  11.2 3.3 0\nrobot_2 11.2 3.3  8.6 3.3 180'),
    Scenario('parked', 'parked', 'robot_2 stands at its goal in a corridor 1.6 m wide; robot_1 must pass it or take the other corridor.', 120,
             'robot_1  2.5 6.4  25.5 6.4\nrobot_2 14.0 6.4  14.0 6.4 0'),
    Scenario('blocked', 'blocked', 'The goal is walled in. Expected: no route; the robot stands with no_route or blocked, the run ends with status 1.', 60,
             'robot_1  2.5 6.0  12.0 6.0'),
]
