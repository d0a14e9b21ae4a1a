# SPDX-License-Identifier: BSD-3-Clause
"""What robots of a lockstep run sensed, as bags, and where they truly were."""
import csv
import math
import os
import subprocess

import numpy
import rosbag
import roslib.packages
import yaml


def compose(a, b):
    return (a[0] + math.cos(a[2]) * b[0] - math.sin(a[2]) * b[1], a[1] + math.sin(a[2]) * b[0] + math.cos(a[2]) * b[1], a[2] + b[2])


def inverse(a):
    return (-math.cos(a[2]) * a[0] - math.sin(a[2]) * a[1], math.sin(a[2]) * a[0] - math.cos(a[2]) * a[1], -a[2])


def difference(a, b):
    """Distance [m] and angle [rad] between two poses."""
    return math.hypot(a[0] - b[0], a[1] - b[1]), abs(math.remainder(a[2] - b[2], 2.0 * math.pi))


def pose_of(pose):
    """Of a message."""
    return pose.position.x, pose.position.y, 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)


class Course:
    """Poses over time."""

    def __init__(self, rows):
        self.times, x, y, yaw = numpy.array(rows).T
        self.columns = (x, y, numpy.unwrap(yaw))

    def at(self, time):
        return tuple(float(numpy.interp(time, self.times, column)) for column in self.columns)


class Recording:
    """One robot of a run: its bag, by its own clock, and the truth, by that of the world."""

    def __init__(self, bag, trace, robot):
        self.bag, self.name, self.clock_offset = bag, robot['name'], robot['clock']['offset']
        with open(trace, encoding='utf-8') as file:
            rows = [row for row in csv.DictReader(file) if row['robot'] == self.name]
        self.truth = Course([[float(row[key]) for key in ('time', 'x', 'y', 'yaw')] for row in rows])
        with rosbag.Bag(bag) as messages:
            odometry = [message for _, message, _ in messages.read_messages(topics=['/odom'])]
        self.odometry = Course([(message.header.stamp.to_sec(), *pose_of(message.pose.pose)) for message in odometry])

    def error_of(self, other, believed, stamp):
        """How far off the other's body is, seen from this one's, if its odom frame is where it is believed to be at that
        time of this robot's clock."""
        time = stamp - self.clock_offset
        seen = compose(inverse(self.odometry.at(stamp)), compose(believed, other.odometry.at(time + other.clock_offset)))
        return difference(seen, compose(inverse(self.truth.at(time)), other.truth.at(time)))


def record(scenario, config, folder):
    """The same run once for each robot, since a bag holds one; it is the same to the bit."""
    program = roslib.packages.find_node('parley_sim', 'fleet_run')[0]
    path = os.path.join(folder, 'scenario.yaml')
    with open(path, 'w', encoding='utf-8') as file:
        yaml.safe_dump(scenario, file)
    runs = []
    for robot in scenario['robots']:
        bag, trace = (os.path.join(folder, robot['name'] + suffix) for suffix in ('.bag', '.csv'))
        command = [program, path, '--config', config, '--quiet', '--bag', bag, '--bag-robot', robot['name'], '--trace', trace]
        runs.append((subprocess.Popen(command), bag, trace, robot))
    for process, *_ in runs:
        process.wait()
    return {robot['name']: Recording(bag, trace, robot) for _, bag, trace, robot in runs}
