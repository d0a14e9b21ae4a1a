#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Two robots that meet head-on where there is hardly room for both hear where the other means to go, and both reach their
goals without touching, through nodelets as in lockstep."""
import json
import sys
import unittest

import rospy
import rostest
from lockstep import fleet_run
from parley_msgs.msg import PeerMotions, Trajectory
from std_msgs.msg import String

PATIENCE = 200.0   # [s] of wall time
LONGEST = 90.0     # [s] of simulated time
ROBOTS = ('robot_1', 'robot_2')
MAKES_ROOM = (Trajectory.YIELDING, Trajectory.ESCAPING)


class ConflictTest(unittest.TestCase):
    def setUp(self):
        self.numbers, self.ways, self.makers_of_room = {}, {}, set()
        for robot in ROBOTS:
            rospy.Subscriber(f'/{robot}/peer_motions', PeerMotions, lambda message, robot=robot: self.hear(robot, message))
            rospy.Subscriber(f'/{robot}/trajectory', Trajectory, lambda message, robot=robot: self.follow(robot, message))

    def hear(self, robot, message):
        """Whose ways a robot has been told."""
        self.numbers[robot] = message.id
        self.ways.setdefault(robot, set()).update(peer.id for peer in message.peers if peer.intent.way)

    def follow(self, robot, message):
        if message.verdict in MAKES_ROOM:
            self.makers_of_room.add(robot)

    def test_they_pass_each_other(self):
        scenario, config = rospy.myargv()[1:3]
        result = json.loads(rospy.wait_for_message('simulator/result', String, timeout=PATIENCE).data)
        print({robot['name']: (robot['time'], robot['stopped'], robot['min_clearance']) for robot in result['robots']},
              'made room:', self.makers_of_room)
        self.assertEqual(set(result['collisions'].values()), {0}, result)
        self.assertTrue(result['success'], result)
        for robot in result['robots']:
            self.assertTrue(robot['reached'], robot)
            self.assertLess(robot['time'], LONGEST)
        self.assertEqual(self.ways, {'robot_1': {self.numbers['robot_2']}, 'robot_2': {self.numbers['robot_1']}})

        expected = fleet_run(scenario, config)
        self.assertTrue(expected['success'], expected)
        self.assertTrue(all(robot['reached'] for robot in expected['robots']), expected['robots'])


if __name__ == '__main__':
    # On wall time: the run is over when the result comes, however slow the machine is.
    rospy.init_node('conflict_test', disable_rostime=True)
    rostest.rosrun('parley_bringup', 'conflict', ConflictTest, sys.argv)
