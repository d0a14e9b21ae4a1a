#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The display of several robots has all that the display of one has, for each, and only topics that a robot has."""
import os
import re
import subprocess
import tempfile
import unittest

import yaml

PARTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..')
DISPLAY = os.path.join(PARTS, 'config', 'rviz', 'parley.rviz')
NODES = os.path.join(PARTS, '..', 'parley_nodelets', 'README.md')


def manager(*robots, area=''):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'made.rviz')
        subprocess.run([os.path.join(PARTS, 'scripts', 'show_robots'), DISPLAY, '--fixed-frame', 'world', '--robots', ' '.join(robots),
                        '--area', area, '--write', path], check=True)
        with open(path, encoding='utf-8') as file:
            return yaml.safe_load(file)['Visualization Manager']


def topics(displays):
    return {display[key] for display in displays for key in ('Topic', 'Marker Topic') if key in display}


class ShowRobots(unittest.TestCase):
    def setUp(self):
        self.single = manager()
        self.several = manager('ann', '/bob', 'cid')
        self.groups = [display for display in self.several['Displays'] if display['Class'] == 'rviz/Group']

    def test_each_robot_has_all_displays(self):
        self.assertEqual([group['Name'] for group in self.groups], ['ann', 'bob', 'cid'])
        for group in self.groups:
            self.assertEqual(topics(group['Displays']), {f'/{group["Name"]}/{topic}' for topic in topics(self.single['Displays'])})
        ungrouped = [display for display in self.several['Displays'] if display['Class'] != 'rviz/Group']
        self.assertEqual({display['Class'] for display in ungrouped}, {'rviz/Grid', 'rviz/TF'})

    def test_topics_are_those_of_a_robot(self):
        with open(NODES, encoding='utf-8') as file:
            known = set(re.findall(r'`([\w/]+)`', file.read()))
        self.assertLessEqual(topics(self.single['Displays']) | topics(self.single['Tools']), known)

    def test_robots_can_be_told_apart(self):
        scans = [display for group in self.groups for display in group['Displays'] if display['Name'] == 'Scan']
        self.assertEqual(len({scan['Color'] for scan in scans}), 3)
        maps = [display['Enabled'] for group in self.groups for display in group['Displays'] if display['Name'] == 'Local map']
        self.assertEqual(maps, [True, False, False], 'maps would cover each other')

    def test_an_area_is_brought_into_view(self):
        view = manager('ann', area='1.5 -2 8.5 10')['Views']['Current']
        self.assertEqual((view['X'], view['Y']), (5.0, 4.0))
        self.assertGreater(view['Scale'] * 12.0, 400.0, 'pixels')
        self.assertLess(view['Scale'] * 12.0, 700.0)
        self.assertEqual(self.several['Views'], self.single['Views'])

    def test_each_robot_has_a_goal_tool(self):
        goals = [tool['Topic'] for tool in self.several['Tools'] if tool['Class'] == 'rviz/SetGoal']
        self.assertEqual(goals, [f'/{robot}/move_base_simple/goal' for robot in ('ann', 'bob', 'cid')])


if __name__ == '__main__':
    unittest.main()
