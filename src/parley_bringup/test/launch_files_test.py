#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every launch file loads with the files that it names, and starts the nodes that it promises."""
import glob
import os
import subprocess
import tempfile
import unittest

import yaml

LAUNCH = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'launch')
ARGUMENTS = {'robot': ['model:=courier', 'name:=ann', 'key_file:=/none.key'], 'replay': ['model:=courier', 'bag:=/none.bag', 'rviz:=true'], 'simulation': [],
             'rviz': []}
NODES = {'robot': {'/robot'}, 'replay': {'/player', '/robot', '/rviz'}, 'simulation': {'/simulator', '/robots'},
         'rviz': {'/rviz'}}


def roslaunch(*words):
    """What roslaunch prints; its log must not land in the home of who tests."""
    with tempfile.TemporaryDirectory() as home:
        done = subprocess.run(['/usr/bin/python3', '/usr/bin/roslaunch', *words], check=False, text=True, capture_output=True,
                              env={**os.environ, 'ROS_HOME': home})
    if done.returncode != 0:
        raise AssertionError(f'roslaunch {words}: {done.stderr}{done.stdout}')
    return done.stdout


class LaunchFiles(unittest.TestCase):
    def test_all_are_tested(self):
        found = {os.path.basename(path)[:-len('.launch')] for path in glob.glob(os.path.join(LAUNCH, '*.launch'))}
        self.assertEqual(found, set(ARGUMENTS))

    def test_they_start_their_nodes(self):
        for name, arguments in ARGUMENTS.items():
            listed = roslaunch('--nodes', os.path.join(LAUNCH, name + '.launch'), *arguments)
            self.assertEqual(set(listed.split()), NODES[name], name)

    def test_every_robot_model_gives_each_stage_its_parameters(self):
        for path in glob.glob(os.path.join(LAUNCH, '..', 'config', 'robots', '*.yaml')):
            model = os.path.basename(path)[:-len('.yaml')]
            dump = roslaunch('--dump-params', os.path.join(LAUNCH, 'robot.launch'), 'model:=' + model, 'frame_prefix:=r/')
            parameters = yaml.safe_load(dump)
            for stage in ('local', 'lidar', 'topology', 'planner', 'control'):
                self.assertEqual(parameters[f'/{stage}/frames/odom'], 'r/odom')
                self.assertEqual(parameters[f'/{stage}/frames/local'], 'r/local')
                self.assertGreater(parameters[f'/{stage}/robot/footprint/length'], 0.0)
                self.assertGreater(parameters[f'/{stage}/wiring/plan_rate'], 0.0)
            self.assertGreater(parameters['/planner/goal/tolerance'], 0.0)
            self.assertFalse([key for key in parameters if key.startswith('/team')], 'a robot without a name is alone')

    def test_a_robot_with_a_name_is_in_a_team(self):
        for name, transport in (('robot', 'udp'), ('replay', 'topic')):
            dump = roslaunch('--dump-params', os.path.join(LAUNCH, name + '.launch'), 'model:=courier', 'bag:=/none.bag', 'name:=ann',
                             'key_file:=/k', 'frame_prefix:=r/')
            parameters = yaml.safe_load(dump)
            self.assertEqual((parameters['/team/name'], parameters['/team/key_file']), ('ann', '/k'))
            self.assertEqual(parameters['/team/transport'], transport)
            self.assertGreater(parameters['/team/exchange/rate'], 0.0)
            self.assertGreater(parameters['/team/relative_localization/confirm_travel'], 0.0)
            self.assertGreater(parameters['/team/robot/limits/speed'], 0.0)
            arguments = roslaunch('--args', 'robot', os.path.join(LAUNCH, name + '.launch'), 'model:=courier', 'bag:=/none.bag',
                                  'name:=ann')
            self.assertIn(' team', arguments)

    def test_lidar_odometry_without_a_twist_has_a_stage_of_its_own(self):
        for name in ('robot', 'replay'):
            words = [os.path.join(LAUNCH, name + '.launch'), 'model:=courier', 'bag:=/none.bag', 'lidar_odometry_topic:=/Odometry']
            parameters = yaml.safe_load(roslaunch('--dump-params', *words))
            self.assertGreater(parameters['/odometry/longest_gap'], 0.0)
            arguments = roslaunch('--args', 'robot', *words)
            self.assertIn(' odometry local lidar', arguments)
            self.assertIn('lidar_odometry:=/Odometry', arguments)
            self.assertIn(' odom:=odom', arguments)
        self.assertNotIn('odometry ', roslaunch('--args', 'robot', os.path.join(LAUNCH, 'robot.launch'), 'model:=courier'))

    def test_a_robot_without_model_is_refused(self):
        with self.assertRaises(AssertionError):
            roslaunch('--nodes', os.path.join(LAUNCH, 'robot.launch'))


if __name__ == '__main__':
    unittest.main()
