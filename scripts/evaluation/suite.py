# SPDX-License-Identifier: BSD-3-Clause
"""The cases that teams of robots are judged by, and whether a run ended as it should."""
from pathlib import Path

import yaml

from . import runs

CASES = Path(__file__).with_name("suite.yaml")
EXPECTATIONS = ("success", "no collision", "no arrival")


def load():
    """Cases of suite.yaml: name, scenario, set (a list of KEY=VALUE), expect, full (seeds with --full), quick."""
    cases = yaml.safe_load(CASES.read_text())["cases"]
    for case in cases:
        unknown = set(case) - {"name", "scenario", "set", "variant", "expect", "full", "quick"}
        if unknown or case.get("expect", "success") not in EXPECTATIONS:
            raise SystemExit(f"{CASES}: {case.get('name')}: unusable: {sorted(unknown) or case['expect']}")
    return cases


def seeds_of(case, arguments):
    if arguments.seeds is not None:
        return arguments.seeds
    if arguments.quick:
        return 1
    return case.get("full", 10) if arguments.full else 10


def plan(arguments):
    """Every run of the suite: its world, scenario and seed, and what is expected of it."""
    cases = load()
    if arguments.quick:
        cases = [case for case in cases if case.get("quick")]
    cases += [{"name": path.stem, "scenario": str(path.resolve())} for path in arguments.worlds]
    if arguments.cases is not None:
        for name in arguments.cases:
            if not any(case["name"].startswith(name) for case in cases):
                raise SystemExit(f"--cases: {name}: no case begins like this; they are in {CASES}")
        cases = [case for case in cases if any(case["name"].startswith(name) for name in arguments.cases)]
    jobs = []
    for case in cases:
        path = runs.ROOT / "maps/scenarios" / f"{case['scenario']}.yaml"
        path = path if path.is_file() else Path(case["scenario"])
        scenario = yaml.safe_load(path.read_text())
        scenario["map"] = str((path.parent / scenario["map"]).resolve())
        extra = [part for setting in case.get("set", []) for part in ("--set", setting)]
        extra += ["--variant", case["variant"]] if "variant" in case else []
        for seed in range(1, seeds_of(case, arguments) + 1):
            jobs.append({"world": case["name"], "label": "", "scenario": scenario, "seed": seed, "extra": extra,
                         "expect": case.get("expect", "success")})
    return jobs


def as_expected(result, expectation):
    """Nobody may ever touch anything; then: all arrive, some may, nobody may."""
    if sum(result["collisions"].values()) > 0:
        return False
    if expectation == "no collision":
        return True
    if expectation == "no arrival":
        return not any(robot["reached"] for robot in result["robots"])
    return result["success"]


def execute(executable, job):
    """Runs one; the result is fleet_run's with `as_expected` added."""
    result = runs.execute(executable, job, job["extra"])
    result["as_expected"] = as_expected(result, job["expect"])
    return result
