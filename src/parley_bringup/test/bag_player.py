#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""bag_player.py BAG: plays a robot's sensors and its clock when it is told to, and tells what the robot makes of its team.

Prints `ready` when the robot listens, and plays from the moment (seconds since 1970) that comes on stdin then: several
players keep step. Prints a line of JSON for each message about peers."""
import json
import sys
import time

import rosbag
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from parley_msgs.msg import PeerArray, PeerMaps
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan

import recordings

TYPES = {'/clock': Clock, '/odom': Odometry, '/scan': LaserScan}
AFTERWARDS = 2.0   # [s] to hear what the robot says of the last messages


class Reporter:
    """Prints what a robot knows of its team."""

    def __init__(self):
        self.maps, self.accepted = [], 0
        rospy.Subscriber('peer_maps', PeerMaps, self.take_maps)
        rospy.Subscriber('diagnostics', DiagnosticArray, self.take_diagnostics)
        rospy.Subscriber('peers', PeerArray, self.tell)

    def take_maps(self, message):
        self.maps = [layer.origin for layer in message.layers if layer.contours]

    def take_diagnostics(self, message):
        values = [int(item.value) for status in message.status for item in status.values if item.key == 'packets accepted']
        self.accepted = values[0] if values else self.accepted

    def tell(self, message):
        peers = {peer.name: (peer.state, recordings.pose_of(peer.pose.pose)) for peer in message.peers}
        maps = [peer.name for peer in message.peers if f'{peer.id:08x}' in self.maps]
        print(json.dumps({'stamp': message.header.stamp.to_sec(), 'peers': peers, 'maps': maps, 'accepted': self.accepted}), flush=True)


def play(messages, publishers, start):
    first = messages[0][2]
    for topic, message, stamp in messages:
        time.sleep(max(0.0, start + (stamp - first).to_sec() - time.time()))
        publishers[topic].publish(message)


def main():
    # On wall time: this is where the robot's time comes from.
    rospy.init_node('player', disable_rostime=True, disable_signals=True)
    publishers = {topic: rospy.Publisher(topic, kind, queue_size=100, tcp_nodelay=True) for topic, kind in TYPES.items()}
    with rosbag.Bag(sys.argv[1]) as bag:
        messages = list(bag.read_messages(topics=list(TYPES)))
    reporter = Reporter()
    while not all(publisher.get_num_connections() for publisher in publishers.values()):
        time.sleep(0.05)
    print('ready', flush=True)
    play(messages, publishers, float(sys.stdin.readline()))
    time.sleep(AFTERWARDS)
    return 0 if reporter.accepted else 1


if __name__ == '__main__':
    sys.exit(main())
