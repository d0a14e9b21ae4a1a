#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Three robots, each with a roscore, nodes and a clock of its own, have nothing in common but UDP: they come to know each
other and draw each other's maps. With --loopback no network namespaces are tried."""
import contextlib
import json
import math
import os
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import rostest
from parley_msgs.msg import Peer

import networks
import processes
import recordings

HERE = os.path.dirname(os.path.abspath(__file__))
PARTS = os.path.join(HERE, '..')
KEY = os.path.join(PARTS, 'config', 'simulation.key')
POSITION, ANGLE = 0.3, math.radians(5.0)   # [m] [rad] how far off a robot may believe another
START = 60.0                               # [s] for a robot's nodes to be up
SCENARIO = {
    'map': os.path.realpath(os.path.join(PARTS, 'maps', 'room.yaml')), 'duration': 30, 'limits': {'speed': 0.6},
    'robots': [{'name': 'ann', 'start': [1.5, 2.0, 0.7], 'goal': [8.4, 7.8], 'clock': {'offset': 3.0}},
               {'name': 'bob', 'start': [8.4, 7.8, -2.44], 'goal': [1.5, 2.0], 'clock': {'offset': 11.0}},
               {'name': 'cid', 'start': [8.4, 2.0, 2.4], 'goal': [1.5, 7.8], 'clock': {'offset': 7.0}}]}


class Robot:
    """The processes of one robot and what they say of its team."""

    def __init__(self, group, host, bag, folder):
        self.name, self.log_path = host.name, os.path.join(folder, host.name + '.log')
        home = os.path.join(folder, host.name)
        environment = {**os.environ, 'ROS_MASTER_URI': f'http://127.0.0.1:{host.master_port}', 'ROS_IP': '127.0.0.1',
                       'ROS_HOME': home, 'ROS_LOG_DIR': os.path.join(home, 'log')}
        environment.pop('ROS_HOSTNAME', None)
        with open(self.log_path, 'w', encoding='utf-8') as log:
            self.start(group, host, bag, log, environment)
        self.ready, self.reports = threading.Event(), []
        threading.Thread(target=self.listen, daemon=True).start()

    def start(self, group, host, bag, log, environment):
        boot = environment['ROS_HOME'] + '.boot'
        self.launch = group.start([
            *host.enter, '/usr/bin/python3', '/usr/bin/roslaunch', '-p', str(host.master_port), os.path.join(HERE, 'own_master.launch'),
            f'name:={host.name}', f'key_file:={KEY}', f'boot_file:={boot}', f'radio_port:={host.radio_port}',
            f'broadcast:={host.broadcast}', f'peers:={host.peers}'], env=environment, stdout=log, stderr=subprocess.STDOUT)
        self.player = group.start(
            [*host.enter, '/usr/bin/python3', os.path.join(HERE, 'bag_player.py'), bag], env=environment, text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=log)

    def listen(self):
        for line in self.player.stdout:
            if line == 'ready\n':
                self.ready.set()
            elif line.startswith('{'):
                self.reports.append(json.loads(line))

    def play(self, start):
        self.player.stdin.write(f'{start}\n')
        self.player.stdin.flush()

    def knows(self, others):
        """Whether it has all that it is to have of the others by now."""
        last = self.reports[-1] if self.reports else {'peers': {}, 'maps': [], 'accepted': 0}
        confirmed = {name for name, (state, _) in last['peers'].items() if state == Peer.CONFIRMED}
        return confirmed == others and set(last['maps']) == others and last['accepted'] > 0

    def log(self):
        with open(self.log_path, encoding='utf-8') as file:
            return file.read()


class OwnMastersTest(unittest.TestCase):
    def start(self, stack, recorded, folder):
        names = [robot['name'] for robot in SCENARIO['robots']]
        hosts, kind = stack.enter_context(networks.hosts_for(names, '--loopback' in sys.argv))
        print('robots are apart by', kind, flush=True)
        group = stack.enter_context(processes.Processes())
        robots = [Robot(group, host, recorded[host.name].bag, folder) for host in hosts]
        deadline = time.monotonic() + START
        for robot in robots:
            while not robot.ready.wait(0.1):
                self.assertTrue(robot.launch.poll() is None and time.monotonic() < deadline, f'{robot.name} does not start\n{robot.log()}')
        start = time.time() + 0.5
        for robot in robots:
            robot.play(start)
        return robots

    def await_acquaintance(self, robots, names):
        """Until each knows all others, or their bags have ended."""
        while not all(robot.knows(names - {robot.name}) for robot in robots):
            for robot in robots:
                self.assertIsNone(robot.launch.poll(), f'{robot.name} has ended\n{robot.log()}')
            if any(robot.player.poll() is not None for robot in robots):
                self.fail('\n'.join(f'{robot.name}: {robot.reports[-1:]}\n{robot.log()}' for robot in robots))
            time.sleep(0.1)

    def check_poses(self, robot, recorded):
        """Whatever a robot took for confirmed at any time was so."""
        own, worst = recorded[robot.name], (0.0, 0.0)
        for report in robot.reports:
            for name, (state, believed) in report['peers'].items():
                if state == Peer.CONFIRMED:
                    error = own.error_of(recorded[name], believed, report['stamp'])
                    worst = tuple(map(max, worst, error))
        print(f'{robot.name}: off by {worst[0]:.2f} m and {math.degrees(worst[1]):.1f} degrees at most', flush=True)
        self.assertLess(worst[0], POSITION, robot.name)
        self.assertLess(worst[1], ANGLE, robot.name)

    def test_they_meet_by_radio_alone(self):
        with contextlib.ExitStack() as stack:   # and not addCleanup, which an interrupt skips
            folder = stack.enter_context(tempfile.TemporaryDirectory())
            recorded = recordings.record(SCENARIO, os.path.join(PARTS, 'config'), folder)
            began = time.monotonic()
            robots = self.start(stack, recorded, folder)
            self.await_acquaintance(robots, set(recorded))
            print(f'acquainted {time.monotonic() - began:.0f} s after their start', flush=True)
            for robot in robots:
                self.check_poses(robot, recorded)
                self.assertNotIn('process has died', robot.log())


if __name__ == '__main__':
    processes.end_with_parent()
    rostest.rosrun('parley_bringup', 'own_masters', OwnMastersTest, sys.argv)
