#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A scenario through nodelets ends as it does in lockstep, and all nodes live to its end."""
import json
import sys
import unittest

import rosnode
import rospy
import rostest
from geometry_msgs.msg import Twist
from lockstep import fleet_run
from std_msgs.msg import String

PATIENCE = 200.0   # [s] of wall time
AGREEMENT = 0.10   # [-] with one of the runs in lockstep
SEEDS = range(1, 5)
NODES = {'/simulator', '/robot_1/robot'}


class SimulationTest(unittest.TestCase):
    def test_agrees_with_lockstep(self):
        scenario, config = rospy.myargv()[1:3]
        result = json.loads(rospy.wait_for_message('simulator/result', String, timeout=PATIENCE).data)
        self.assertTrue(result['success'], result)
        self.assertTrue(all(robot['final_state'] == 'arrived' for robot in result['robots']), result['robots'])

        expected = [fleet_run(scenario, config, seed) for seed in SEEDS]
        for i, ours in enumerate(result['robots']):
            theirs = [run['robots'][i] for run in expected]
            self.assertTrue(all(robot['reached'] for robot in theirs))
            off = min(abs(ours['length'] / robot['length'] - 1.0) for robot in theirs)
            self.assertLess(off, AGREEMENT, (ours, theirs))

        last = rospy.wait_for_message('robot_1/cmd_vel', Twist, timeout=10.0)
        self.assertEqual(last.linear.x, 0.0)
        running = set(rosnode.get_node_names())
        self.assertLessEqual(NODES, running)
        for node in NODES:
            self.assertTrue(rosnode.rosnode_ping(node, max_count=1), f'{node} is dead')


if __name__ == '__main__':
    # On wall time: the run is over when the result comes, however slow the machine is.
    rospy.init_node('simulation_test', disable_rostime=True)
    rostest.rosrun('parley_bringup', 'simulation', SimulationTest, sys.argv)
