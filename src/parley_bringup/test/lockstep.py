# SPDX-License-Identifier: BSD-3-Clause
"""A scenario as the lockstep runner plays it, to compare with."""
import json
import os
import subprocess
import tempfile

import roslib.packages


def fleet_run(scenario, config, seed=1):
    """The result of the runner for two files."""
    program = roslib.packages.find_node('parley_sim', 'fleet_run')[0]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, 'result.json')
        subprocess.run([program, scenario, '--config', config, '--json', path, '--seed', str(seed), '--quiet'],
                       check=True)
        with open(path, encoding='utf-8') as file:
            return json.load(file)
