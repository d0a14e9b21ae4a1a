#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs clang-tidy: tidy.py BUILD_DIR [--all] [--seconds S].

Takes what differs from origin/main, or on main itself what the last ten commits changed; for a header, a source that
includes it. What the time did not suffice for is counted in the last line.
"""
import argparse
import concurrent.futures
import json
import os
import subprocess
import sys
import time
from pathlib import Path

COMMITS = 10
EMPTY_TREE = "4b825dc642cb6eb9a060e54bf8d69288fbee4904"


def git(*arguments):
    """Output of a git command, or None where it fails."""
    result = subprocess.run(["git", *arguments], capture_output=True, text=True, check=False)
    return result.stdout.strip() if result.returncode == 0 else None


def changed():
    """Paths that differ from the base of the work, uncommitted and new ones among them."""
    head, base = git("rev-parse", "--verify", "-q", "HEAD"), git("merge-base", "HEAD", "origin/main")
    if base is None or base == head:
        base = git("rev-parse", "--verify", "-q", f"HEAD~{COMMITS}") or EMPTY_TREE
    names = git("diff", "--name-only", base) + "\n" + git("ls-files", "--others", "--exclude-standard")
    return {Path(name).resolve() for name in names.split("\n") if name}


def sources(build):
    """Our own translation units but tests and benchmarks."""
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    paths = {Path(entry["directory"], entry["file"]).resolve() for entry in entries}
    ours = (path for path in paths if path.is_relative_to(Path("src").resolve()))
    return sorted(path for path in ours if not {"test", "bench", "benchmark"} & set(path.parts))


def affected(units, paths):
    """The units that changed, and for each changed header one that includes it, by preference the one named alike."""
    chosen = {unit for unit in units if unit in paths}
    for header in (path for path in paths if path.suffix == ".h"):
        including = [unit for unit in units if f'{header.name}"' in unit.read_text(encoding="utf-8")]
        including.sort(key=lambda unit: (unit.stem != header.stem, unit not in chosen))
        chosen.update(including[:1])
    return sorted(chosen)


def tidy(unit, build, deadline):
    """(unit, status, text); status None if it was too late to begin."""
    if time.monotonic() > deadline:
        return unit, None, ""
    command = ["clang-tidy", "-p", str(build), "--quiet", "--extra-arg=-Wno-unknown-warning-option", str(unit)]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    return unit, result.returncode, result.stdout + (result.stderr if "error" in result.stderr else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--seconds", type=float, default=240.0)
    arguments = parser.parse_args()
    units = sources(arguments.build)
    units = units if arguments.all else affected(units, changed())
    deadline = time.monotonic() + (float("inf") if arguments.all else arguments.seconds)
    failed, late = 0, 0
    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("PARLEY_JOBS", "2"))) as pool:
        for unit, status, text in pool.map(lambda unit: tidy(unit, arguments.build, deadline), units):
            late += status is None
            if status:
                failed += 1
                print(f"{unit.relative_to(Path.cwd())}:\n{text}")
    print(f"clang-tidy: {len(units) - late} files read, {failed} with warnings, {late} left for --all")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
