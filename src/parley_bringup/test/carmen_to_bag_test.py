#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A log of a few lines, good and bad, becomes the bag that it says."""
import gzip
import math
import os
import subprocess
import tempfile
import unittest

import rosbag

SCRIPT = os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..', '..', 'scripts', 'carmen_to_bag')


def flaser(ranges, corrected, odometry, stamp):
    words = ['FLASER', len(ranges), *ranges, *corrected, *odometry, stamp, 'host', stamp]
    return ' '.join(map(str, words))


def odom(pose, stamp):
    return ' '.join(map(str, ['ODOM', *pose, 0, 0, 0, stamp, 'host', stamp]))


class CarmenToBag(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.log, self.bag = os.path.join(folder.name, 'log.gz'), os.path.join(folder.name, 'out.bag')

    def convert(self, lines, *options):
        with gzip.open(self.log, 'wt') as file:
            file.write('\n'.join(lines) + '\n')
        return subprocess.run(['/usr/bin/python3', SCRIPT, self.log, self.bag, *options], check=False, text=True,
                              capture_output=True)

    def messages(self, topic):
        with rosbag.Bag(self.bag) as bag:
            return [message for _, message, _ in bag.read_messages(topic)]

    def test_scans_and_odometry(self):
        ranges = [1.0] * 181
        ranges[90], ranges[91], ranges[92] = 2.5, 81.9, -1.0
        done = self.convert(['# comment', 'PARAM robot 1', odom((0, 0, 0), 100.0), flaser(ranges, (5, 5, 1), (0.5, 0, 0), 101.0),
                             odom((1.0, 0, 0.1), 102.0)])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('1 scans and 3 poses over 2 s, 1 other lines, 0 malformed', done.stdout)
        scan, = self.messages('/scan')
        self.assertAlmostEqual(scan.angle_min, -math.pi / 2, 5)
        self.assertAlmostEqual(scan.angle_increment, math.pi / 180, 6)
        self.assertAlmostEqual(scan.angle_max, math.pi / 2, 5)
        self.assertEqual(scan.ranges[90], 2.5)
        self.assertEqual(scan.ranges[91], math.inf)
        self.assertTrue(math.isnan(scan.ranges[92]))
        odometry = self.messages('/odom')
        stamps = [message.header.stamp.to_sec() for message in odometry]
        self.assertLess(max(b - a for a, b in zip(stamps, stamps[1:])), 0.051)
        at_scan = [m for m in odometry if m.header.stamp == scan.header.stamp]
        self.assertAlmostEqual(at_scan[0].pose.pose.position.x, 0.5)
        self.assertAlmostEqual(odometry[0].twist.twist.linear.x, 0.5)
        self.assertEqual(len(self.messages('/clock')), len(odometry))
        self.assertEqual(self.messages('/tf_static')[0].transforms[0].child_frame_id, 'lidar')

    def test_even_beam_counts_have_one_end(self):
        self.convert([flaser([1.0] * 360, (0, 0, 0), (0, 0, 0), 1.0)])
        scan, = self.messages('/scan')
        self.assertAlmostEqual(scan.angle_increment, math.pi / 360, 6)
        self.assertLess(scan.angle_max, math.pi / 2 - 0.008)

    def test_corrected_poses(self):
        self.convert([flaser([1.0] * 180, (5, 6, 1), (0, 0, 0), 1.0), odom((9, 9, 9), 1.5),
                      flaser([1.0] * 180, (6, 6, 1), (1, 0, 0), 2.0)], '--poses', 'corrected')
        xs = [message.pose.pose.position.x for message in self.messages('/odom')]
        self.assertEqual((min(xs), max(xs)), (5.0, 6.0))

    def test_malformed_lines_are_counted(self):
        good = flaser([1.0] * 180, (0, 0, 0), (0, 0, 0), 1.0)
        done = self.convert([good, good[:200], 'FLASER', 'FLASER many 1 2', 'FLASER 99999999 1', 'ODOM 1 2', 'ODOM a b c d e f g h i',
                             odom(('nan', 0, 0), 2.0), '\x00\x7f', ''])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('7 malformed (line 2: FLASER with 180 beams', done.stdout)
        self.assertEqual(len(self.messages('/scan')), 1)

    def test_stamps_that_stand_still_are_replaced(self):
        done = self.convert([flaser([1.0] * 180, (0, 0, 0), (i, 0, 0), '1.13486e+09') for i in range(5)])
        self.assertIn('time is made from the distances driven', done.stdout)
        stamps = [scan.header.stamp.to_sec() for scan in self.messages('/scan')]
        self.assertAlmostEqual(stamps[-1] - stamps[0], 8.0, 2)

    def test_corrections_are_no_motion(self):
        """After each scan the log sets the odometry to the corrected pose, 0.3 m to the side."""
        scan = [1.0] * 180
        self.convert([odom((0, 0, 0), 1.0), odom((1, 0, 0), 2.0), flaser(scan, (1, 0.3, 0), (1, 0.3, 0), 2.5),
                      odom((1, 0.3, 0), 0), odom((2, 0.3, 0), 3.0), flaser(scan, (2, 0.6, 0), (2, 0.6, 0), 3.5), odom((2, 0.6, 0), 0),
                      odom((3, 0.6, 0), 4.0)])
        end = self.messages('/odom')[-1].pose.pose.position
        self.assertAlmostEqual(end.x, 3.0)
        self.assertAlmostEqual(end.y, 0.0)

    def test_a_log_without_scans_or_no_log_is_refused(self):
        done = self.convert([odom((0, 0, 0), 1.0)])
        self.assertNotEqual(done.returncode, 0)
        self.assertIn('no scan', done.stderr)
        with open(self.log, 'wb') as file:
            file.write(b'no gzip')
        done = subprocess.run(['/usr/bin/python3', SCRIPT, self.log, self.bag], check=False, text=True, capture_output=True)
        self.assertEqual((done.returncode, 'Traceback' in done.stderr), (1, False), done.stderr)


if __name__ == '__main__':
    unittest.main()
