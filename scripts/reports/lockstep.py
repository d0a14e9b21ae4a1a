#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures whole runs of fleet_run on this core: lockstep.py FLEET_RUN RESULT.json.

For one robot and for eight: wall time, simulated time, how much faster than time it ran, and memory at its peak.
"""
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SCENARIOS = ("scenario_a_solo", "scenario_a")


def measure(program, scenario):
    """One run; wall and memory are the system's own account of the process."""
    with tempfile.TemporaryDirectory() as folder:
        result = Path(folder, "result.json")
        begin = time.monotonic()
        process = subprocess.Popen([program, f"maps/scenarios/{scenario}.yaml", "--config", "config", "--quiet",
                                    "--json", str(result)], stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.monotonic() - begin
        if not result.exists():
            sys.exit(f"fleet_run on {scenario}: no result, status {os.waitstatus_to_exitcode(status)}")
        run = json.loads(result.read_text(encoding="utf-8"))
    return {"scenario": scenario, "robots": len(run["robots"]), "success": run["success"], "simulated": run["simulated"],
            "wall": wall, "factor": run["simulated"] / wall, "memory": usage.ru_maxrss / 1024.0,
            "timing_ms": run["timing_ms"]}


def main():
    program, output = sys.argv[1:]
    rows = [measure(program, scenario) for scenario in SCENARIOS]
    print(f"{'scenario':<20}{'robots':>7}{'simulated [s]':>15}{'wall [s]':>10}{'factor':>8}{'memory [MB]':>13}")
    for row in rows:
        print(f"{row['scenario']:<20}{row['robots']:>7}{row['simulated']:>15.1f}{row['wall']:>10.1f}"
              f"{row['factor']:>8.1f}{row['memory']:>13.0f}")
    Path(output).write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
