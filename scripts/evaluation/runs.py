# SPDX-License-Identifier: BSD-3-Clause
"""Which runs a campaign has, and how one is executed."""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]


def built_fleet_run():
    """The runner as the sources have it, built if it is not up to date; exits if that fails."""
    built = subprocess.run([ROOT / "scripts/build", "--target", "fleet_run"], stdout=sys.stderr)
    if built.returncode != 0:
        sys.exit("fleet_run could not be built (scripts/setup installs what that needs)")
    return ROOT / "build/release/devel/lib/parley_sim/fleet_run"


def subset(scenario_path, names):
    """The scenario with only the robots in `names`, its map as an absolute path."""
    scenario = yaml.safe_load(scenario_path.read_text())
    scenario["map"] = str((scenario_path.parent / scenario["map"]).resolve())
    scenario["robots"] = [r for r in scenario["robots"] if r["name"] in names]
    return scenario


def groups(scenario_path, arguments):
    """Names of the robots of each run of a scenario: one each (solo) or mixed from both sides (fleet)."""
    scenario = yaml.safe_load(scenario_path.read_text())
    if not isinstance(scenario, dict) or "robots" not in scenario:
        sys.exit(f"{scenario_path}: robots: missing; this is not a scenario")
    names = [r["name"] for r in scenario["robots"]]
    if arguments.mode == "solo":
        return [[name] for name in names]
    half = (len(names) + 1) // 2
    mixed = [name for pair in zip(names[:half], names[half:] + names[half:]) for name in pair]
    ordered = list(dict.fromkeys(mixed)) or names
    return [ordered[:min(size, len(names))] for size in arguments.sizes]


def plan(arguments):
    """Yields (label, scenario, seed) of every run of the campaign."""
    for path in arguments.scenarios:
        for names in groups(path, arguments):
            label = names[0] if arguments.mode == "solo" else f"{len(names)} robots"
            for seed in range(1, arguments.seeds + 1):
                yield {"world": path.stem, "label": label, "scenario": subset(path, names), "seed": seed}


def execute(executable, job, extra):
    """Runs fleet_run once; the result is its JSON with `world`, `label`, `command` added."""
    with tempfile.TemporaryDirectory() as folder:
        scenario, result = Path(folder) / f"{job['world']}.yaml", Path(folder) / "result.json"
        scenario.write_text(yaml.safe_dump(job["scenario"]))
        command = [str(executable), str(scenario), "--seed", str(job["seed"]), "--json", str(result), "--quiet", *extra]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if not result.is_file():
            sys.exit(f"fleet_run failed ({done.returncode}) on {job['world']} {job['label']}: {done.stderr.strip()}")
        data = json.loads(result.read_text())
    data.update(world=job["world"], label=job["label"], seed=job["seed"])
    return data
