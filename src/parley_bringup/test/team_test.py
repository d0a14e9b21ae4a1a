#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Two robots that meet in a simulation come to know where the other is, put its frame into tf, draw its map, and tell their
planners what it is about to do."""
import math
import sys
import time
import unittest

import rospy
import rostest
import tf2_ros
from parley_msgs.msg import Peer, PeerArray, PeerMaps, PeerMotions

PATIENCE = 120.0   # [s] of wall time
POSITION = 0.3     # [m] how far off a robot may believe another's frame, near where it is
ROBOTS = {'robot_1': 'robot_2', 'robot_2': 'robot_1'}


def pose_of(transform):
    p, q = transform.transform.translation, transform.transform.rotation
    return p.x, p.y, 2.0 * math.atan2(q.z, q.w)


def transformed(pose, x, y):
    return (pose[0] + math.cos(pose[2]) * x - math.sin(pose[2]) * y, pose[1] + math.sin(pose[2]) * x + math.cos(pose[2]) * y)


class TeamTest(unittest.TestCase):
    def setUp(self):
        self.buffer = tf2_ros.Buffer()
        self.listener = tf2_ros.TransformListener(self.buffer)
        self.peers, self.maps, self.motions = {}, {}, {}
        for robot in ROBOTS:
            rospy.Subscriber(f'/{robot}/peers', PeerArray, lambda message, robot=robot: self.peers.update({robot: message}))
            rospy.Subscriber(f'/{robot}/peer_maps', PeerMaps, lambda message, robot=robot: self.maps.update({robot: message}))
            rospy.Subscriber(f'/{robot}/peer_motions', PeerMotions,
                             lambda message, robot=robot: self.motions.update({robot: message}))

    def confirmed(self, robot):
        """What a robot knows of the other; None unless confirmed."""
        message = self.peers.get(robot)
        found = [peer for peer in message.peers if peer.name == ROBOTS[robot]] if message else []
        return found[0] if found and found[0].state == Peer.CONFIRMED else None

    def planned(self, robot):
        """What a robot's planner is told of the other; None if nothing."""
        message = self.motions.get(robot)
        found = [peer for peer in message.peers if peer.name == ROBOTS[robot]] if message else []
        return found[0] if found else None

    def wait(self, condition, what):
        end = time.monotonic() + PATIENCE
        while not condition():
            self.assertLess(time.monotonic(), end, what)
            time.sleep(0.1)

    def test_they_come_to_know_each_other(self):
        self.wait(lambda: all(self.confirmed(robot) for robot in ROBOTS), f'not both confirmed: {self.peers}')
        for robot, other in ROBOTS.items():
            peer = self.confirmed(robot) or self.fail(f'{robot} has lost {other} again')
            self.assertEqual(peer.frame, f'{robot}/peer/{other}/odom')
            self.assertGreater(peer.support, 0)
            own = f'{robot}/odom'
            self.wait(lambda: self.buffer.can_transform(own, peer.frame, rospy.Time(0)), f'{peer.frame} is not in tf')
            believed = pose_of(self.buffer.lookup_transform(own, peer.frame, rospy.Time(0)))
            # The simulator ties all odom frames to the world: this is the truth.
            truth = pose_of(self.buffer.lookup_transform(own, f'{other}/odom', rospy.Time(0)))
            where = pose_of(self.buffer.lookup_transform(f'{other}/odom', f'{other}/base_link', rospy.Time(0)))
            error = math.dist(transformed(believed, *where[:2]), transformed(truth, *where[:2]))
            self.assertLess(error, POSITION, (robot, believed, truth))
        self.wait(lambda: all(self.planned(robot) and self.planned(robot).intent.way for robot in ROBOTS), 'no intent is told')
        for robot, other in ROBOTS.items():
            peer = self.planned(robot) or self.fail(f'{robot} has lost {other} again')
            self.assertEqual(peer.id, self.motions[other].id)
            self.assertEqual(peer.trajectory[-1].speed, 0.0, 'ends standing')
            self.assertIn(peer.intent.holder, [message.id for message in self.motions.values()])
        self.wait(lambda: all(robot in self.maps and self.maps[robot].layers for robot in ROBOTS), "peers' maps are not drawn")


if __name__ == '__main__':
    # On wall time: simulated time stands until all stages are up.
    rospy.init_node('team_test', disable_rostime=True)
    rostest.rosrun('parley_bringup', 'team', TeamTest, sys.argv)
