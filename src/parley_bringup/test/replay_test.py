#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A bag of what one robot of a simulation sensed and received, played through replay.launch, meets the same peers again."""
import math
import os
import sys
import tempfile
import time
import unittest

import rosbag
import rospy
import rostest
from parley_msgs.msg import Peer, PeerArray

import processes
import recordings

PARTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..')
PATIENCE = 90.0                             # [s] of wall time
MEETING = (5.0, 0.0, 0.0)                   # where the robot is told of, in its odom frame: near where the two meet
POSITION, ANGLE = 0.15, math.radians(3.0)   # [m] [rad] between the live estimate and that of the replay
ROBOT = 'robot_1'
TOPICS = [f'/{ROBOT}/{name}' for name in ('scan', 'odom', 'radio/received')]


class ReplayTest(unittest.TestCase):
    def setUp(self):
        self.last = None
        rospy.Subscriber(f'/{ROBOT}/peers', PeerArray, self.take)

    def take(self, message):
        self.last = message

    def confirmed(self):
        """{name: where its odom frame is} of the peers that are confirmed at present."""
        peers = self.last.peers if self.last else []
        return {peer.name: recordings.pose_of(peer.pose.pose) for peer in peers if peer.state == Peer.CONFIRMED}

    def wait(self, condition, what):
        end = time.monotonic() + PATIENCE
        while not condition():
            self.assertLess(time.monotonic(), end, f'{what}: {self.last}')
            time.sleep(0.1)

    @staticmethod
    def launch(group, name, *arguments):
        group.start(['/usr/bin/python3', '/usr/bin/roslaunch', os.path.join(PARTS, 'launch', name + '.launch'), *arguments])

    def live(self, bag):
        """Records until the robots have met, and two seconds more. What is known of the peers then."""
        rospy.set_param('/use_sim_time', True)   # or the recorder, which is up first, would go by wall time
        with processes.Processes() as group:
            group.start(['/usr/bin/rosbag', 'record', '-O', bag, *TOPICS])
            self.launch(group, 'simulation', 'scenario:=room')
            self.wait(self.confirmed, 'they have not met')
            met = self.last.header.stamp.to_sec()
            self.wait(lambda: self.last.header.stamp.to_sec() > met + 2.0 and self.confirmed(), 'the simulation stands')
            return self.confirmed()

    def replayed(self, bag, names):
        with processes.Processes() as group:
            self.launch(group, 'replay', 'bag:=' + bag, 'model:=courier', 'ns:=/' + ROBOT, f'odom_frame:={ROBOT}/odom',
                        f'base_frame:={ROBOT}/base_link', 'name:=' + ROBOT, 'key_file:=' + os.path.join(PARTS, 'config', 'simulation.key'))
            self.wait(lambda: set(self.confirmed()) == names, 'the replay does not meet them')
            return self.confirmed()

    def test_meets_the_same_peers(self):
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, 'run.bag')
            live = self.live(bag)
            with rosbag.Bag(bag) as recorded:
                self.assertEqual(set(recorded.get_type_and_topic_info().topics), set(TOPICS))
            self.last = None
            again = self.replayed(bag, set(live))
        for name, pose in live.items():
            there = recordings.compose(recordings.inverse(pose), MEETING)
            distance, angle = recordings.difference(recordings.compose(again[name], there), MEETING)
            print(f'{name}: {distance:.3f} m and {math.degrees(angle):.2f} degrees from the live estimate')
            self.assertLess(distance, POSITION, name)
            self.assertLess(angle, ANGLE, name)


if __name__ == '__main__':
    # On wall time: simulated time stands between the two.
    rospy.init_node('replay_test', disable_rostime=True, disable_signals=True)
    processes.end_with_parent()
    rostest.rosrun('parley_bringup', 'replay', ReplayTest, sys.argv)
