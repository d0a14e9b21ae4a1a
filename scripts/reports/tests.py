#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Counts test cases over the results of all registered tests: tests.py BUILD_DIR [--units].

A failure is also: a registered test without a result, a test that ended badly with no failed case to show for it, and
a node that died. A .test file that lets a node die on purpose says so: <!-- expected to die: NAME -->.
The last line is `N passed, N failed`; the status is 0 if some passed and none failed.
"""
import argparse
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

DIED = re.compile(r"\[([\w/]+)-\d+\] process has died|(terminate called)")
EXPECTED = re.compile(r"<!--\s*expected to die:(.*?)-->", re.S)


def registered(build):
    """(name, result file, .test file or None) of each test that ctest knows."""
    listed = subprocess.run(["ctest", "--show-only=json-v1"], cwd=build, check=True, capture_output=True, text=True)
    for test in json.loads(listed.stdout)["tests"]:
        command = test.get("command", [])
        results = [Path(word) for word in command if word.endswith(".xml") and "/test_results/" in word]
        launch = re.search(r'--results-base-dir "[^"]*" (\S+)', command[-1]) if command else None
        yield test["name"], results[0] if results else None, Path(launch[1]) if launch else None


def cases(path):
    """{name: passed, failed or skipped} of a result file; empty if it is missing or cannot be read."""
    try:
        root = ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError):
        return {}
    found = {}
    for case in root.iter("testcase"):
        bad = case.find("failure") is not None or case.find("error") is not None
        skipped = case.find("skipped") is not None or case.get("status") == "notrun"
        name = f"{case.get('classname')}.{case.get('name')}"
        found[name] = "failed" if bad else "skipped" if skipped else "passed"
    return found


def rostest_cases(path):
    """The cases of the programs that a rostest ran; of its own only the failures that they do not explain."""
    found = {}
    for name, outcome in cases(path).items():
        program = name.rsplit(".test", 1)[-1]
        inner = cases(path.parent / f"rosunit-{program}.xml")
        found.update({f"{program}: {case}": result for case, result in inner.items()})
        if "failed" not in inner.values() and (outcome == "failed" or not inner):
            found[name] = "failed"
    return found


def deaths(log, launch):
    """What a log says of processes that died and were not expected to."""
    expected = set()
    for match in EXPECTED.finditer(launch.read_text(encoding="utf-8")):
        expected.update(match[1].replace(",", " ").split())
    return sorted({match[1] or match[2] for match in DIED.finditer(log)
                   if (match[1] not in expected if match[1] else not expected)})


def ctest_results(build):
    """{test: (status, output)} of what ctest ran."""
    found = {}
    for path in sorted(build.glob("ctest-*.xml")):
        for case in ElementTree.parse(path).getroot().iter("testcase"):
            found[case.get("name")] = (case.get("status"), case.findtext("system-out") or "")
    return found


def doubles(launches):
    """Packages' programs that two .test files run under one test-name, the later result in place of the earlier one."""
    seen = {}
    for launch in launches:
        for name in ElementTree.parse(launch).getroot().iter("test"):
            seen.setdefault((launch.parent, name.get("test-name")), set()).add(launch.name)
    return [f"{name} in {' and '.join(sorted(files))}" for (_, name), files in seen.items() if len(files) > 1]


def judge(name, result, launch, ran):
    """{case: outcome} of one registered test."""
    status, output = ran.get(name, ("notrun", ""))
    found = rostest_cases(result) if launch else cases(result)
    if not found:
        found = {"no result": "failed"}
    if status != "run" and "failed" not in found.values():
        found[f"ctest says {status}"] = "failed"
    if launch:
        log = output + (result.read_text(encoding="utf-8", errors="replace") if result.exists() else "")
        found.update({f"died: {node}": "failed" for node in deaths(log, launch)})
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("--units", action="store_true", help="without the tests that need a ROS master")
    arguments = parser.parse_args()
    ran = ctest_results(arguments.build)
    count = {"passed": 0, "failed": 0, "skipped": 0}
    tests = [test for test in registered(arguments.build) if not (arguments.units and test[2])]
    for double in doubles({test[2] for test in tests if test[2]}):
        count["failed"] += 1
        print(f"FAILED two tests write one result: {double}")
    for name, result, launch in tests:
        for case, outcome in judge(name, result, launch, ran).items():
            count[outcome] += 1
            if outcome == "failed":
                print(f"FAILED {name.replace('_ctest_', '')}: {case}")
    skipped = f", {count['skipped']} skipped" if count["skipped"] else ""
    print(f"{count['passed']} passed, {count['failed']} failed{skipped}")
    return 0 if count["passed"] and not count["failed"] else 1


if __name__ == "__main__":
    sys.exit(main())
